#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/thread_team.h"
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
/// worker is reused from job to job, and from one call to the next, and replaced after a failure,
/// so that whatever one engine does, the other jobs go on. One thread at a time calls it.
class WorkerPool {
 public:
  using Progress = std::function<void(std::size_t done, std::size_t total)>;

  /// `threads`: 0 takes as many as the machine has cores.
  explicit WorkerPool(std::size_t threads = 0, const WorkerLimits& limits = {});
  ~WorkerPool();

  /// The results in the order of the jobs, which run in any order. `progress` is called after each
  /// job, by one thread at a time. Once `stop` is set, waiting jobs are skipped and running ones
  /// interrupted within 0.1 s. Nothing of a job is thrown from here.
  std::vector<JobResult> run_all(const std::vector<EngineJob>& jobs, const Progress& progress = {},
                                 const std::atomic<bool>* stop = nullptr);

  /// Runs what `offer` gives, by one thread at a time, until it has no more or `stop` is set; only
  /// so many jobs are held as there are threads. What is at work then is interrupted, and its
  /// `done` is told. Throws on what `offer` or a `done` throws, after which nothing more is begun.
  void run_offered(const std::function<std::optional<OfferedJob>()>& offer,
                   const std::atomic<bool>* stop = nullptr);

  std::size_t threads() const { return team_.size(); }

 private:
  class Workers;

  void run_on(std::size_t threads, const std::function<std::optional<OfferedJob>()>& offer,
              const std::atomic<bool>* stop);
  Workers& workers_of_this_thread(const std::atomic<bool>* stop);

  WorkerLimits limits_;
  ThreadTeam team_;
  std::mutex asking_;
  /// Workers die with the thread that started them, so each thread keeps its own.
  std::map<std::thread::id, std::unique_ptr<Workers>> workers_;
};

}  // namespace slipcheck
