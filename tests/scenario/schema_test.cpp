#include "scenario/schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "../support/text_of.h"
#include "scenario/load.h"
#include "scenario/observable_names.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kSource = SLIPCHECK_SOURCE_DIR;

TEST(Schema, FileHasTheTableAndASweep) {
  json written = json::parse(test::text_of(kSource / "scenarios/schema.json"));
  EXPECT_EQ(written["properties"].erase("sweep"), 1u);  // SweepSchema.FileIsUpToDate
  EXPECT_EQ(written, scenario_schema());
}

void collect_keys(const json& schema, std::set<std::string>& keys) {
  if (schema.is_object() && schema.contains("properties") && schema["properties"].is_object()) {
    for (const auto& [key, value] : schema["properties"].items()) keys.insert(key);
  }
  if (schema.is_object() && schema.contains("enum")) {
    for (const json& word : schema["enum"]) keys.insert(word.get<std::string>());
  }
  for (const json& part : schema.is_structured() ? schema : json::array()) collect_keys(part, keys);
}

TEST(Schema, EveryKeyAndWordIsDocumented) {
  const std::string document = test::text_of(kSource / "docs/scenario-format.md");
  const auto is_letter = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  const auto has_word = [&](const std::string& word) {
    for (std::size_t at = 0; (at = document.find(word, at)) != std::string::npos; ++at) {
      const bool starts = at == 0 || !is_letter(document[at - 1]);
      const std::size_t end = at + word.size();
      if (starts && (end == document.size() || !is_letter(document[end]))) return true;
    }
    return false;
  };
  std::set<std::string> keys;
  collect_keys(scenario_schema(), keys);
  EXPECT_GT(keys.size(), 100u);
  for (std::string key : keys) {
    const bool component = key.ends_with(".x") || key.ends_with(".y") || key.ends_with(".z");
    if (component) key.resize(key.size() - 2);
    EXPECT_TRUE(has_word(key)) << key;
  }
}

TEST(Schema, EveryKeyIsDescribed) {
  const json schema = scenario_schema();
  for (const auto& [key, value] : schema["properties"].items()) {
    EXPECT_TRUE(value.contains("description")) << key;
  }
}

TEST(BundledScenarios, LoadAndNameTheSchema) {
  for (const auto& entry : fs::directory_iterator(kSource / "scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(load_scenario(entry.path())) << entry.path();
    const std::string text = test::text_of(entry.path());
    EXPECT_EQ(text.substr(0, text.find('\n')), "# yaml-language-server: $schema=schema.json")
        << entry.path();
  }
}

TEST(Observables, AreSortedAndFound) {
  const auto names = observable_names();
  EXPECT_TRUE(std::ranges::is_sorted(names, {}, &ObservableName::name));
  EXPECT_EQ(names.size(), 29u);
  EXPECT_EQ(find_observable("sliding_time")->scope, ObservableScope::body);
  EXPECT_TRUE(find_observable("final_velocity")->is_vector);
  EXPECT_TRUE(find_observable("effective_restitution")->is_restitution);
  EXPECT_EQ(find_observable("nonsense"), nullptr);
}

}  // namespace
}  // namespace slipcheck
