#pragma once

#include <span>
#include <string>

namespace slipcheck {

/// A figure as the page shows it.
struct FigureOnPage {
  std::string name;     ///< of its files, "K5"
  std::string title;    ///< as plot_text.h
  std::string caption;  ///< likewise
  std::string svg;      ///< figure_svg()
};

/// One self-contained page with all figures, their captions and links to the files beside it.
/// `command` is what made it.
std::string figure_page(std::span<const FigureOnPage> figures, const std::string& introduction,
                        const std::string& command);

}  // namespace slipcheck
