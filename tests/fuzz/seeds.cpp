// fuzz_seeds protocol|settings|store|result FOLDER: what those targets begin with that read no
// bundled file.

#include <filesystem>
#include <fstream>
#include <iostream>
#include <string_view>

#include "../engine/some_scene.h"
#include "../report/read_records.h"
#include "../sweep/some_store.h"
#include "engine/protocol.h"
#include "engine/setting_json.h"
#include "report/json/json_report.h"

namespace {

using namespace slipcheck;
using protocol::Bytes;

/// `first` is what the target chooses the reader by.
void write(const std::filesystem::path& folder, int number, char first, const Bytes& message) {
  std::ofstream out(folder / std::to_string(number), std::ios::binary);
  out << first;
  for (std::size_t k = protocol::kPrefix; k < message.size(); ++k) out << char(message[k]);
}

void write_messages(const std::filesystem::path& folder) {
  const Scene scene = some_scene(3);
  Scene on_table = some_scene(1), on_belt = some_scene(1), periodic = some_scene(1);
  on_table.motion = SubstrateMotion::table({{0, {0, 1}}, {1, {0.1, 1}}});
  on_belt.motion = SubstrateMotion::constant({0.1, 0});
  periodic.periodic = {0.1, 0};
  EngineScene packed(scene);
  packed.packed = true;
  int number = 0;
  for (const EngineScene& each :
       {EngineScene(scene), packed, EngineScene(on_table), EngineScene(on_belt),
        EngineScene(periodic), EngineScene(some_box(3))})
    write(folder, number++, 1,
          protocol::encode(
              protocol::Request(protocol::Configure{each, {{"erp", 0.2}, {"on", true}}, 0.01})));
  for (const protocol::Request& request :
       {protocol::Request(protocol::Hello{}),
        protocol::Request(protocol::Start{scene.initial, 0.5}),
        protocol::Request(protocol::Step{100}), protocol::Request(protocol::Skip{100}),
        protocol::Request(protocol::Time{scene.initial, 0.5, 100, 3}),
        protocol::Request(protocol::Quit{})})
    write(folder, number++, 1, protocol::encode(request));
  protocol::Frames frames;
  for (const double part : {0.5, 1.0, 1.0})
    frames.frames.push_back({scene.initial, {{0, kSubstrate, 1}, {0, 2, 0.5}}, part});
  for (const protocol::Reply& reply :
       {protocol::Reply(protocol::Welcome{1, {"bullet", "3.24", "double", some_settings()}}),
        protocol::Reply(protocol::Configured{
            {{{"erp", 0.2}, {"on", true}}, {Lack{"this", "one"}, Lack{"that", ""}}, {"this"}}}),
        protocol::Reply(protocol::Refusal{"no"}), protocol::Reply(protocol::Started{}),
        protocol::Reply(frames), protocol::Reply(protocol::Timed{{1e-6, 2e-6}}),
        protocol::Reply(protocol::Failed{"why"})})
    write(folder, number++, 0, protocol::encode(reply));
}

/// Of runs that ended well, of one that did not, and of none.
void write_stores(const std::filesystem::path& folder) {
  test::fill(folder / "ok.db", {0, 1, 2, 5});
  test::fill(folder / "failed.db", {3}, RunStatus::crashed);
  test::fill(folder / "empty.db", {});
}

void write_results(const std::filesystem::path& folder) {
  SceneRecord lottery = testing::lottery_scene(2);
  lottery.scenario = parse_scenario(testing::kLotteryText, "s.yaml");
  int number = 0;
  for (const SceneRecord& scene : {testing::rich_record(), lottery})
    std::ofstream(folder / (std::to_string(number++) + ".json")) << json_of(scene).dump();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string_view target = argv[1];
  const std::filesystem::path folder = argv[2];
  if (target == "protocol")
    write_messages(folder);
  else if (target == "store")
    write_stores(folder);
  else if (target == "result")
    write_results(folder);
  else
    std::ofstream(folder / "settings.json") << protocol::setting_infos_to_json(some_settings());
  return 0;
}
