#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/duration_text.h"
#include "app/interrupt.h"
#include "app/limit_options.h"
#include "app/number_range.h"
#include "app/output.h"
#include "app/say.h"
#include "app/sweep_progress.h"
#include "report/rows/context.h"
#include "studies/sweep/sweep_run.h"
#include "studies/sweep/sweep_setup.h"
#include "studies/sweep/sweep_store.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

constexpr double kForever = std::numeric_limits<double>::infinity();
/// How long a dry run tries runs, and how many [s].
constexpr double kTrialTime = 5;
constexpr std::uint64_t kMostTrials = 64;

struct SweepArguments {
  std::string file, store, shard;
  double limit_time = kForever;
  bool retry = false, dry_run = false, quiet = false;
  SweepOptions options;
};

/// Runs from the first to before the last.
struct Share {
  std::uint64_t first = 0, last = 0;
};

Share share_of(const std::string& shard, std::uint64_t runs) {
  if (shard.empty()) return {0, runs};
  const std::size_t slash = shard.find('/');
  std::uint64_t number = 0, count = 0;
  const bool good = slash != std::string::npos &&
                    CLI::detail::lexical_cast(shard.substr(0, slash), number) &&
                    CLI::detail::lexical_cast(shard.substr(slash + 1), count) && number >= 1 &&
                    number <= count && count <= 1'000'000;
  if (!good)
    throw BadOption(fmt::format("--shard: must be i/n with 1 <= i <= n <= 1000000, got {}", shard));
  const auto [first, last] = shard_of(runs, number, count);
  return {first, last};
}

std::string program_name() {
  return fmt::format("slipcheck {} ({})", context().version, context().commit);
}

/// Hands out what a share lacks, until it is time to end.
class Pending {
 public:
  Pending(Share share, std::vector<bool> done, double limit_time)
      : next_(share.first), last_(share.last), done_(std::move(done)) {
    for (std::uint64_t run = share.first; run < share.last; ++run)
      if (!done_[run]) ++count_;
    if (limit_time < 1e9)
      deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(limit_time));
  }

  std::uint64_t count() const { return count_; }

  std::optional<std::uint64_t> next() {
    if (Clock::now() >= deadline_) return std::nullopt;
    while (next_ < last_ && done_[next_]) ++next_;
    if (next_ == last_) return std::nullopt;
    return next_++;
  }

  /// Of so many that are spread over all of them without a pattern.
  std::vector<std::uint64_t> spread(std::uint64_t most) const {
    std::vector<std::uint64_t> runs;
    for (std::uint64_t run = next_; run < last_; ++run)
      if (!done_[run]) runs.push_back(run);
    std::vector<std::uint64_t> chosen;
    constexpr double kGolden = 0.6180339887498949;
    for (std::uint64_t k = 0; k < std::min<std::uint64_t>(most, runs.size()); ++k) {
      const double place = std::fmod((static_cast<double>(k) + 0.5) * kGolden, 1.0);
      chosen.push_back(runs[static_cast<std::size_t>(place * static_cast<double>(runs.size()))]);
    }
    return chosen;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::uint64_t next_, last_, count_ = 0;
  std::vector<bool> done_;
  Clock::time_point deadline_ = Clock::time_point::max();
};

std::string mentioned(const SweepSetup& setup) {
  const SweepPlan& plan = setup.plan();
  return fmt::format("{}: {} runs of {} scenes", plan.name(), plan.runs(), plan.scenes());
}

/// Tries some of the runs, keeps none, and tells what all take.
int try_out(const SweepSetup& setup, const SweepArguments& arguments, const Pending& pending) {
  fmt::print("{}, {} to be made\n", mentioned(setup), pending.count());
  if (pending.count() == 0) return kWithinTolerance;
  const std::vector<std::uint64_t> chosen = pending.spread(kMostTrials);
  std::mutex mutex;
  std::size_t next = 0, tried = 0;
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  run_sweep(
      setup, arguments.options,
      [&]() -> std::optional<std::uint64_t> {
        if (next == chosen.size() || elapsed() > kTrialTime) return std::nullopt;
        return chosen[next++];
      },
      [&](const FinishedRun&) {
        const std::scoped_lock lock(mutex);
        ++tried;
      });
  if (tried == 0 || interrupted()) return kInterrupted;
  const double each = elapsed() / static_cast<double>(tried);
  fmt::print("about {}, by {} that were tried\n",
             duration_text(each * static_cast<double>(pending.count())), tried);
  return kWithinTolerance;
}

/// Other versions of the engines than those that have run would make one store of two sweeps.
void check_versions(SweepStore& store, const SweepSetup& setup, const std::string& path) {
  const auto installed = setup.versions();
  for (const auto& [engine, precision, version] : store.engines()) {
    bool same = false;
    std::string others;
    for (const auto& [name, its_precision, its_version] : installed)
      if (name == engine && its_precision == precision) {
        same = same || its_version == version;
        others += (others.empty() ? "" : ", ") + its_version;
      }
    if (!same && !others.empty())
      throw BadStore(fmt::format("{}: must be of the installed {} ({}) {}, got one of {}", path,
                                 engine, precision, others, version));
  }
}

double cpu_seconds(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string status_text(SweepStore& store) {
  std::string text;
  for (const auto& [status, count] : store.statuses())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, status);
  return text;
}

int fill(const SweepSetup& setup, const SweepArguments& arguments, SweepStore& store,
         const Share& share) {
  Pending pending(share, store.done(arguments.retry), arguments.limit_time);
  const std::uint64_t all = share.last - share.first, before = all - pending.count();
  if (!arguments.quiet)
    say("{}{}; {} of {} are in {}\n", mentioned(setup),
        arguments.shard.empty() ? "" : ", shard " + arguments.shard, before, all, arguments.store);
  std::atomic<std::uint64_t> made{0};
  {
    SweepProgress progress(pending.count(), !arguments.quiet);
    try {
      run_sweep(
          setup, arguments.options, [&] { return pending.next(); },
          [&](const FinishedRun& run) {
            store.add(run);
            progress.set(++made);
          });
    } catch (const SqliteFailure& failure) {
      throw std::runtime_error(fmt::format(
          "{}: cannot be written: {}; {} runs are in it, and the same command goes on with it",
          arguments.store, failure.what(), before + made));
    }
  }
  const std::uint64_t left = pending.count() - made;
  if (!arguments.quiet) {
    say("{} runs in {} ({} s of CPU, and {} s of the engines'): {}\n", made.load(), arguments.store,
        std::lround(cpu_seconds(RUSAGE_SELF)), std::lround(cpu_seconds(RUSAGE_CHILDREN)),
        status_text(store));
    if (left > 0) say("{} runs are left; the same command goes on with them\n", left);
  }
  return left > 0 ? kInterrupted : kWithinTolerance;
}

int sweep(SweepArguments& arguments) {
  arguments.options.stop = &interrupted();
  watch_for_interrupts();
  SweepPlan plan = SweepPlan::load(arguments.file);
  if (arguments.store.empty()) arguments.store = plan.name() + ".db";
  check_output("-o", arguments.store, false);
  const Share share = share_of(arguments.shard, plan.runs());
  const SweepSetup setup(std::move(plan), arguments.options.limits, arguments.options.stop);
  const StoreHead head = setup.head(program_name());
  if (arguments.dry_run) {
    std::vector<bool> done(head.runs);
    if (fs::exists(arguments.store)) done = runs_done(arguments.store, head, arguments.retry);
    return try_out(setup, arguments, Pending(share, std::move(done), kForever));
  }
  SweepStore store(arguments.store, head);
  check_versions(store, setup, arguments.store);
  return fill(setup, arguments, store, share);
}

}  // namespace

void add_sweep_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "sweep", "Run a scene over a grid or samples of its parameters, into one resumable store");
  auto arguments = std::make_shared<SweepArguments>();
  command->add_option("FILE", arguments->file, "A scene with a block sweep:")->required();
  command->add_option("-o,--out", arguments->store,
                      "The store, an SQLite file, made or gone on with; NAME.db of the scene "
                      "unless given");
  command->add_option("--shard", arguments->shard,
                      "i/n: the i-th of n parts of the runs (slipcheck merge)");
  command
      ->add_option("--limit-time", arguments->limit_time,
                   "Begin no run after so many seconds; exit code 130 where some are left")
      ->check(positive_number());
  command->add_flag("--retry", arguments->retry,
                    "Run those again that crashed, timed out or were skipped");
  command->add_flag("--dry-run", arguments->dry_run,
                    "Write nothing; tell how many runs there are and about how long they take");
  add_limit_options(*command, arguments->options);
  command->add_flag("-q,--quiet", arguments->quiet, "No progress");
  command->footer(
      "Exit codes: 0 all runs are in the store, whatever they showed; 130 some are left.\n\n"
      "Example:\n  slipcheck sweep my-sweep.yaml -o my.db --shard 1/4");
  command->callback([arguments, &exit_code] { exit_code = sweep(*arguments); });
}

}  // namespace slipcheck
