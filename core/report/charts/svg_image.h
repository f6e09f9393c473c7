#pragma once

#include <string>

namespace slipcheck {

/// A static image in SVG on a light ground, fit for a paper and for a page. `name` makes its ids
/// unique; title and description, as plot_text.h, are what a screen reader says of it.
std::string svg_image(double width, double height, const std::string& name,
                      const std::string& title, const std::string& description,
                      const std::string& body);

}  // namespace slipcheck
