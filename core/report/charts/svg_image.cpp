#include "report/charts/svg_image.h"

#include <fmt/format.h>

#include "report/charts/plot_text.h"
#include "report/html/html_text.h"

namespace slipcheck {

std::string svg_image(double width, double height, const std::string& name,
                      const std::string& title, const std::string& description,
                      const std::string& body) {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" "
             "width=\"{0:g}\" height=\"{1:g}\" role=\"img\" aria-labelledby=\"{2}-title\" "
             "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"12\" "
             "fill=\"#1b1b1b\">\n<title id=\"{2}-title\">{3}</title>\n<desc>{4}</desc>\n"
             "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#ffffff\"/>\n",
             width, height, escaped(name), escaped(plain_plot_text(title)),
             escaped(plain_plot_text(description))) +
         body + "</svg>\n";
}

}  // namespace slipcheck
