#pragma once

#include <CLI/App.hpp>

namespace slipcheck {

/// Exit codes of the command line; others build on them.
enum ExitCode {
  kWithinTolerance = 0,
  kDeviates = 1,
  kBadInput = 2,
  kEngineFailed = 3,
  kInterrupted = 130,
};

/// Every command takes --quiet; those that print nothing but their result have nothing to leave
/// out.
inline void accept_quiet(CLI::App& command) {
  command.add_flag_callback(
      "-q,--quiet", [] {}, "Say nothing but the result");
}

// Each adds its command to the program. The command's callback leaves its exit code in `exit_code`.
void add_run_command(CLI::App& app, int& exit_code);
void add_explain_command(CLI::App& app, int& exit_code);
void add_list_command(CLI::App& app, int& exit_code);
void add_schema_command(CLI::App& app, int& exit_code);

}  // namespace slipcheck
