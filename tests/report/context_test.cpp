#include "report/rows/context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace slipcheck::testing {
namespace {

/// Digits as "0", other characters as they are.
std::string shape(std::string text) {
  for (char& c : text)
    if (c >= '0' && c <= '9') c = '0';
  return text;
}

TEST(Context, KnowsWhatWasBuilt) {
  const Context& c = context();
  EXPECT_EQ(std::count(c.version.begin(), c.version.end(), '.'), 2) << c.version;
  const std::string commit = c.commit.substr(0, c.commit.find("-modified"));
  const bool is_hash =
      commit.size() >= 12 && commit.find_first_not_of("0123456789abcdef") == std::string::npos;
  EXPECT_TRUE(commit == "unknown" || is_hash) << c.commit;
  EXPECT_FALSE(c.build.empty());
  EXPECT_FALSE(c.compiler.empty());
  EXPECT_FALSE(c.cpu.empty());
  EXPECT_EQ(shape(c.date), "0000-00-00T00:00:00Z");
}

TEST(Context, WarnsOfADebugBuildAndOnlyOfIt) {
#if defined(NDEBUG) && !defined(SLIPCHECK_SANITIZE)
  EXPECT_FALSE(is_debug_build());
  EXPECT_EQ(debug_build_warning(), "");
#else
  EXPECT_TRUE(is_debug_build());
  EXPECT_EQ(debug_build_warning().find("THIS IS A DEBUG BUILD"), 0u);
#endif
}

}  // namespace
}  // namespace slipcheck::testing
