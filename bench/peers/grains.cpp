// grains N AREA_FRACTION gas|monolayer SEED WARM STEPS THREADS DATA: writes the grains of a peer's
// run as its data file, runs them for WARM and then STEPS steps, three times, and prints
// "particle_steps_per_second kinetic_energy_per_grain"; of CPU time on one thread, of wall time on
// several. Few grains are one thread's, as they are in a run.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "bench/grain_gas.h"
#include "reference/steps/grain_solver.h"
#include "reference/steps/step_solver.h"

namespace slipcheck::bench {
namespace {

void write_data(const ContactScene& scene, bool on_plane, const std::string& path) {
  const Scene& hard = scene.hard;
  std::ofstream file(path);
  file.precision(17);
  // A grain rests on the peer's soft wall at z = R − m g/k.
  const double z = on_plane ? 0.4999 : 0;
  file << "grains\n\n"
       << hard.bodies.size() << " atoms\n1 atom types\n0 " << hard.periodic.x() << " xlo xhi\n0 "
       << hard.periodic.y() << " ylo yhi\n"
       << (on_plane ? "0 3" : "-0.5 0.5") << " zlo zhi\n\nAtoms # sphere\n\n";
  const auto folded = [](double x, double length) { return x - length * std::floor(x / length); };
  for (std::size_t i = 0; i < hard.bodies.size(); ++i)
    file << i + 1 << " 1 1.0 1.909859317102744 "
         << folded(hard.initial[i].position.x(), hard.periodic.x()) << ' '
         << folded(hard.initial[i].position.y(), hard.periodic.y()) << ' ' << z << '\n';
  file << "\nVelocities\n\n";
  for (std::size_t i = 0; i < hard.bodies.size(); ++i)
    file << i + 1 << ' ' << hard.initial[i].velocity.x() << ' ' << hard.initial[i].velocity.y()
         << " 0 0 0 0\n";
}

double seconds(clockid_t clock) {
  timespec time;
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int run(int count, char** arguments) {
  if (count != 9) {
    std::fputs("usage: grains N AREA_FRACTION gas|monolayer SEED WARM STEPS THREADS DATA\n",
               stderr);
    return 2;
  }
  const auto n = std::strtoul(arguments[1], nullptr, 10);
  const bool on_plane = std::string(arguments[3]) == "monolayer";
  const auto seed = std::strtoul(arguments[4], nullptr, 10);
  const auto warm = std::strtoul(arguments[5], nullptr, 10);
  const auto steps = std::strtoul(arguments[6], nullptr, 10);
  const auto threads = std::strtoul(arguments[7], nullptr, 10);
  const clockid_t clock = threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
  const ContactScene scene = grain_gas(n, std::strtod(arguments[2], nullptr), on_plane, seed);
  write_data(scene, on_plane, arguments[8]);
  double least = 1e300, energy = 0;
  for (int repeat = 0; repeat < 3; ++repeat) {
    GrainSolver solver(scene, scene.hard.initial, kStep,
                       sharing_threads(scene, scene.hard.initial, {.threads = threads}));
    solver.advance(warm);
    const double begin = seconds(clock);
    solver.advance(steps);
    least = std::min(least, seconds(clock) - begin);
    Frame frame;
    solver.show(frame);
    energy = 0;
    for (const BodyState& state : frame.bodies) energy += 0.5 * state.velocity.squaredNorm();
  }
  std::printf("%.6g %.10g\n", static_cast<double>(n * steps) / least,
              energy / static_cast<double>(n));
  return 0;
}

}  // namespace
}  // namespace slipcheck::bench

int main(int count, char** arguments) { return slipcheck::bench::run(count, arguments); }
