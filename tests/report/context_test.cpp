#include "report/context.h"

#include <gtest/gtest.h>

#include <regex>

namespace slipcheck::testing {
namespace {

TEST(Context, KnowsWhatWasBuilt) {
  const Context& c = context();
  EXPECT_TRUE(std::regex_match(c.version, std::regex(R"(\d+\.\d+\.\d+)"))) << c.version;
  EXPECT_TRUE(std::regex_match(c.commit, std::regex("unknown|[0-9a-f]{12,40}(-modified)?")))
      << c.commit;
  EXPECT_FALSE(c.build.empty());
  EXPECT_FALSE(c.compiler.empty());
  EXPECT_FALSE(c.cpu.empty());
  EXPECT_TRUE(std::regex_match(c.date, std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ)"))) << c.date;
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
