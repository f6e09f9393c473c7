#include "engine/worker_pool.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

namespace slipcheck {
namespace {

using JobStatus = JobResult::Status;

JobStatus status_of(const WorkerFailure& failure) {
  return failure.status() == WorkerFailure::Status::timed_out ? JobStatus::timed_out
                                                              : JobStatus::crashed;
}

/// One thread's workers, at most one for each command.
class Workers {
 public:
  Workers(const WorkerLimits& limits, const std::atomic<bool>* stop)
      : limits_(limits), stop_(stop) {}

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

}  // namespace

WorkerPool::WorkerPool(std::size_t threads, const WorkerLimits& limits)
    : threads_(threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency())),
      limits_(limits) {}

std::vector<JobResult> WorkerPool::run_all(const std::vector<EngineJob>& jobs,
                                           const Progress& progress,
                                           const std::atomic<bool>* stop) const {
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
  run_on(std::min(threads_, jobs.size()), offer, stop);
  return results;
}

void WorkerPool::run_offered(const std::function<std::optional<OfferedJob>()>& offer,
                             const std::atomic<bool>* stop) const {
  const auto unless_stopped = [&]() -> std::optional<OfferedJob> {
    if (stop != nullptr && *stop) return std::nullopt;
    return offer();
  };
  run_on(threads_, unless_stopped, stop);
}

void WorkerPool::run_on(std::size_t count, const std::function<std::optional<OfferedJob>()>& offer,
                        const std::atomic<bool>* stop) const {
  std::mutex offering;
  std::exception_ptr failure;
  const auto next = [&]() -> std::optional<OfferedJob> {
    const std::scoped_lock lock(offering);
    if (failure) return std::nullopt;
    return offer();
  };
  // Workers die with the thread that started them, so each thread keeps its own.
  const auto loop = [&] {
    const StopScope scope(stop);
    Workers workers(limits_, stop);
    try {
      while (const std::optional<OfferedJob> offered = next())
        offered->done(workers.run(offered->job));
    } catch (...) {
      const std::scoped_lock lock(offering);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < count; ++k) threads.emplace_back(loop);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace slipcheck
