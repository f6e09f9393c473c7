#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

namespace slipcheck {

/// A system ẏ = f(t, y) that CVODE integrates between events, with dense output and roots.
class Ode {
 public:
  using RightSide = std::function<void(double t, const double* y, double* rate)>;
  using RootFunctions = std::function<void(double t, const double* y, double* value)>;

  enum class Method {
    adams,  ///< orders up to 12, functional iteration: what is not stiff
    bdf,    ///< orders up to 5, Newton with a dense Jacobian: stiff friction laws
  };

  Ode(std::size_t size, Method method, RightSide right_side);
  ~Ode();
  Ode(Ode&&) noexcept;
  Ode& operator=(Ode&&) noexcept;

  /// Starts anew at (t, y), the end of the last stretch forgotten. tolerance: relative;
  /// `floor`: absolute, by component, in its unit.
  void start(double t, std::span<const double> y, double tolerance, std::span<const double> floor);

  /// Roots to stop at from the next start() on: `count` functions; direction −1 stops where a
  /// function falls through zero, +1 where it rises, 0 either way.
  void watch(std::size_t count, RootFunctions functions, std::span<const int> direction);

  enum class Stop { step, root, limit };
  /// One step of the integrator's own choosing, to the first root or to `limit` at most. Throws
  /// IntegrationFailure.
  Stop step(double limit);

  double time() const;                ///< now [s]
  std::span<const double> y() const;  ///< now
  /// y at a time inside the last step.
  void dense(double t, std::span<double> y) const;
  /// For each watched function, whether it stopped the last step: 0, or −1 falling, +1 rising.
  std::span<const int> roots_found() const;
  std::size_t steps() const;  ///< since the making

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// The integrator could not go on; the message says why.
struct IntegrationFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace slipcheck
