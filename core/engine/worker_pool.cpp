#include "engine/worker_pool.h"

#include <algorithm>
#include <limits>

namespace slipcheck {
namespace {

using JobStatus = JobResult::Status;

JobStatus status_of(const WorkerFailure& failure) {
  return failure.status() == WorkerFailure::Status::timed_out ? JobStatus::timed_out
                                                              : JobStatus::crashed;
}

}  // namespace

/// One thread's workers, at most one for each command.
class WorkerPool::Workers {
 public:
  Workers(const WorkerLimits& limits, const std::atomic<bool>* stop)
      : limits_(limits), stop_(stop) {}

  const std::atomic<bool>* stop() const { return stop_; }

  JobResult run(const EngineJob& job) {
    if (stop_ != nullptr && *stop_) return {JobStatus::skipped, "interrupted", nullptr};
    try {
      job.work(engine_for(job.command));
      return {JobStatus::ok, "", nullptr};
    } catch (const WorkerFailure& failure) {
      return {status_of(failure), failure.what(), std::current_exception()};
    } catch (const Interrupted& interrupted) {
      return {JobStatus::skipped, interrupted.what(), std::current_exception()};
    } catch (const OutOfTime& late) {
      return {JobStatus::timed_out, late.what(), std::current_exception()};
    } catch (const Refused& refused) {
      return {JobStatus::skipped, refused.what(), std::current_exception()};
    } catch (const std::exception& error) {
      return {JobStatus::failed, error.what(), std::current_exception()};
    } catch (...) {
      return {JobStatus::failed, "threw something that is no exception", std::current_exception()};
    }
  }

 private:
  RemoteEngine& engine_for(const WorkerCommand& command) {
    std::unique_ptr<RemoteEngine>& engine = engines_[command];
    if (!engine || !engine->alive()) {
      engine.reset();
      engine = std::make_unique<RemoteEngine>(command, limits_, stop_);
    }
    engine->limit_run(std::numeric_limits<double>::infinity());  // an earlier job's is void
    return *engine;
  }

  WorkerLimits limits_;
  const std::atomic<bool>* stop_;
  std::map<WorkerCommand, std::unique_ptr<RemoteEngine>> engines_;
};

WorkerPool::WorkerPool(std::size_t threads, const WorkerLimits& limits)
    : limits_(limits), team_(threads) {}

WorkerPool::~WorkerPool() = default;

std::vector<JobResult> WorkerPool::run_all(const std::vector<EngineJob>& jobs,
                                           const Progress& progress,
                                           const std::atomic<bool>* stop) {
  std::vector<JobResult> results(jobs.size());
  std::size_t next = 0, done = 0;
  std::mutex reporting;
  const auto offer = [&]() -> std::optional<OfferedJob> {
    if (next == jobs.size()) return std::nullopt;
    const std::size_t i = next++;
    return OfferedJob{jobs[i], [&, i](const JobResult& result) {
                        results[i] = result;
                        const std::scoped_lock lock(reporting);
                        ++done;
                        if (progress) progress(done, jobs.size());
                      }};
  };
  run_on(std::min(threads(), jobs.size()), offer, stop);
  return results;
}

void WorkerPool::run_offered(const std::function<std::optional<OfferedJob>()>& offer,
                             const std::atomic<bool>* stop) {
  const auto unless_stopped = [&]() -> std::optional<OfferedJob> {
    if (stop != nullptr && *stop) return std::nullopt;
    return offer();
  };
  run_on(threads(), unless_stopped, stop);
}

void WorkerPool::run_on(std::size_t count, const std::function<std::optional<OfferedJob>()>& offer,
                        const std::atomic<bool>* stop) {
  std::mutex offering;
  std::exception_ptr failure;
  const auto next = [&]() -> std::optional<OfferedJob> {
    const std::scoped_lock lock(offering);
    if (failure) return std::nullopt;
    return offer();
  };
  team_.run(count, [&](std::size_t) {
    const StopScope scope(stop);
    try {
      Workers& workers = workers_of_this_thread(stop);
      while (const std::optional<OfferedJob> offered = next())
        offered->done(workers.run(offered->job));
    } catch (...) {
      const std::scoped_lock lock(offering);
      if (!failure) failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

WorkerPool::Workers& WorkerPool::workers_of_this_thread(const std::atomic<bool>* stop) {
  const std::scoped_lock lock(asking_);
  std::unique_ptr<Workers>& mine = workers_[std::this_thread::get_id()];
  if (!mine || mine->stop() != stop) mine = std::make_unique<Workers>(limits_, stop);
  return *mine;
}

}  // namespace slipcheck
