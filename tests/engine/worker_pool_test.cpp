#include "engine/worker_pool.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "some_scene.h"

namespace slipcheck {
namespace {

using Status = JobResult::Status;

/// Runs `steps` steps with a fault and records which process served it.
EngineJob job(const std::string& fault, std::size_t steps = 20,
              std::set<pid_t>* served_by = nullptr) {
  return {faulty_engine(), [=](RemoteEngine& engine) {
            static std::mutex mutex;
            if (served_by != nullptr) {
              const std::scoped_lock lock(mutex);
              served_by->insert(engine.pid());
            }
            const Scene scene = some_scene();
            engine.configure(scene, {{"fault", fault}}, 1e-3);
            engine.start(scene.initial);
            engine.advance(steps, [](const Frame&) {});
          }};
}

TEST(WorkerPool, OneThatFailsLeavesTheOthersAlone) {
  std::vector<EngineJob> jobs;
  for (const char* fault : {"ok", "crash", "ok", "rubbish", "hang", "ok", "refuse", "exit-code",
                            "ok", "kill-at-step-3", "ok", "ok"}) {
    jobs.push_back(job(fault));
  }
  std::vector<std::size_t> reported;
  const auto progress = [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(total, 12u);
    reported.push_back(done);
  };
  const auto results =
      WorkerPool(3, {.memory = std::size_t{2} << 30, .reply = 10}).run_all(jobs, progress);
  ASSERT_EQ(results.size(), 12u);
  const std::vector<Status> expected = {
      Status::ok,      Status::crashed, Status::ok, Status::crashed, Status::timed_out, Status::ok,
      Status::skipped, Status::crashed, Status::ok, Status::crashed, Status::ok,        Status::ok};
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].status, expected[i]) << i << ": " << results[i].reason;
    EXPECT_EQ(results[i].reason.empty(), results[i].status == Status::ok);
  }
  EXPECT_EQ(results[6].reason, "does not like the scene");
  ASSERT_EQ(reported.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(reported[i], i + 1);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a zombie or a child is left";
}

TEST(WorkerPool, WorkersAreReused) {
  std::set<pid_t> served_by;
  std::vector<EngineJob> jobs(30, job("ok", 20, &served_by));
  for (const JobResult& result : WorkerPool(2).run_all(jobs)) EXPECT_EQ(result.status, Status::ok);
  EXPECT_LE(served_by.size(), 2u);
  EXPECT_GE(served_by.size(), 1u);
}

TEST(WorkerPool, WorkersServeOneCallAfterTheOther) {
  std::set<pid_t> served_by;
  {
    WorkerPool pool(2);
    for (int call = 0; call < 10; ++call)
      for (const JobResult& result : pool.run_all({4, job("ok", 20, &served_by)}))
        EXPECT_EQ(result.status, Status::ok) << result.reason;
    EXPECT_LE(served_by.size(), 2u);
    for (pid_t worker : served_by) EXPECT_EQ(kill(worker, 0), 0) << "waits for the next call";
    ASSERT_EQ(pool.run_all({job("crash")}).front().status, Status::crashed);
    EXPECT_EQ(pool.run_all({job("ok")}).front().status, Status::ok) << "in a new one";
  }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a zombie or a child is left";
}

TEST(WorkerPool, WhatStoppedOneCallStopsNoOther) {
  std::atomic<bool> stop = true;
  WorkerPool pool(2);
  for (const JobResult& result : pool.run_all({2, job("ok")}, {}, &stop))
    EXPECT_EQ(result.status, Status::skipped);
  for (const JobResult& result : pool.run_all({2, job("ok")}))
    EXPECT_EQ(result.status, Status::ok) << result.reason;
}

TEST(WorkerPool, AWorkerKilledFromOutsideTakesOnlyItsOwnJob) {
  std::atomic<pid_t> victim = 0;
  std::vector<EngineJob> jobs;
  for (int k = 0; k < 6; ++k) {
    jobs.push_back({faulty_engine(), [&, k](RemoteEngine& engine) {
                      if (k == 0) victim = engine.pid();
                      const Scene scene = some_scene();
                      engine.configure(scene, {{"fault", k == 0 ? "hang" : "slow"}}, 1e-3);
                      engine.start(scene.initial);
                      engine.advance(15, [](const Frame&) {});
                    }});
  }
  const std::jthread killer([&] {
    while (victim == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    kill(victim, SIGKILL);
  });
  const auto results = WorkerPool(3).run_all(jobs);
  EXPECT_EQ(results[0].status, Status::crashed);
  EXPECT_EQ(results[0].reason, "killed by signal 9 (Killed)");
  for (std::size_t k = 1; k < results.size(); ++k) EXPECT_EQ(results[k].status, Status::ok) << k;
}

TEST(WorkerPool, AJobsOwnExceptionIsItsResult) {
  const EngineJob thrower = {faulty_engine(),
                             [](RemoteEngine&) { throw std::logic_error("a bug"); }};
  const auto results = WorkerPool(1).run_all({job("ok"), thrower, job("ok")});
  EXPECT_EQ(results[0].status, Status::ok);
  EXPECT_EQ(results[1].status, Status::failed);
  EXPECT_EQ(results[1].reason, "a bug");
  EXPECT_THROW(std::rethrow_exception(results[1].error), std::logic_error);
  EXPECT_EQ(results[2].status, Status::ok);
}

TEST(WorkerPool, AMissingExecutableIsAResultToo) {
  const auto results = WorkerPool(2).run_all({{"/nowhere/x", [](RemoteEngine&) {}}, job("ok")});
  EXPECT_EQ(results[0].status, Status::crashed);
  EXPECT_EQ(results[0].reason, "/nowhere/x: cannot start: No such file or directory");
  EXPECT_EQ(results[1].status, Status::ok);
}

TEST(WorkerPool, StopSkipsTheRestAtOnce) {
  std::atomic<bool> finished = false, stop = false;
  std::vector<EngineJob> jobs = {{faulty_engine(), [&](RemoteEngine& engine) {
                                    job("ok").work(engine);
                                    finished = true;
                                  }}};
  for (int k = 0; k < 50; ++k) jobs.push_back(job("hang"));
  const auto begin = std::chrono::steady_clock::now();
  const std::jthread user([&] {
    for (int k = 0; k < 10'000 && !finished; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stop = true;
  });
  const auto results = WorkerPool(2).run_all(jobs, {}, &stop);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took.count(), 60);               // 25 times 10 s where nothing stops them
  EXPECT_EQ(results[0].status, Status::ok);  // finished work is kept
  for (std::size_t k = 1; k < results.size(); ++k) {
    EXPECT_EQ(results[k].status, Status::skipped);
    EXPECT_EQ(results[k].reason, "interrupted");
  }
}

TEST(WorkerPool, NoJobsNoResults) { EXPECT_TRUE(WorkerPool().run_all({}).empty()); }

}  // namespace
}  // namespace slipcheck
