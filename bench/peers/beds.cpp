// beds N RATIO WARM STEPS THREADS DATA: writes spheres that fall into a container as a peer's data
// file, runs them for WARM and then STEPS steps, and prints "particle_steps_per_second
// mean_height [m] kinetic_energy [J] cpu_seconds" and the peer's constants "step kn gamma side".
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "bench/soft_bed.h"
#include "reference/piles/pile_solver.h"

namespace slipcheck::bench {
namespace {

void write_data(const ContactScene& scene, double side, const std::string& path) {
  const Scene& hard = scene.hard;
  double top = 0;
  for (const BodyState& state : hard.initial) top = std::max(top, state.position.z());
  std::ofstream file(path);
  file.precision(17);
  file << "bed\n\n"
       << hard.bodies.size() << " atoms\n1 atom types\n0 " << side << " xlo xhi\n0 " << side
       << " ylo yhi\n-0.01 " << 1.2 * top + 0.05 << " zlo zhi\n\nAtoms # sphere\n\n";
  for (std::size_t i = 0; i < hard.bodies.size(); ++i) {
    const Sphere& s = hard.bodies[i];
    const Vector3& x = hard.initial[i].position;
    file << i + 1 << " 1 " << 2 * s.radius << ' '
         << s.mass / (4 * M_PI / 3 * s.radius * s.radius * s.radius) << ' ' << x.x() << ' ' << x.y()
         << ' ' << x.z() << '\n';
  }
  file << "\nVelocities\n\n";
  for (std::size_t i = 0; i < hard.bodies.size(); ++i) {
    const Vector3& v = hard.initial[i].velocity;
    file << i + 1 << ' ' << v.x() << ' ' << v.y() << ' ' << v.z() << " 0 0 0\n";
  }
}

int run(int count, char** arguments) {
  if (count != 7) {
    std::fputs("usage: beds N RATIO WARM STEPS THREADS DATA\n", stderr);
    return 2;
  }
  const auto number = [&](int k) { return std::strtoul(arguments[k], nullptr, 10); };
  SoftBed bed;
  bed.count = number(1);
  bed.ratio = std::strtod(arguments[2], nullptr);
  const auto warm = number(3), steps = number(4);
  const ContactScene scene = soft_bed(bed);
  const double side = scene.hard.surfaces.empty()
                          ? scene.hard.periodic.x()
                          : std::get<PlaneShape>(scene.hard.surfaces[3].shape).point.x();
  write_data(scene, side, arguments[6]);
  const double step = bed.collision_time / 50;
  PileSolver solver(scene, scene.hard.initial, {.step = step, .threads = number(5)});
  const auto run_to = [&](std::size_t n) {
    const SolvedRun run = solver.run(until_time(static_cast<double>(n) * step), nullptr);
    if (run.reached) return;
    std::fprintf(stderr, "%s\n", run.reason.c_str());
    std::exit(3);
  };
  run_to(warm);
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  run_to(warm + steps);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double busy = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  double height = 0, mass = 0, energy = 0;
  const std::vector<BodyState> states = solver.states();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double m = scene.hard.bodies[i].mass;
    mass += m;
    height += m * states[i].position.z();
    energy += 0.5 * m * states[i].velocity.squaredNorm();
  }
  const LinearForce& law = std::get<LinearForce>(scene.soft[0]->normal);
  const double m = 2500 * 4 * M_PI / 3 * std::pow(5e-3, 3);
  std::printf("%.6g %.12g %.10g %.6g %.17g %.17g %.17g %.17g\n",
              static_cast<double>(bed.count * steps) / seconds, height / mass, energy, busy, step,
              law.stiffness, law.damping / (0.5 * m), side);
  return 0;
}

}  // namespace
}  // namespace slipcheck::bench

int main(int count, char** arguments) { return slipcheck::bench::run(count, arguments); }
