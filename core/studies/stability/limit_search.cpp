#include "studies/stability/limit_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace slipcheck {
namespace {

/// Values inside an interval that are tried at once: both cores have one.
constexpr std::size_t kInside = 2;

/// `parts` + 1 values from `from` to `to` at equal ratios, both included.
std::vector<double> equal_ratios(double from, double to, std::size_t parts) {
  std::vector<double> values;
  for (std::size_t k = 0; k <= parts; ++k)
    values.push_back(from * std::pow(to / from, static_cast<double>(k) / parts));
  values.back() = to;
  return values;
}

std::size_t scan_parts(const LimitRange& range) {
  const double decades = std::log10(range.high / range.low);
  // Round-off makes 7 decades 7.000000000000001.
  const auto parts = static_cast<std::size_t>(std::ceil(decades * range.per_decade - 1e-9));
  return std::max<std::size_t>(parts, 1);
}

double ratio_of(double a, double b) { return a > b ? a / b : b / a; }

}  // namespace

LimitSearch::LimitSearch(const LimitRange& range) : range_(range) {
  assert(range.low > 0 && range.high > range.low && range.ratio > 1 && range.per_decade > 0);
  const bool upwards = range.good_end == LimitRange::GoodEnd::low;
  wanted_ = equal_ratios(upwards ? range.low : range.high, upwards ? range.high : range.low,
                         scan_parts(range));
}

void LimitSearch::tell(std::span<const Trial> trials) {
  assert(trials.size() == wanted_.size() && !is_done());
  std::vector<Tried> told;
  for (std::size_t k = 0; k < trials.size(); ++k) told.push_back({wanted_[k], trials[k]});
  if (tried_.empty()) {
    tried_ = std::move(told);
    choose_region();
  } else {
    // They lie between good_ and bad_, in this order.
    const std::size_t from = *good_ + 1;
    tried_.insert(tried_.begin() + static_cast<std::ptrdiff_t>(from), told.begin(), told.end());
    bad_ = *bad_ + told.size();
    for (std::size_t k = from; k < from + told.size(); ++k) {
      if (!tried_[k].trial.good) {
        bad_ = k;
        break;
      }
      good_ = k;
    }
  }
  section();
}

void LimitSearch::choose_region() {
  std::size_t longest = 0;
  for (std::size_t k = 0, length = 0; k < tried_.size(); ++k) {
    length = tried_[k].trial.good ? length + 1 : 0;
    if (length <= longest) continue;
    longest = length;
    good_ = k;
  }
  const std::size_t next = good_ ? *good_ + 1 : 0;
  if (next < tried_.size()) bad_ = next;
}

void LimitSearch::section() {
  wanted_.clear();
  if (!good_ || !bad_) return;
  const double from = tried_[*good_].value, to = tried_[*bad_].value;
  if (ratio_of(from, to) <= range_.ratio) return;
  const std::vector<double> all = equal_ratios(from, to, kInside + 1);
  wanted_.assign(all.begin() + 1, all.end() - 1);
}

FoundLimit LimitSearch::found() const {
  FoundLimit found;
  if (good_) found.good = tried_[*good_].value;
  if (bad_) {
    found.bad = tried_[*bad_].value;
    found.beyond = tried_[*bad_].trial;
  }
  if (good_)
    for (std::size_t k = 0; k < tried_.size(); ++k) {
      if (k < *good_ && !tried_[k].trial.good) found.islands.push_back(tried_[k].value);
      if (k > *good_ && tried_[k].trial.good) found.strays.push_back(tried_[k].value);
    }
  const bool all_refused = !tried_.empty() && std::ranges::all_of(tried_, [](const Tried& each) {
    return each.trial.outcome == Outcome::refused && !each.trial.good;
  });
  if (all_refused) found.refusal = tried_.front().trial.why;
  return found;
}

std::size_t LimitSearch::most_trials_left() const {
  if (is_done()) return 0;
  const std::size_t parts = scan_parts(range_);
  double interval = std::log(range_.high / range_.low) / static_cast<double>(parts);
  if (good_ && bad_) interval = std::log(ratio_of(tried_[*good_].value, tried_[*bad_].value));
  const double rounds = std::log(interval / std::log(range_.ratio)) / std::log(kInside + 1.0);
  const auto inside = kInside * static_cast<std::size_t>(std::ceil(std::max(rounds, 0.0)));
  return tried_.empty() ? parts + 1 + inside : inside;
}

}  // namespace slipcheck
