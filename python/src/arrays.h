#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "physics/vector.h"

namespace slipcheck::python {

namespace py = pybind11;

/// Doubles in C order; of other arrays a copy that is that.
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

inline std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t k = 0; k < array.ndim(); ++k)
    text += (k == 0 ? "" : ", ") + std::to_string(array.shape(k));
  return text + ")";
}

/// Throws ValueError with the array's name, the shape that it must have, where -1 is any, and its
/// own.
inline void check_shape(const char* name, const py::array& array,
                        const std::vector<py::ssize_t>& shape) {
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  std::string rule = "(";
  for (std::size_t k = 0; k < shape.size(); ++k) {
    fits = fits && (shape[k] < 0 || array.shape(static_cast<py::ssize_t>(k)) == shape[k]);
    rule += (k == 0 ? "" : ", ") + (shape[k] < 0 ? std::string("n") : std::to_string(shape[k]));
  }
  if (!fits)
    throw py::value_error(std::string(name) + ": must have the shape " + rule + "), got " +
                          shape_text(array));
}

/// Throws ValueError with the array's name, the place and the value of the first that is not
/// finite.
inline void check_finite(const char* name, const Array& array) {
  const double* data = array.data();
  for (py::ssize_t k = 0; k < array.size(); ++k)
    if (!std::isfinite(data[k]))
      throw py::value_error(std::string(name) + ": must be finite, got " + std::to_string(data[k]) +
                            " at the flat index " + std::to_string(k));
}

inline Vector3 vector_at(const double* data) { return {data[0], data[1], data[2]}; }
inline void put_vector(const Vector3& v, double* data) {
  for (int k = 0; k < 3; ++k) data[k] = v[k];
}

}  // namespace slipcheck::python
