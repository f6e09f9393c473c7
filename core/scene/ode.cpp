#include "scene/ode.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/stop_scope.h"

namespace slipcheck {
namespace {

/// The last message of CVODE's error handler, kept for the exception.
void keep_message(int, const char*, const char*, char* message, void* target) {
  *static_cast<std::string*>(target) = message;
}

}  // namespace

struct Ode::Memory {
  Memory(std::size_t size, Method method, RightSide side) : right_side(std::move(side)) {
    check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    const auto length = static_cast<sunindextype>(size);
    y = N_VNew_Serial(length, context);
    scratch = N_VNewEmpty_Serial(length, context);
    floor = N_VNew_Serial(length, context);
    N_VConst(0, y);
    cvode = CVodeCreate(method == Method::adams ? CV_ADAMS : CV_BDF, context);
    if (!y || !scratch || !floor || !cvode) throw IntegrationFailure("no memory for CVODE");
    CVodeSetErrHandlerFn(cvode, keep_message, &message);
    check(CVodeInit(cvode, call_right_side, 0, y), "CVodeInit");
    check(CVodeSetUserData(cvode, this), "CVodeSetUserData");
    if (method == Method::adams) {
      iteration = SUNNonlinSol_FixedPoint(y, 0, context);
      check(CVodeSetNonlinearSolver(cvode, iteration), "CVodeSetNonlinearSolver");
    } else {
      jacobian = SUNDenseMatrix(length, length, context);
      linear = SUNLinSol_Dense(y, jacobian, context);
      check(CVodeSetLinearSolver(cvode, linear, jacobian), "CVodeSetLinearSolver");
    }
    CVodeSetMaxNumSteps(cvode, -1);
    CVodeSetMaxErrTestFails(cvode, 50);
    CVodeSetMaxConvFails(cvode, 100);
    CVodeSetMaxHnilWarns(cvode, -1);
    CVodeSetNoInactiveRootWarn(cvode);
  }

  ~Memory() {
    if (cvode) CVodeFree(&cvode);
    if (iteration) SUNNonlinSolFree(iteration);
    if (linear) SUNLinSolFree(linear);
    if (jacobian) SUNMatDestroy(jacobian);
    for (N_Vector vector : {y, scratch, floor})
      if (vector) N_VDestroy(vector);
    if (context) SUNContext_Free(&context);
  }

  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  void check(int flag, const char* what) const {
    if (flag < 0)
      throw IntegrationFailure(std::string(what) + ": " +
                               (message.empty() ? "error " + std::to_string(flag) : message));
  }

  static int call_right_side(realtype t, N_Vector state, N_Vector rate, void* self) {
    Memory& m = *static_cast<Memory*>(self);
    m.right_side(m.origin + t, N_VGetArrayPointer(state), N_VGetArrayPointer(rate));
    return 0;
  }

  static int call_roots(realtype t, N_Vector state, realtype* value, void* self) {
    Memory& m = *static_cast<Memory*>(self);
    m.functions(m.origin + t, N_VGetArrayPointer(state), value);
    return 0;
  }

  RightSide right_side;
  RootFunctions functions;
  SUNContext context = nullptr;
  void* cvode = nullptr;
  N_Vector y = nullptr, scratch = nullptr, floor = nullptr;
  SUNNonlinearSolver iteration = nullptr;
  SUNMatrix jacobian = nullptr;
  SUNLinearSolver linear = nullptr;
  std::string message;
  // CVODE counts time from the last start: it finds roots to some units in the last place of that.
  double origin = 0, now = 0, before = 0;
  bool at_limit = false;  // then the time is that very number, without rounding
  double limit = 0;
  std::vector<int> direction, found;
  std::size_t steps_before = 0;
};

Ode::Ode(std::size_t size, Method method, RightSide right_side)
    : memory_(std::make_unique<Memory>(size, method, std::move(right_side))) {}
Ode::~Ode() = default;
Ode::Ode(Ode&&) noexcept = default;
Ode& Ode::operator=(Ode&&) noexcept = default;

void Ode::watch(std::size_t count, RootFunctions functions, std::span<const int> direction) {
  Memory& m = *memory_;
  m.functions = std::move(functions);
  m.direction.assign(direction.begin(), direction.end());
  m.found.assign(count, 0);
  m.check(CVodeRootInit(m.cvode, static_cast<int>(count), Memory::call_roots), "CVodeRootInit");
  if (count > 0)
    m.check(CVodeSetRootDirection(m.cvode, m.direction.data()), "CVodeSetRootDirection");
}

void Ode::start(double t, std::span<const double> y, double tolerance,
                std::span<const double> floor) {
  Memory& m = *memory_;
  m.steps_before = steps();
  std::copy(y.begin(), y.end(), N_VGetArrayPointer(m.y));
  std::copy(floor.begin(), floor.end(), N_VGetArrayPointer(m.floor));
  m.check(CVodeReInit(m.cvode, 0, m.y), "CVodeReInit");
  m.check(CVodeSVtolerances(m.cvode, tolerance, m.floor), "CVodeSVtolerances");
  m.origin = t;
  m.now = m.before = 0;
}

Ode::Stop Ode::step(double limit) {
  heed_stop();
  Memory& m = *memory_;
  m.message.clear();
  m.before = m.now;
  m.at_limit = false;
  std::fill(m.found.begin(), m.found.end(), 0);
  const double stop = limit - m.origin;
  m.check(CVodeSetStopTime(m.cvode, stop), "CVodeSetStopTime");
  const int flag = CVode(m.cvode, stop, m.y, &m.now, CV_ONE_STEP);
  m.check(flag, "CVode");
  if (flag == CV_ROOT_RETURN) {
    CVodeGetRootInfo(m.cvode, m.found.data());
    return Stop::root;
  }
  m.at_limit = flag == CV_TSTOP_RETURN;
  m.limit = limit;
  return m.at_limit ? Stop::limit : Stop::step;
}

double Ode::time() const {
  return memory_->at_limit ? memory_->limit : memory_->origin + memory_->now;
}

std::span<const double> Ode::y() const {
  return {N_VGetArrayPointer(memory_->y),
          static_cast<std::size_t>(N_VGetLength_Serial(memory_->y))};
}

void Ode::dense(double t, std::span<double> y) const {
  Memory& m = *memory_;
  N_VSetArrayPointer(y.data(), m.scratch);
  m.check(CVodeGetDky(m.cvode, std::clamp(t - m.origin, m.before, m.now), 0, m.scratch),
          "CVodeGetDky");
}

std::span<const int> Ode::roots_found() const { return memory_->found; }

std::size_t Ode::steps() const {
  long steps = 0;
  CVodeGetNumSteps(memory_->cvode, &steps);
  return memory_->steps_before + static_cast<std::size_t>(steps);
}

}  // namespace slipcheck
