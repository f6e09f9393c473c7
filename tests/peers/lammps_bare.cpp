#include "lammps_bare.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace slipcheck::test {
namespace {

namespace folders = std::filesystem;

std::string three(const Vector3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::vector<std::vector<BodyState>> frames_of(const folders::path& dump, std::size_t bodies) {
  std::vector<std::vector<BodyState>> frames;
  std::ifstream in(dump);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("ITEM: ATOMS")) continue;
    std::vector<BodyState>& frame = frames.emplace_back(bodies);
    for (BodyState& s : frame) {
      std::getline(in, line);
      std::istringstream words(line);
      int number = 0;
      words >> number;
      for (Vector3* v : {&s.position, &s.velocity, &s.angular_velocity})
        words >> v->x() >> v->y() >> v->z();
    }
  }
  return frames;
}

}  // namespace

std::string HistoryLaw::words() const {
  return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} 1 limit_damping", k_n, k_t, gamma_n,
                     gamma_t, friction);
}

SoftContact HistoryLaw::contact(double mass, double radius) const {
  SoftContact made;
  made.end = ContactEnd::zero_force;
  SpringFriction sliding;
  sliding.static_friction = sliding.kinetic_friction = friction;
  // hertz/history: all of it times √(R_eff ξ).
  const double unit = hertz ? std::sqrt(radius) : 1;
  if (hertz) {
    const double rho = k_n * unit;
    made.normal = ViscoelasticForce{rho, gamma_n * mass * unit / (1.5 * rho)};
    sliding.form = SpringFriction::Form::mindlin_displacement;
    sliding.damping_ratio = gamma_n > 0 ? gamma_t / gamma_n : 0;
  } else {
    made.normal = LinearForce{k_n, gamma_n * mass};
    sliding.damping = gamma_t * mass;
  }
  sliding.stiffness = k_t * unit;
  made.memory = ContactMemory{sliding, {}, {}};
  return made;
}

std::string bare_atoms(const Scene& scene, const std::pair<Vector3, Vector3>& box) {
  std::string text =
      "units si\natom_style sphere\nboundary s s s\nnewton off\n"
      "comm_modify mode single vel yes\n";
  const auto& [low, high] = box;
  text += fmt::format(
      "region box block {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\ncreate_box 1 box\n",
      low.x(), high.x(), low.y(), high.y(), low.z(), high.z());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyState& s = scene.initial[i];
    text += fmt::format(
        "create_atoms 1 single {} units box\n"
        "set atom {} diameter {:.17g} mass {:.17g} vx {:.17g} vy {:.17g} vz {:.17g} omega {}\n",
        three(s.position), i + 1, 2 * scene.bodies[i].radius, scene.bodies[i].mass, s.velocity.x(),
        s.velocity.y(), s.velocity.z(), three(s.angular_velocity));
  }
  return text;
}

std::vector<std::vector<BodyState>> bare_lammps(const std::string& input, double step, int steps,
                                                int every, std::size_t bodies) {
  const auto folder = folders::temp_directory_path() / fmt::format("slipcheck-bare-{}", getpid());
  folders::create_directories(folder);
  std::ofstream in(folder / "in.bare");
  in << input << fmt::format("timestep {:.17g}\n", step)
     << fmt::format("dump 1 all custom {} dump id x y z vx vy vz omegax omegay omegaz\n", every)
     << "dump_modify 1 format float %.17g sort id\n"
     << fmt::format("run {}\n", steps);
  in.close();
  const std::string command = fmt::format(
      "cd {} && OMPI_MCA_orte_create_session_dirs=0 lmp -log none -in in.bare > out.txt 2>&1",
      folder.string());
  EXPECT_EQ(std::system(command.c_str()), 0);
  auto frames = frames_of(folder / "dump", bodies);
  folders::remove_all(folder);
  EXPECT_EQ(frames.size(), static_cast<std::size_t>(steps / every) + 1);
  // A run that failed is not like any other.
  if (frames.empty()) frames.emplace_back(bodies);
  return frames;
}

}  // namespace slipcheck::test
