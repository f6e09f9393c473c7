#include "studies/sweep/sweep_scenes.h"

#include <exception>
#include <utility>
#include <vector>

#include "base/stop_scope.h"
#include "scenario/fault.h"
#include "scene/scene.h"

namespace slipcheck {

std::shared_ptr<const SweepScene> SweepScenes::of(std::uint64_t run) {
  const std::uint64_t id = plan_.scene_id(run);
  std::promise<Pointer> promise;
  std::shared_future<Pointer> future;
  bool is_mine = false;
  {
    const std::scoped_lock lock(mutex_);
    const auto [found, is_new] = scenes_.try_emplace(id);
    is_mine = is_new;
    if (is_new) {
      found->second = promise.get_future().share();
      order_.push_back(id);
      if (order_.size() > kept_) {
        scenes_.erase(order_.front());
        order_.pop_front();
      }
    }
    future = found->second;
  }
  if (is_mine) try {
      promise.set_value(solved(run));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  return future.get();
}

SweepScenes::Pointer SweepScenes::solved(std::uint64_t run) const {
  auto scene = std::make_shared<SweepScene>();
  for (const SweepParameter& parameter : plan_.parameters())
    if (parameter.kind == SweepParameter::Kind::scene) scene->numbers[parameter.path.text()];
  try {
    std::vector<Scenario> scenarios;
    scenarios.push_back(plan_.scene(run, &scene->numbers));
    scene->prepared =
        std::move(prepare_scenes(std::move(scenarios), false, 1, time_limit_).front());
  } catch (const BadScenario& bad) {
    scene->refused = bad.what();
  } catch (const Unsupported& unsupported) {
    scene->refused = unsupported.what();
  }
  heed_stop();  // what was interrupted is no failure of the reference
  return scene;
}

}  // namespace slipcheck
