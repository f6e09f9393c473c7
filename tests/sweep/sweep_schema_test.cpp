#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "../support/text_of.h"
#include "studies/sweep/sweep_block.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kSource = SLIPCHECK_SOURCE_DIR;

// After a change of the format: SLIPCHECK_UPDATE_SCHEMA=1 sweep_tests
// --gtest_filter='SweepSchema.*'
TEST(SweepSchema, FileIsUpToDate) {
  const fs::path file = kSource / "scenarios/schema.json";
  const std::string expected = sweep_file_schema().dump(2) + "\n";
  if (std::getenv("SLIPCHECK_UPDATE_SCHEMA")) std::ofstream(file, std::ios::binary) << expected;
  EXPECT_EQ(test::text_of(file), expected) << "see the comment above this test";
}

TEST(SweepSchema, EditorsCompleteWhatVaries) {
  const json sweep = sweep_file_schema()["properties"]["sweep"];
  const std::string document = test::text_of(kSource / "docs/sweeps.md");
  for (const char* part : {"grid", "list", "latin_hypercube", "sobol"})
    EXPECT_FALSE(sweep["properties"][part]["description"].get<std::string>().empty()) << part;
  const json& names = sweep["properties"]["grid"]["properties"];
  for (const char* name :
       {"engine", "version", "precision", "profile", "rate", "scale", "phases"}) {
    EXPECT_TRUE(names.contains(name) && names[name].contains("description")) << name;
    EXPECT_NE(document.find('`' + std::string(name) + '`'), std::string::npos) << name;
  }
  EXPECT_EQ(names.size(), 7u);
}

}  // namespace
}  // namespace slipcheck
