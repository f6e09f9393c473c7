#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/stability/outcome.h"

namespace slipcheck {

/// Where a limit is looked for, and how closely.
struct LimitRange {
  enum class GoodEnd { low, high };

  double low = 0, high = 0;         ///< > 0, low < high
  GoodEnd good_end = GoodEnd::low;  ///< low: the largest good value is looked for; high: the least
  double per_decade = 3;            ///< values of the scan in a factor of ten, > 0
  double ratio = 1.01;              ///< of the values on both sides of the limit at the end, > 1
};

/// How one value came out. One that is refused is not good either.
struct Trial {
  bool good = false;
  Outcome outcome = Outcome::accurate;
  std::string why;
};

/// What a search has found so far.
struct FoundLimit {
  std::optional<double> good;   ///< the last good value; none where none is good
  std::optional<double> bad;    ///< the first bad one beyond it; none where all are good
  Trial beyond;                 ///< how it comes out at `bad`
  std::vector<double> islands;  ///< bad values between the good end and `good`
  std::vector<double> strays;   ///< good values beyond `bad`
  std::string refusal;          ///< why, where every value of the scan was refused
};

/// Looks for the border between good and bad values; whoever runs it makes the trials, so that many
/// searches can have theirs made together.
///
/// First a scan of the whole range, at equal ratios. Its longest run of good values, of equally
/// long ones the nearest to the good end, is the good region: a single value that is good by
/// chance among bad ones is no limit, and a single bad one at the good end is not all there is.
/// Then the interval between the region's far end and the bad value beyond it is cut at equal
/// ratios into three, and so on.
class LimitSearch {
 public:
  explicit LimitSearch(const LimitRange& range);

  /// The values to be tried next; none at the end.
  const std::vector<double>& wanted() const { return wanted_; }
  /// One trial for each of wanted(), in its order.
  void tell(std::span<const Trial> trials);
  bool is_done() const { return wanted_.empty(); }

  FoundLimit found() const;
  /// No search takes more trials than this from now on.
  std::size_t most_trials_left() const;

 private:
  struct Tried {
    double value = 0;
    Trial trial;
  };

  void choose_region();
  void section();

  LimitRange range_;
  std::vector<double> wanted_;
  std::vector<Tried> tried_;  ///< from the good end on
  std::optional<std::size_t> good_, bad_;
};

}  // namespace slipcheck
