#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/compare/record.h"

namespace slipcheck {

/// A scene with its place on the page.
struct PageScene {
  const SceneRecord* scene = nullptr;
  std::size_t place = 0;  ///< in what was given, by which the page's data know it
  std::string id;         ///< of its section, "scene-symmetric-30cms"
};

/// Scenes under one heading, the worst verdict first.
struct PageTopic {
  std::string name;  ///< topic_of()
  std::string id;    ///< of its section, "topic-1"
  std::vector<PageScene> scenes;

  /// "3 of 12 within", "4 of the reference alone"
  std::string counts() const;
};

/// The scenes in the order of the page, by topic. They must outlive it.
std::vector<PageTopic> page_topics(const std::vector<SceneRecord>& scenes);

/// The ids of the scenes in the order in which they are given: distinct, of their names.
std::vector<std::string> scene_ids(const std::vector<SceneRecord>& scenes);

}  // namespace slipcheck
