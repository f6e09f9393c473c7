#include "app/progress_line.h"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <new>
#include <system_error>
#include <utility>

#include "app/say.h"

namespace slipcheck {

namespace {

void show(const std::stop_token& stop, const std::function<std::string(double)>& text,
          LinePlace place) {
  using namespace std::chrono_literals;
  const bool stays = place == LinePlace::stays;
  const auto begin = std::chrono::steady_clock::now();
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  bool drawn = false;
  std::chrono::milliseconds pause = stays ? 1s : 30s;
  while (!stopped.wait_for(lock, stop, pause, [&] { return stop.stop_requested(); })) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    const std::string line = text(passed.count());
    say("{}", stays ? "\r\x1b[K" + line : line + '\n');
    std::fflush(stderr);
    drawn = true;
    if (stays) pause = 200ms;
  }
  if (drawn && stays) say("\r\x1b[K");
  std::fflush(stderr);
}

}  // namespace

ProgressLine::ProgressLine(std::function<std::string(double)> text, LinePlace place) {
  try {
    ticker_ = std::jthread([text = std::move(text), place](const std::stop_token& stop) {
      try {
        show(stop, text, place);
      } catch (const std::bad_alloc&) {  // the work itself may need less
      }
    });
  } catch (const std::system_error&) {  // no thread to be had: the work goes on unseen
  }
}

}  // namespace slipcheck
