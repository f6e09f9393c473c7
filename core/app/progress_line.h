#pragma once

#include <functional>
#include <string>
#include <thread>

namespace slipcheck {

/// Whether a line on stderr stays where it is and vanishes at the end, as on a terminal, or is
/// followed by others, as in a log.
enum class LinePlace { stays, follows };

/// Shows on stderr how far a longer piece of work has come, as long as it lives: first after a
/// second and then five times a second in one place, or every half minute in a log. Where there is
/// no memory or no thread for it the work goes on unseen.
class ProgressLine {
 public:
  /// `text`: what stands there after so many seconds; called from a thread of its own.
  ProgressLine(std::function<std::string(double seconds)> text, LinePlace place);

 private:
  std::jthread ticker_;
};

}  // namespace slipcheck
