#pragma once

#include <span>
#include <string_view>

#include "figures/paper_figure.h"

namespace slipcheck {

class PaperFigureMaker {
 public:
  constexpr PaperFigureMaker(std::string_view of, PaperFigure (*figure)())
      : name(of), figure_(figure) {}
  /// One whose cost is a choice.
  constexpr PaperFigureMaker(std::string_view of, PaperFigure (*figure)(Effort))
      : name(of), long_figure_(figure) {}

  PaperFigure make(Effort effort) const { return figure_ ? figure_() : long_figure_(effort); }

  std::string_view name;

 private:
  PaperFigure (*figure_)() = nullptr;
  PaperFigure (*long_figure_)(Effort) = nullptr;
};

/// All figures in the papers' order.
std::span<const PaperFigureMaker> paper_figures();

/// What a page with them says first.
extern const char* const kPaperFiguresIntroduction;

}  // namespace slipcheck
