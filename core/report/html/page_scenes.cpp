#include "report/html/page_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "report/rows/told_verdict.h"
#include "report/rows/topic.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

/// Names are of a-z, 0-9 and - already, unless someone else wrote the result.
std::string slug_of(const std::string& name) {
  std::string slug;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    slug += byte < 0x80 && (std::isalnum(byte) != 0 || c == '-' || c == '_') ? c : '-';
  }
  return slug;
}

}  // namespace

std::vector<std::string> scene_ids(const std::vector<SceneRecord>& scenes) {
  std::vector<std::string> ids;
  std::set<std::string> taken;
  for (const SceneRecord& scene : scenes) {
    const std::string stem = "scene-" + slug_of(scene.scenario.name);
    std::string id = stem;
    for (int k = 2; !taken.insert(id).second; ++k) id = fmt::format("{}-{}", stem, k);
    ids.push_back(std::move(id));
  }
  return ids;
}

std::vector<PageTopic> page_topics(const std::vector<SceneRecord>& scenes) {
  const std::vector<std::string> ids = scene_ids(scenes);
  std::vector<PageTopic> topics;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const std::string name = topic_of(scenes[k].scenario);
    auto topic = std::ranges::find(topics, name, &PageTopic::name);
    if (topic == topics.end()) topic = topics.insert(topics.end(), {name, {}, {}});
    topic->scenes.push_back({&scenes[k], k, ids[k]});
  }
  std::ranges::stable_sort(topics, [](const PageTopic& one, const PageTopic& other) {
    return is_topic_before(one.name, other.name);
  });
  for (std::size_t k = 0; k < topics.size(); ++k) {
    topics[k].id = fmt::format("topic-{}", k + 1);
    std::ranges::stable_sort(topics[k].scenes, [](const PageScene& one, const PageScene& other) {
      return told_verdict(*one.scene) > told_verdict(*other.scene);
    });
  }
  return topics;
}

std::string PageTopic::counts() const {
  std::size_t within = 0, judged = 0;
  for (const PageScene& each : scenes) {
    const Verdict verdict = told_verdict(*each.scene);
    within += verdict == Verdict::within ? 1 : 0;
    judged += verdict == Verdict::unjudged ? 0 : 1;
  }
  std::string text = judged > 0 ? fmt::format("{} of {} within", within, judged) : "";
  if (judged < scenes.size())
    text += fmt::format("{}{} not judged", text.empty() ? "" : ", ", scenes.size() - judged);
  return text;
}

}  // namespace slipcheck
