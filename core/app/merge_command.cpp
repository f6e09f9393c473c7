#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/output.h"
#include "studies/sweep/store_merge.h"

namespace slipcheck {
namespace {

struct MergeArguments {
  std::string into;
  std::vector<std::string> from;
  bool quiet = false;
};

int merge(const MergeArguments& arguments) {
  check_output("OUT", arguments.into, false);
  const MergedStores merged =
      merge_stores(arguments.into, {arguments.from.begin(), arguments.from.end()});
  if (!arguments.quiet)
    fmt::print("{}: {} of {} runs, {} of them from {} stores now\n", arguments.into, merged.runs,
               merged.total, merged.taken, arguments.from.size());
  return kWithinTolerance;
}

}  // namespace

void add_merge_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("merge", "Put the stores of a sweep's shards into one; repeatable");
  auto arguments = std::make_shared<MergeArguments>();
  command->add_option("OUT", arguments->into, "The store that gets the runs, made or added to")
      ->required();
  command->add_option("STORE", arguments->from, "Stores of the same sweep")->required();
  command->add_flag("-q,--quiet", arguments->quiet, "Say nothing");
  command->footer("Example:\n  slipcheck merge lottery.db lottery-*.db");
  command->callback([arguments, &exit_code] { exit_code = merge(*arguments); });
}

}  // namespace slipcheck
