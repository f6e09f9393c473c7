#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/remote_engine.h"

namespace slipcheck {

/// A piece of work that needs one engine to itself.
struct EngineJob {
  WorkerCommand command;
  std::function<void(RemoteEngine&)> work;
};

/// What became of a job.
struct JobResult {
  enum class Status {
    ok,
    crashed,    ///< the worker failed, for whatever reason but time
    timed_out,  ///< the worker did not answer in time, or the work took longer than a StopScope
                ///< says
    skipped,    ///< the engine refused, or the user interrupted
    failed,     ///< the job's own function threw something else, see `error`
  };
  Status status = Status::skipped;
  std::string reason;        ///< empty where ok
  std::exception_ptr error;  ///< what `work` threw, if anything
};

/// A job that is handed out when a thread has time for it.
struct OfferedJob {
  EngineJob job;
  std::function<void(const JobResult&)> done;  ///< is told, on the thread that did it
};

/// Runs jobs on several threads, each with a worker process of its own for each command. A
/// worker is reused from job to job and replaced after a failure, so that whatever one engine does,
/// the other jobs go on.
class WorkerPool {
 public:
  using Progress = std::function<void(std::size_t done, std::size_t total)>;

  /// `threads`: 0 takes as many as the machine has cores.
  explicit WorkerPool(std::size_t threads = 0, const WorkerLimits& limits = {});

  /// The results in the order of the jobs, which run in any order. `progress` is called after each
  /// job, by one thread at a time. Once `stop` is set, waiting jobs are skipped and running ones
  /// interrupted within 0.1 s. Nothing of a job is thrown from here.
  std::vector<JobResult> run_all(const std::vector<EngineJob>& jobs, const Progress& progress = {},
                                 const std::atomic<bool>* stop = nullptr) const;

  /// Runs what `offer` gives, by one thread at a time, until it has no more or `stop` is set; only
  /// so many jobs are held as there are threads. What is at work then is interrupted, and its
  /// `done` is told. Throws on what `offer` or a `done` throws, after which nothing more is begun.
  void run_offered(const std::function<std::optional<OfferedJob>()>& offer,
                   const std::atomic<bool>* stop = nullptr) const;

  std::size_t threads() const { return threads_; }

 private:
  void run_on(std::size_t threads, const std::function<std::optional<OfferedJob>()>& offer,
              const std::atomic<bool>* stop) const;

  std::size_t threads_;
  WorkerLimits limits_;
};

}  // namespace slipcheck
