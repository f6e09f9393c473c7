#pragma once

#include <span>
#include <string_view>

#include "figures/paper_figure.h"

namespace slipcheck {

struct PaperFigureMaker {
  std::string_view name;
  PaperFigure (*make)();
};

/// All figures in the papers' order.
std::span<const PaperFigureMaker> paper_figures();

/// What a page with them says first.
extern const char* const kPaperFiguresIntroduction;

}  // namespace slipcheck
