// The reference as a library: reads a scene and prints what two rolling spheres keep of their
// relative velocity once both roll again, beside its closed form where one applies.
//   effective_restitution FILE

#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "harness/run/prepared_scene.h"
#include "scenario/fault.h"
#include "scenario/load.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: effective_restitution FILE\n", stderr);
    return 2;
  }
  try {
    std::vector<slipcheck::Scenario> scenarios{slipcheck::load_scenario(argv[1])};
    const auto scenes = slipcheck::prepare_scenes(std::move(scenarios));
    const slipcheck::ReferenceResult& reference = scenes.front().reference;
    for (const auto& [name, seen] : reference.observables) {
      if (!name.ends_with(".effective_restitution")) continue;
      std::printf("%.*s = %.17g +- %.2g", static_cast<int>(name.size()), name.data(), seen.value,
                  seen.uncertainty);
      const auto closed = reference.closed_form.find(name);
      if (closed != reference.closed_form.end()) std::printf(", closed form %.17g", closed->second);
      std::printf("\n");
    }
    return reference.run.reached ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const slipcheck::BadScenario& bad) {
    std::fprintf(stderr, "%s\n", bad.what());
    return 2;
  }
}
