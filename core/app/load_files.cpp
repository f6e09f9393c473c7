#include "app/load_files.h"

#include <map>

#include "scenario/fault.h"
#include "scenario/load.h"

namespace slipcheck {

std::vector<Scenario> load_files(const std::vector<std::string>& files) {
  std::vector<Scenario> scenarios;
  std::vector<Fault> faults;
  std::map<std::string, std::string> file_of_name;
  for (const std::string& file : files) {
    try {
      Scenario scenario = load_scenario(file);
      const auto [earlier, is_new] = file_of_name.emplace(scenario.name, file);
      if (!is_new) {
        const auto place = scenario.locations.find("name");
        faults.push_back({file, place == scenario.locations.end() ? Location{} : place->second,
                          "name", "must be unique among scenarios, " + earlier->second + " has it",
                          scenario.name});
      }
      scenarios.push_back(std::move(scenario));
    } catch (const BadScenario& bad) {
      faults.insert(faults.end(), bad.faults().begin(), bad.faults().end());
    }
  }
  if (!faults.empty()) throw BadScenario(std::move(faults));
  return scenarios;
}

}  // namespace slipcheck
