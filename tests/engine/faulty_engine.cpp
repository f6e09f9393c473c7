// An engine whose setting `fault` says how it fails, at the tenth step unless its value says
// otherwise; the shipped one is that of the environment, SLIPCHECK_FAULT, or "ok": bodies fly on
// straight. The rest is in kFaults below.

#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "engine/protocol.h"
#include "engine/worker.h"

namespace slipcheck {
namespace {

int g_raw_output = -1;  // the reply stream, behind run_worker's back

void write_raw(const std::vector<std::uint8_t>& bytes) {
  [[maybe_unused]] const ssize_t n = write(g_raw_output, bytes.data(), bytes.size());
}

[[noreturn]] void sleep_for_ever() {
  while (true) pause();
}

/// Takes so much of a processor's time [s].
void calculate(double seconds) {
  const std::clock_t begin = std::clock();
  while (static_cast<double>(std::clock() - begin) < seconds * CLOCKS_PER_SEC) {
  }
}

void die_of(int signal_number) {
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

void eat_memory() {
  std::vector<std::vector<char>> eaten;
  while (true) eaten.emplace_back(std::size_t{16} << 20, 'x');
}

void close_everything() {
  for (int fd = 3; fd < 64; ++fd) close(fd);
}

const std::map<std::string, std::function<void()>> kFaults = {
    {"abort", [] { die_of(SIGABRT); }},
    {"close-pipe", [] { close_everything(), sleep_for_ever(); }},
    {"crash", [] { die_of(SIGSEGV); }},
    {"eat-memory", eat_memory},
    {"exit-code", [] { std::cerr << "no licence\nno fun\n"
                                 << std::flush,
                           _exit(3); }},
    {"fork-and-hang", [] { static_cast<void>(fork()), sleep_for_ever(); }},
    {"hang", sleep_for_ever},
    {"huge-length",
     [] {
       write_raw({0xff, 0xff, 0xff, 0xff}), sleep_for_ever();
     }},
    {"more-than-asked",
     [] {
       auto twice = protocol::encode(protocol::Reply(protocol::Started{}));
       twice.insert(twice.end(), twice.begin(), twice.begin() + static_cast<int>(twice.size()));
       write_raw(twice), sleep_for_ever();
     }},
    {"half-a-reply",
     [] {
       write_raw({100, 0, 0, 0, 0xa1}), sleep_for_ever();
     }},
    {"noisy", [] { std::fputs(std::string(200'000, 'e').c_str(), stderr), die_of(SIGSEGV); }},
    {"print-to-stdout", [] { std::cout << "hello\n"
                                       << std::flush,
                                 std::puts("world"); }},
    {"rubbish",
     [] {
       write_raw({4, 0, 0, 0, 'w', 'h', 'a', 't'}), sleep_for_ever();
     }},
    {"throw", [] { throw std::runtime_error("the engine is unwell"); }},
    {"wrong-reply",
     [] { write_raw(protocol::encode(protocol::Reply(protocol::Started{}))), sleep_for_ever(); }},
};

/// That of a run whose profile names none.
std::string shipped_fault() {
  const char* fault = std::getenv("SLIPCHECK_FAULT");
  return fault == nullptr ? "ok" : fault;
}

class FaultyEngine final : public Engine {
 public:
  EngineInfo info() const override {
    SettingInfo fault, pause;
    fault.name = "fault";
    fault.about = "how it fails";
    fault.shipped = shipped_fault();
    pause.name = "pause";
    pause.about =
        "before each step where the fault is slow; of its processor's time where it is busy";
    pause.unit = "ms";
    pause.shipped = 30.0;
    pause.low = 0;
    pause.high = 1000;
    pause.whole = true;
    return {"faulty", "1.0", "double", {fault, pause}};
  }

  Applied configure(const EngineScene&, const Settings& settings, double time_step) override {
    fault_ =
        settings.contains("fault") ? std::get<std::string>(settings.at("fault")) : shipped_fault();
    if (fault_ == "refuse") throw Refused("does not like the scene");
    pause_ = settings.contains("pause") ? std::get<double>(settings.at("pause")) : 30;
    time_step_ = time_step;
    kill_at_ = std::numeric_limits<long>::max();
    if (const std::string prefix = "kill-at-step-"; fault_.starts_with(prefix)) {
      kill_at_ = std::stol(fault_.substr(prefix.size()));
    }
    return {{{"time_step", time_step}, {"strict", true}, {"pid", double(getpid())}},
            {Lack{"physics"}},
            {}};
  }

  void start(std::span<const BodyState> states, double) override {
    states_.assign(states.begin(), states.end());
    steps_ = 0;
  }

  void step() override {
    ++steps_;
    if (steps_ == kill_at_) kill(getpid(), SIGKILL);
    const auto fault = kFaults.find(fault_);
    if (fault != kFaults.end() && steps_ == 10) fault->second();
    if (fault_ == "slow") usleep(static_cast<useconds_t>(1000 * pause_));
    if (fault_ == "busy") calculate(1e-3 * pause_);
    for (BodyState& state : states_) state.position += time_step_ * state.velocity;
    if (fault_ == "nan" && steps_ == 10) {
      states_[0].velocity.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }

  void read(Frame& frame) const override {
    frame.bodies = states_;
    frame.touches.assign(1, {0, kSubstrate, 0.5});
  }

 private:
  std::string fault_;
  double pause_ = 0;  // [ms]
  double time_step_ = 0;
  long steps_ = 0;
  long kill_at_ = 0;
  std::vector<BodyState> states_;
};

}  // namespace
}  // namespace slipcheck

int main() {
  slipcheck::g_raw_output = dup(STDOUT_FILENO);
  slipcheck::FaultyEngine engine;
  return slipcheck::run_worker(engine);
}
