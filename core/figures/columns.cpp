#include "figures/columns.h"

#include <cmath>
#include <cstddef>

namespace slipcheck {

std::vector<double> equally_spaced(double first, double last, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k)
    values[k] = first + (last - first) * static_cast<double>(k) / static_cast<double>(count - 1);
  return values;
}

std::vector<double> logarithmically_spaced(double first, double last, std::size_t count) {
  std::vector<double> values = equally_spaced(std::log(first), std::log(last), count);
  for (double& value : values) value = std::exp(value);
  return values;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) result[k] = a[k] - b[k];
  return result;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

}  // namespace slipcheck
