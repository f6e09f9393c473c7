#include "app/progress_line.h"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <utility>

#include "app/say.h"

namespace slipcheck {

ProgressLine::ProgressLine(std::function<std::string(double)> text, LinePlace place)
    : ticker_([text = std::move(text), place](const std::stop_token& stop) {
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
      }) {}

}  // namespace slipcheck
