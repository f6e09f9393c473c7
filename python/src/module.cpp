// slipcheck._reference: what slipcheck/reference.py and slipcheck/physics.py word for people.

#include <pybind11/stl.h>

#include "base/stop_scope.h"
#include "scenario/fault.h"
#include "scene.h"
#include "scene/scene.h"

namespace slipcheck::python {
namespace {

/// A BadScenario as slipcheck.SceneError with `faults`: of each a dict of what it has.
void translate_faults(const py::object& type, const BadScenario& bad) {
  py::list faults;
  for (const Fault& fault : bad.faults()) {
    py::dict each;
    each["file"] = fault.file;
    each["line"] = fault.location.line;
    each["column"] = fault.location.column;
    each["key"] = fault.key;
    each["rule"] = fault.rule;
    each["value"] = fault.value;
    faults.append(each);
  }
  const py::object error = type(bad.what());
  error.attr("faults") = faults;
  PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace
}  // namespace slipcheck::python

PYBIND11_MODULE(_reference, module) {
  namespace py = pybind11;
  using namespace slipcheck;
  module.doc() =
      "Slipcheck's reference as it is compiled; see slipcheck.reference and slipcheck.physics.";
  static const auto* const scene_error =
      new py::object(py::module_::import("slipcheck.errors").attr("SceneError"));
  static const auto* const unsupported =
      new py::object(py::module_::import("slipcheck.errors").attr("UnsupportedScene"));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const BadScenario& bad) {
      python::translate_faults(*scene_error, bad);
    } catch (const Unsupported& bad) {
      PyErr_SetString(unsupported->ptr(), bad.what());
    } catch (const OutOfTime& late) {
      PyErr_SetString(PyExc_TimeoutError, late.what());
    }
  });
  auto scene = python::add_scene(module);
  python::add_batches(scene);
  python::add_laws(module);
}
