#include <algorithm>
#include <random>

#include "../support/cpu_time.h"
#include "scenes.h"

namespace slipcheck {
namespace {

/// The text with some bytes changed, taken out, doubled or brought from elsewhere.
std::string mutated(std::string text, std::mt19937& random) {
  constexpr std::string_view kTelling = "{}[]:,-#&*!|>'\"%@`\n \t\\0123456789.eE+~?<=\x80\xff";
  const auto below = [&](std::size_t limit) { return random() % limit; };
  for (std::size_t n = 1 + below(3) / 2; n > 0 && !text.empty(); --n) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(text.size() - at, 1 + below(20));
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text[at] = kTelling[below(kTelling.size())];
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      default:
        text.insert(at, 1, kTelling[below(kTelling.size())]);
    }
  }
  return text;
}

TEST(Fuzz, AnyTextLoadsOrIsRefused) {
  std::mt19937 random(1);  // the same texts on every run
  // Under sanitizers libFuzzer does the same for longer (tests/fuzz).
  constexpr int kTexts = test::kSlower > 1 ? 600 : 6000;
  int loaded = 0;
  for (int i = 0; i < kTexts; ++i) {
    const std::string& scene = i % 3 == 0   ? testing::kExample
                               : i % 3 == 1 ? testing::kHard
                                            : testing::kContainer;
    const std::string text = mutated(scene, random);
    const test::CpuTime took;
    try {
      parse_scenario(text, "s.yaml");
      ++loaded;
    } catch (const BadScenario& bad) {
      EXPECT_FALSE(bad.faults().empty());
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << '\n' << text;
    }
    EXPECT_LT(took(), 2 * test::kSlower) << text;
  }
  // Neither all refused nor all accepted: the changes reach the rules.
  EXPECT_GT(loaded, kTexts / 60);
  EXPECT_LT(loaded, kTexts - kTexts / 60);
}

}  // namespace
}  // namespace slipcheck
