// Every way in which a worker can fail gives its status and its reason, in time, and leaves neither
// a zombie nor an open descriptor behind.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <sstream>
#include <thread>
#include <vector>

#include "../support/refusal.h"
#include "base/stop_scope.h"
#include "engine/remote_engine.h"
#include "some_scene.h"

namespace slipcheck {
namespace {

using Clock = std::chrono::steady_clock;
using Status = WorkerFailure::Status;

std::size_t open_descriptors() {
  const std::filesystem::directory_iterator fds("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(fds), end(fds)));
}

bool has_children() { return waitpid(-1, nullptr, WNOHANG) != -1; }

/// 20 steps with a fault of the faulty engine.
void run(RemoteEngine& engine, const std::string& fault) {
  const Scene scene = some_scene();
  engine.configure(scene, {{"fault", fault}}, 1e-3);
  engine.start(scene.initial);
  engine.advance(20, [](const Frame&) {});
}

class WorkerFailureTest : public ::testing::Test {
 protected:
  void SetUp() override { descriptors_ = open_descriptors(); }
  void TearDown() override {
    EXPECT_FALSE(has_children()) << "a zombie or a child is left";
    EXPECT_EQ(open_descriptors(), descriptors_);
  }

  /// `within` [s] is when the failure must have been noticed, with the start of the process.
  void expect_failure(const std::string& fault, Status status, const std::string& reason,
                      double within, WorkerLimits limits = {}) {
    const auto begin = Clock::now();
    try {
      RemoteEngine engine(faulty_engine(), limits);
      run(engine, fault);
      ADD_FAILURE() << fault << " went well";
    } catch (const WorkerFailure& failure) {
      EXPECT_EQ(failure.status(), status) << fault;
      EXPECT_EQ(failure.what(), reason);
    }
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - begin).count(), within) << fault;
  }

 private:
  std::size_t descriptors_ = 0;
};

// Far from never: the sanitizers slow everything down, and the machine may be busy.
constexpr double kSoon = 60;

TEST_F(WorkerFailureTest, CrashesHaveTheirSignal) {
  expect_failure("crash", Status::crashed, "killed by signal 11 (Segmentation fault)", kSoon);
  expect_failure("abort", Status::crashed, "killed by signal 6 (Aborted)", kSoon);
  expect_failure("kill-at-step-15", Status::crashed, "killed by signal 9 (Killed)", kSoon);
}

TEST_F(WorkerFailureTest, AnExitHasItsCodeAndLastWords) {
  expect_failure("exit-code", Status::crashed, "exited with code 3: no fun", kSoon);
}

TEST_F(WorkerFailureTest, NoiseIsCutToTheLastWords) {
  expect_failure("noisy", Status::crashed,
                 "killed by signal 11 (Segmentation fault): " + std::string(300, 'e'), kSoon);
}

TEST_F(WorkerFailureTest, AHangTimesOut) {
  expect_failure("hang", Status::timed_out, "no reply within 2 s", kSoon,
                 {.memory = std::size_t{2} << 30, .reply = 2});
  expect_failure("half-a-reply", Status::timed_out, "no reply within 2 s", kSoon,
                 {.memory = std::size_t{2} << 30, .reply = 2});
}

// Five that calculate share a processor: 1 s of its time takes the worker 5 s, of which it may
// take 3.
TEST_F(WorkerFailureTest, AWorkerIsNotToBlameForABusyMachine) {
  if (!std::ifstream("/proc/self/schedstat")) GTEST_SKIP() << "Linux does not say who has to wait";
  cpu_set_t mine, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof mine, &mine), 0);
  CPU_ZERO(&one);
  for (int k = 0; k < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++k)
    if (CPU_ISSET(k, &mine)) CPU_SET(k, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  const pid_t test = getpid();
  std::vector<pid_t> others(4);
  for (pid_t& other : others) {
    other = fork();
    if (other == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      while (getppid() == test) continue;
      _exit(0);
    }
  }
  EXPECT_NO_THROW({
    RemoteEngine engine(faulty_engine(), {.memory = std::size_t{2} << 30, .reply = 3});
    const Scene scene = some_scene();
    engine.configure(scene, {{"fault", "busy"}, {"pause", 50.0}}, 1e-3);
    engine.start(scene.initial);
    engine.advance(20, [](const Frame&) {});
  });
  for (const pid_t other : others) {
    kill(other, SIGKILL);
    waitpid(other, nullptr, 0);
  }
  EXPECT_EQ(sched_setaffinity(0, sizeof mine, &mine), 0);
}

TEST_F(WorkerFailureTest, ARunHasItsTimeLimit) {
  RemoteEngine engine(faulty_engine());
  engine.limit_run(0.3);
  try {
    run(engine, "slow");  // 20 steps of 30 ms
    FAIL();
  } catch (const WorkerFailure& failure) {
    EXPECT_EQ(failure.status(), Status::timed_out);
    EXPECT_STREQ(failure.what(), "the run took longer than its time limit");
  }
  EXPECT_FALSE(engine.alive());
  EXPECT_THROW(run(engine, "ok"), WorkerFailure);  // and nothing worse
}

TEST_F(WorkerFailureTest, AMemoryEaterIsStopped) {
  expect_failure("eat-memory", Status::crashed, "exceeded the memory limit of 256 MiB", kSoon,
                 {.memory = std::size_t{256} << 20, .reply = kSoon});
}

TEST_F(WorkerFailureTest, RubbishIsNamed) {
  expect_failure("rubbish", Status::crashed, "spoke rubbish: the CBOR item ends early", kSoon);
  expect_failure("huge-length", Status::crashed,
                 "spoke rubbish: a message of 4294967295 bytes, more than 67108864", kSoon);
  expect_failure("more-than-asked", Status::crashed,
                 "spoke rubbish: more than one reply to a request", kSoon);
  expect_failure("wrong-reply", Status::crashed, "spoke rubbish: not the reply asked for", kSoon);
}

TEST_F(WorkerFailureTest, AClosedPipeIsNoticed) {
  expect_failure("close-pipe", Status::crashed, "closed its pipe", kSoon + 1);
}

TEST_F(WorkerFailureTest, AnExceptionComesAcross) {
  expect_failure("throw", Status::crashed, "failed: the engine is unwell", kSoon);
}

/// Processes of a group that still run, by /proc/<pid>/stat: "pid (name) state parent group …".
int running_in_group(pid_t group) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "stat");
    std::string stat;
    std::getline(file, stat);
    char state = 'Z';
    int parent = 0, its_group = 0;
    const std::size_t name_end = stat.rfind(')');
    if (name_end == std::string::npos) continue;
    std::istringstream(stat.substr(name_end + 1)) >> state >> parent >> its_group;
    count += its_group == group && state != 'Z';
  }
  return count;
}

TEST_F(WorkerFailureTest, GrandchildrenDieToo) {
  RemoteEngine engine(faulty_engine(), {.memory = std::size_t{2} << 30, .reply = 2});
  const pid_t group = engine.pid();
  EXPECT_EQ(running_in_group(group), 1);
  EXPECT_THROW(run(engine, "fork-and-hang"), WorkerFailure);
  for (int k = 0; k < 30'000 && running_in_group(group) > 0; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(running_in_group(group), 0);
}

TEST_F(WorkerFailureTest, AWorkerDiesWithItsHarness) {
  int report[2];
  ASSERT_EQ(pipe(report), 0);
  const pid_t harness = fork();
  if (harness == 0) {
    RemoteEngine engine(faulty_engine());
    const pid_t worker = engine.pid();
    if (write(report[1], &worker, sizeof worker) == sizeof worker) run(engine, "hang");
    _exit(1);
  }
  pid_t worker = 0;
  ASSERT_EQ(read(report[0], &worker, sizeof worker), static_cast<ssize_t>(sizeof worker));
  EXPECT_EQ(running_in_group(worker), 1);
  kill(harness, SIGKILL);
  waitpid(harness, nullptr, 0);
  for (int k = 0; k < 2000 && running_in_group(worker) > 0; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(running_in_group(worker), 0);
  close(report[0]);
  close(report[1]);
}

TEST_F(WorkerFailureTest, AWorkerThatKnowsNothingOfItsHarnessDiesWithIt) {
  int report[2];
  ASSERT_EQ(pipe(report), 0);
  const pid_t harness = fork();
  if (harness == 0) {
    const WorkerProcess worker(WorkerCommand("/bin/sh", {"-c", "while :; do :; done"}), {});
    const pid_t pid = worker.pid();
    if (write(report[1], &pid, sizeof pid) == sizeof pid) pause();
    _exit(1);
  }
  pid_t worker = 0;
  ASSERT_EQ(read(report[0], &worker, sizeof worker), static_cast<ssize_t>(sizeof worker));
  EXPECT_EQ(running_in_group(worker), 1);
  kill(harness, SIGKILL);
  waitpid(harness, nullptr, 0);
  for (int k = 0; k < 30'000 && running_in_group(worker) > 0; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(running_in_group(worker), 0);
  if (running_in_group(worker) > 0) kill(worker, SIGKILL);
  close(report[0]);
  close(report[1]);
}

/// What a shell says that is started as a worker.
std::string said_by_shell(const std::string& command) {
  int said[2];
  EXPECT_EQ(pipe2(said, O_CLOEXEC), 0);
  {
    const std::string file = "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(said[1]);
    WorkerProcess worker(WorkerCommand("/bin/sh", {"-c", "{ " + command + "; } > " + file}), {});
    worker.finish({}, true, kSoon);
  }
  close(said[1]);
  std::string text(1 << 16, ' ');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(said[0], text.data(), 1 << 16))));
  close(said[0]);
  return text;
}

TEST_F(WorkerFailureTest, AWorkerHasNoDescriptorOfItsHarness) {
  const int leaked = open("/etc/passwd", O_RDONLY);  // not closed by exec
  ASSERT_GE(leaked, 3);
  const std::string all = said_by_shell("ls -l /proc/$$/fd");
  close(leaked);
  EXPECT_NE(all.find(" 0 -> socket:"), std::string::npos) << all;
  EXPECT_EQ(all.find("/etc/passwd"), std::string::npos) << all;
}

TEST_F(WorkerFailureTest, AWorkerHasTheEnvironmentOfEngines) {
  setenv("SECRET_TOKEN", "secret", 1);
  setenv("LC_TIME", "C", 1);
  setenv("OMP_NUM_THREADS", "3", 1);
  setenv("PATHS", "no", 1);
  const std::string all = "\n" + said_by_shell("env");
  for (const char* name : {"SECRET_TOKEN", "LC_TIME", "OMP_NUM_THREADS", "PATHS"}) unsetenv(name);
  EXPECT_EQ(all.find("secret"), std::string::npos) << all;
  EXPECT_EQ(all.find("\nPATHS="), std::string::npos) << all;
  EXPECT_NE(all.find("\nLC_TIME=C\n"), std::string::npos) << all;
  EXPECT_NE(all.find("\nOMP_NUM_THREADS=3\n"), std::string::npos) << all;
  EXPECT_NE(all.find("\nPATH="), std::string::npos) << all;
}

TEST_F(WorkerFailureTest, AWorkerIsNotToBlameForItsHarnessBeingStopped) {
  const pid_t harness = fork();
  if (harness == 0) {
    try {
      RemoteEngine engine(faulty_engine(), {.memory = std::size_t{2} << 30, .reply = 5});
      engine.limit_run(6);
      const Scene scene = some_scene();
      engine.configure(scene, {{"fault", "slow"}, {"pause", 50.0}}, 1e-3);
      engine.start(scene.initial);
      for (int k = 0; k < 4; ++k) engine.advance(10, [](const Frame&) {});  // for 2 s in all
    } catch (const WorkerFailure&) {
      _exit(1);
    }
    _exit(0);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  kill(harness, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(7000));
  kill(harness, SIGCONT);
  int status = 0;
  waitpid(harness, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

/// What a fork of this program does; the number that it ends with.
template <class Action>
int in_fork(const Action& action, const std::function<void(pid_t)>& meanwhile) {
  const pid_t child = fork();
  if (child == 0) {
    int code = 0;
    try {
      code = action();
    } catch (...) {
      code = 100;
    }
    _exit(code);
  }
  meanwhile(child);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

void stop_for(double seconds, std::initializer_list<pid_t> processes) {
  for (const pid_t each : processes) kill(each, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  for (const pid_t each : processes) kill(each, SIGCONT);
}

TEST_F(WorkerFailureTest, TimeLimitsStandStillWhileTheProgramIsStopped) {
  const auto calculate = [](double seconds) {
    const StopScope limit(1.5);
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end) {
      heed_stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return 0;
  };
  // Of 4 s it is stopped for 3.5 s.
  EXPECT_EQ(in_fork([&] { return calculate(4); },
                    [](pid_t child) {
                      std::this_thread::sleep_for(std::chrono::milliseconds(200));
                      stop_for(3.5, {child});
                    }),
            0);
  const auto running = [&] {
    try {
      return calculate(4);
    } catch (const OutOfTime&) {
      return 3;
    }
  };
  EXPECT_EQ(in_fork(running, [](pid_t) {}), 3);
}

TEST_F(WorkerFailureTest, PatienceStandsStillWhileTheProgramIsStopped) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  // The worker ends 0.5 s after it was let go, has 1.2 s for that, and both are stopped for 3 s.
  const auto let_go = [&] {
    WorkerProcess worker({"/bin/sh", {"-c", "sleep 0.5"}}, {});
    const pid_t pid = worker.pid();
    if (write(pipe_ends[1], &pid, sizeof pid) != sizeof pid) return 101;
    return worker.finish({}, true, 1.2).exited ? 0 : 1;
  };
  EXPECT_EQ(in_fork(let_go,
                    [&](pid_t child) {
                      pid_t worker = 0;
                      ASSERT_EQ(read(pipe_ends[0], &worker, sizeof worker), ssize_t{sizeof worker});
                      std::this_thread::sleep_for(std::chrono::milliseconds(100));
                      stop_for(3, {child, -worker});
                    }),
            0);
  close(pipe_ends[0]);
  close(pipe_ends[1]);
}

/// Whether there is a process of this number that is more than a zombie.
bool lives(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  stat >> number >> name >> state;
  return !state.empty() && state != "Z" && state != "X";
}

TEST_F(WorkerFailureTest, WhatAWorkerHasStartedDiesWithAHarnessThatIsKilled) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const std::string file = testing::TempDir() + "grandchild-" + std::to_string(getpid());
  const auto hold = [&] {
    // The last line tells that the child has been started.
    WorkerProcess worker({"/bin/sh", {"-c", "sleep 1000 & echo $! > " + file + "; wait"}}, {});
    while (!std::filesystem::exists(file) || std::filesystem::file_size(file) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const char ready = 1;
    if (write(pipe_ends[1], &ready, 1) != 1) return 101;
    pause();
    return 102;
  };
  pid_t grandchild = 0;
  EXPECT_EQ(in_fork(hold,
                    [&](pid_t child) {
                      char ready = 0;
                      ASSERT_EQ(read(pipe_ends[0], &ready, 1), 1);
                      std::ifstream(file) >> grandchild;
                      EXPECT_TRUE(lives(grandchild));
                      kill(child, SIGKILL);
                    }),
            -SIGKILL);
  const auto until = Clock::now() + std::chrono::seconds(10);
  while (lives(grandchild) && Clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(lives(grandchild));
  close(pipe_ends[0]);
  close(pipe_ends[1]);
  std::filesystem::remove(file);
}

TEST_F(WorkerFailureTest, WhatIsNoExecutableCannotStart) {
  EXPECT_THROW(RemoteEngine("/nowhere/slipcheck-engine-x-double"), WorkerFailure);
  EXPECT_THROW(RemoteEngine("/bin/true"), WorkerFailure);  // exits at once
  EXPECT_THROW(RemoteEngine("/bin/cat"), WorkerFailure);   // sends the request back
}

TEST_F(WorkerFailureTest, AnEngineThatWorksIsUnhurtByItsPrinting) {
  RemoteEngine engine(faulty_engine());
  EXPECT_EQ(engine.info().engine, "faulty");
  run(engine, "print-to-stdout");
  run(engine, "ok");
}

TEST_F(WorkerFailureTest, FramesComeInOrderOverManyRequests) {
  RemoteEngine engine(faulty_engine());
  const Scene scene = some_scene();
  engine.configure(scene, {{"fault", "ok"}}, 1e-3);
  engine.start(scene.initial);
  double x = 0;
  std::size_t count = 0;
  const double cpu_seconds = engine.advance(20'000, [&](const Frame& frame) {
    x += 1e-3 * 1.0;  // as the engine sums: the same rounding
    ++count;
    ASSERT_EQ(frame.bodies[0].position.x(), x);
    ASSERT_EQ(frame.touches.size(), 1u);
  });
  EXPECT_EQ(count, 20'000u);
  EXPECT_GT(cpu_seconds, 0);
  EXPECT_LT(cpu_seconds, 5);
}

TEST_F(WorkerFailureTest, EachTimedRunBeginsAFreshWorld) {
  RemoteEngine engine(faulty_engine());
  const Scene scene = some_scene();
  engine.configure(scene, {{"fault", "kill-at-step-10"}}, 1e-3);
  const std::vector<double> times = engine.time_steps(scene.initial, 0, 9, 5);
  EXPECT_EQ(times.size(), 5u);
  for (const double time : times) EXPECT_GE(time, 0);
  EXPECT_THROW(engine.time_steps(scene.initial, 0, 10, 1), WorkerFailure);
}

TEST_F(WorkerFailureTest, ATimedRunIsNotGoneOnWith) {
  RemoteEngine engine(faulty_engine());
  const Scene scene = some_scene();
  engine.configure(scene, {}, 1e-3);
  engine.time_steps(scene.initial, 0, 3, 1);
  EXPECT_THROW(engine.advance(1, [](const Frame&) {}), WorkerFailure);
}

TEST_F(WorkerFailureTest, NanStatesAreDataNotRubbish) {
  RemoteEngine engine(faulty_engine());
  const Scene scene = some_scene();
  engine.configure(scene, {{"fault", "nan"}}, 1e-3);
  engine.start(scene.initial);
  int nans = 0;
  engine.advance(20, [&](const Frame& frame) { nans += std::isnan(frame.bodies[0].velocity.x()); });
  EXPECT_EQ(nans, 11);
}

TEST_F(WorkerFailureTest, ARefusalLeavesTheWorkerAlive) {
  RemoteEngine engine(faulty_engine());
  EXPECT_EQ(test::refusal_of<Refused>([&] {
              engine.configure(some_scene(), {{"fault", "refuse"}}, 1e-3);
            }),
            "does not like the scene");
  run(engine, "ok");
}

TEST_F(WorkerFailureTest, SettingsThatTheEngineDoesNotTakeAreRefused) {
  RemoteEngine engine(faulty_engine());
  const auto reason = [&](const Settings& settings) {
    return test::refusal_of<Refused>([&] { engine.configure(some_scene(), settings, 1e-3); });
  };
  EXPECT_EQ(reason({}), "");
  EXPECT_EQ(reason({{"pause", 5.0}}), "");
  EXPECT_EQ(reason({{"pause", -1.0}, {"fault", true}, {"erp", 0.2}}),
            "erp is no setting of this engine; fault must be a word, got true; "
            "pause must be a whole number >= 0 and <= 1000 ms, got -1");
  run(engine, "ok");
}

TEST_F(WorkerFailureTest, TheStopFlagIsSeenWhileWaiting) {
  std::atomic<bool> stop = false;
  RemoteEngine engine(faulty_engine(), {}, &stop);
  Clock::time_point asked;
  const std::jthread user([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    asked = Clock::now();
    stop = true;
  });
  EXPECT_THROW(run(engine, "hang"), Interrupted);
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - asked).count(), 5);  // the limit is 10 s
}

TEST_F(WorkerFailureTest, ADeadIdleWorkerIsNoticed) {
  RemoteEngine engine(faulty_engine());
  EXPECT_TRUE(engine.alive());
  kill(engine.pid(), SIGKILL);
  for (int k = 0; k < 30'000 && engine.alive(); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_FALSE(engine.alive());
}

TEST_F(WorkerFailureTest, ALargeSceneGoesBothWays) {
  // 1 MB each way: more than any pipe holds, so that one side has to read while it writes.
  RemoteEngine engine(faulty_engine());
  const Scene scene = some_scene(10'000);
  engine.configure(scene, {{"fault", "ok"}}, 1e-3);
  engine.start(scene.initial);
  std::size_t bodies = 0;
  engine.advance(5, [&](const Frame& frame) { bodies += frame.bodies.size(); });
  EXPECT_EQ(bodies, 50'000u);
}

TEST_F(WorkerFailureTest, AWorkerThatIsLetGoEndsWell) {
  const protocol::Bytes quit = protocol::encode(protocol::Request(protocol::Quit{}));
  for (const bool by_request : {true, false}) {
    WorkerProcess worker(faulty_engine(), {});
    worker.exchange(protocol::encode(protocol::Request(protocol::Hello{})));
    EXPECT_EQ(worker.unread(), 0u);
    const WorkerEnd end = worker.finish(by_request ? quit : protocol::Bytes{}, !by_request, kSoon);
    EXPECT_TRUE(end.exited);
    EXPECT_TRUE(end.well);
    EXPECT_EQ(end.how, "exited with code 0");
    EXPECT_EQ(end.left_over, 0u);
    EXPECT_FALSE(worker.alive());
    EXPECT_THROW(worker.finish({}, true, 1), WorkerFailure);
  }
}

TEST_F(WorkerFailureTest, AWorkerThatStaysIsEnded) {
  WorkerProcess worker("/usr/bin/yes", {});  // writes for ever and reads nothing
  // It may take long to start where much else runs.
  for (int k = 0; k < 30'000 && worker.unread() == 0; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const WorkerEnd end = worker.finish({}, true, 0.2);
  EXPECT_FALSE(end.exited);
  EXPECT_FALSE(end.well);
  EXPECT_EQ(end.how, "went on");
  EXPECT_GT(end.left_over, 0u);
}

TEST_F(WorkerFailureTest, TextOnTheReplyStreamIsRecognised) {
  try {
    RemoteEngine engine("/usr/bin/env", {});
    FAIL();
  } catch (const WorkerFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find(": a text that begins \""), std::string::npos)
        << failure.what();
  }
}

}  // namespace
}  // namespace slipcheck
