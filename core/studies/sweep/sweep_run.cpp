#include "studies/sweep/sweep_run.h"

#include <chrono>
#include <memory>
#include <mutex>
#include <utility>

#include "base/in_parallel.h"
#include "engine/worker_pool.h"
#include "harness/run/engine_work.h"
#include "harness/run/requested_runs.h"
#include "scenario/content_digest.h"
#include "studies/sweep/sweep_scenes.h"

namespace slipcheck {
namespace {

using Clock = std::chrono::steady_clock;
using Kind = SweepParameter::Kind;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

SqliteValue stored(const Setting& setting) {
  if (const bool* flag = std::get_if<bool>(&setting)) return std::int64_t{*flag ? 1 : 0};
  if (const double* number = std::get_if<double>(&setting)) return *number;
  return std::get<std::string>(setting);
}

/// What stands there, where it is no number: a word, or lists and mappings as JSON.
SqliteValue stored(const YamlNode& node) {
  return node.kind == YamlNode::Kind::scalar ? node.text : content_text(node);
}

/// What a run was made with, of scene and settings.
std::vector<SqliteValue> values_of(const SweepPlan& plan, std::uint64_t run,
                                   const SweepChoice& choice, const SweepScene* scene) {
  std::vector<SqliteValue> values;
  for (std::size_t k = 0; k < plan.parameters().size(); ++k) {
    const SweepParameter& parameter = plan.parameters()[k];
    if (parameter.kind == Kind::setting)
      values.push_back(stored(choice.settings.at(parameter.setting)));
    if (parameter.kind != Kind::scene) continue;
    std::optional<ReadNumber> number;
    if (scene != nullptr) number = scene->numbers.at(parameter.path.text());
    values.push_back(number ? SqliteValue(number->value) : stored(*plan.value(run, k)));
  }
  return values;
}

/// One run of an engine, from when a thread has time for it to when it is kept.
class EngineSweepRun {
 public:
  EngineSweepRun(const SweepSetup& setup, const SweepOptions& options, SweepScenes& scenes,
                 std::uint64_t run)
      : setup_(setup),
        scenes_(scenes),
        run_(run),
        choice_(setup.plan().choice(run)),
        record_(setup.record_of(choice_)) {
    options_.phases = choice_.phases;
    options_.time_limit = options.time_limit;
    options_.limits = options.limits;
  }

  void work(RemoteEngine& engine) {
    scene_ = scenes_.of(run_);
    if (!scene_->prepared) throw Refused(scene_->refused);
    choose_headings(scene_->prepared->scenario, record_);
    work_.emplace(EngineTask{&*scene_->prepared, &record_, nullptr}, options_, 1);
    work_->run(engine, 0);
  }

  FinishedRun finished(const JobResult& result) {
    if (work_) {
      work_->settle({&result, 1});
    } else {
      record_.status = status_of(result.status);
      record_.reason = result.reason;
    }
    FinishedRun finished;
    finished.run = run_;
    finished.scene = setup_.plan().scene_id(run_);
    finished.phases = choice_.phases;
    finished.parameters = values_of(setup_.plan(), run_, choice_, scene_.get());
    finished.record = &record_;
    finished.status = record_.status;
    finished.reason = record_.reason;
    finished.seconds = seconds_since(begin_);
    if (scene_ && scene_->prepared) {
      finished.scenario = &scene_->prepared->scenario;
      finished.reference = &scene_->prepared->reference;
    }
    return finished;
  }

 private:
  const SweepSetup& setup_;
  SweepScenes& scenes_;
  std::uint64_t run_;
  SweepChoice choice_;
  EngineRecord record_;
  RunOptions options_;
  Clock::time_point begin_ = Clock::now();
  std::shared_ptr<const SweepScene> scene_;
  std::optional<EngineWork> work_;
};

FinishedRun reference_run(const SweepSetup& setup, SweepScenes& scenes, std::uint64_t run,
                          std::shared_ptr<const SweepScene>& scene) {
  const Clock::time_point begin = Clock::now();
  scene = scenes.of(run);
  FinishedRun finished;
  finished.run = run;
  finished.scene = setup.plan().scene_id(run);
  finished.parameters = values_of(setup.plan(), run, {}, scene.get());
  finished.reason = scene->refused;
  if (scene->prepared) {
    finished.scenario = &scene->prepared->scenario;
    finished.reference = &scene->prepared->reference;
    finished.reason = finished.reference->run.reason;
    if (!finished.reference->run.failed) finished.status = EngineRecord::Status::ok;
  }
  finished.seconds = seconds_since(begin);
  return finished;
}

bool is_set(const std::atomic<bool>* stop) { return stop != nullptr && *stop; }

}  // namespace

void run_sweep(const SweepSetup& setup, const SweepOptions& options,
               const std::function<std::optional<std::uint64_t>()>& next,
               const std::function<void(const FinishedRun&)>& keep) {
  WorkerPool pool(options.workers, options.limits);
  SweepScenes scenes(setup.plan(), pool.threads() + 4, options.time_limit);
  if (setup.plan().is_reference_alone()) {
    std::mutex asking;
    const auto asked = [&]() -> std::optional<std::uint64_t> {
      const std::scoped_lock lock(asking);
      return is_set(options.stop) ? std::nullopt : next();
    };
    const StopScope scope(options.stop);
    in_parallel(pool.threads(), pool.threads(), [&](std::size_t) {
      std::shared_ptr<const SweepScene> scene;
      try {
        while (const auto run = asked()) keep(reference_run(setup, scenes, *run, scene));
      } catch (const Interrupted&) {  // the rest is for another time
      }
    });
    return;
  }
  const auto offer = [&]() -> std::optional<OfferedJob> {
    const std::optional<std::uint64_t> run = next();
    if (!run) return std::nullopt;
    auto job = std::make_shared<EngineSweepRun>(setup, options, scenes, *run);
    const WorkerCommand& command = setup.engine(setup.plan().choice(*run)).command;
    return OfferedJob{{command, [job](RemoteEngine& engine) { job->work(engine); }},
                      [job, &keep, &options](const JobResult& result) {
                        // What was interrupted is made another time.
                        if (is_set(options.stop) && result.status != JobResult::Status::ok) return;
                        keep(job->finished(result));
                      }};
  };
  pool.run_offered(offer, options.stop);
}

std::pair<std::uint64_t, std::uint64_t> shard_of(std::uint64_t runs, std::uint64_t shard,
                                                 std::uint64_t shards) {
  return {runs * (shard - 1) / shards, runs * shard / shards};
}

}  // namespace slipcheck
