#include "report/rows/outcome_look.h"

#include <array>

namespace slipcheck {
namespace {

// In the order of Outcome. Colours of Okabe and Ito and of greys; the letters tell apart what looks
// alike without colours.
constexpr std::array<OutcomeLook, kOutcomes> kLooks = {{
    {"A", "ok", "#0072b2", "#ffffff"},
    {"d", "degr", "#a9d6f0", "#1b1b1b"},
    {"~", "drift", "#f0e442", "#1b1b1b"},
    {"E", "grow", "#e69f00", "#1b1b1b"},
    {"T", "tunn", "#cc79a7", "#1b1b1b"},
    {"X", "expl", "#d55e00", "#1b1b1b"},
    {"N", "NaN", "#1b1b1b", "#ffffff"},
    {"H", "hang", "#6b5b4b", "#ffffff"},
    {"C", "crash", "#5c2a6b", "#ffffff"},
    {"–", "refus", "#e4e4e0", "#1b1b1b"},
}};

}  // namespace

const OutcomeLook& look_of(Outcome outcome) { return kLooks[static_cast<std::size_t>(outcome)]; }

Tone tone_of(Outcome outcome) {
  if (outcome == Outcome::accurate) return Tone::good;
  if (outcome == Outcome::refused) return Tone::faint;
  return is_usable(outcome) ? Tone::plain : Tone::bad;
}

bool is_usable(Outcome outcome) {
  return outcome == Outcome::accurate || outcome == Outcome::degraded;
}

}  // namespace slipcheck
