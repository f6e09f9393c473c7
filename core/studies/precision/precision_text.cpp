#include <fmt/format.h>

#include <cmath>

#include "studies/precision/precision.h"

namespace slipcheck {

std::string label_of(const MethodCurve& curve) {
  switch (curve.kind) {
    case MethodCurve::Kind::engine: {
      const std::string label =
          fmt::format("{} {} {}", curve.engine, curve.precision, curve.profile);
      return curve.iterations ? fmt::format("{}, {:g} iterations", label, *curve.iterations)
                              : label;
    }
    case MethodCurve::Kind::contact:
      return "contact";
    case MethodCurve::Kind::fixed_step:
      return "fixed step";
    case MethodCurve::Kind::event:
      return "event";
  }
  return "";
}

std::string words_of(const Convergence& convergence) {
  switch (convergence.kind) {
    case Convergence::Kind::exact:
      return fmt::format("exact to {:.1g}", convergence.largest);
    case Convergence::Kind::converges:
      if (std::isnan(convergence.order)) return "converges at once";
      if (std::isnan(convergence.order_error))
        return fmt::format("order {:.2f}", convergence.order);
      return fmt::format("order {:.2f} ± {:.2f}", convergence.order, convergence.order_error);
    case Convergence::Kind::does_not_converge:
      return "does not converge";
    case Convergence::Kind::unknown:
      return "too few points tell";
  }
  return "";
}

}  // namespace slipcheck
