#pragma once

#include <CLI/App.hpp>
#include <stdexcept>

namespace slipcheck {

/// Exit codes of the command line; others build on them.
enum ExitCode {
  kWithinTolerance = 0,
  kDeviates = 1,
  kBadInput = 2,
  kEngineFailed = 3,
  kNotWritten = 4,  ///< after the run: the disk is full, or the like
  kInterrupted = 130,
};

/// Every command takes --quiet; those that print nothing but their result have nothing to leave
/// out.
inline void accept_quiet(CLI::App& command) {
  command.add_flag_callback(
      "-q,--quiet", [] {}, "Say nothing but the result");
}

/// An option that cannot be followed; the message gives option, rule and value.
class BadOption : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Each adds its command to the program. The command's callback leaves its exit code in `exit_code`.
void add_run_command(CLI::App& app, int& exit_code);
void add_check_command(CLI::App& app, int& exit_code);
void add_engines_command(CLI::App& app, int& exit_code);
void add_completion_command(CLI::App& app, int& exit_code);
void add_conformance_command(CLI::App& app, int& exit_code);
void add_convert_command(CLI::App& app, int& exit_code);
void add_explain_command(CLI::App& app, int& exit_code);
void add_figures_command(CLI::App& app, int& exit_code);
void add_gas_command(CLI::App& app, int& exit_code);
void add_list_command(CLI::App& app, int& exit_code);
void add_manual_command(CLI::App& app, int& exit_code);
void add_merge_command(CLI::App& app, int& exit_code);
void add_precision_command(CLI::App& app, int& exit_code);
void add_query_command(CLI::App& app, int& exit_code);
void add_report_command(CLI::App& app, int& exit_code);
void add_schema_command(CLI::App& app, int& exit_code);
void add_stability_command(CLI::App& app, int& exit_code);
void add_sweep_command(CLI::App& app, int& exit_code);
void add_tune_command(CLI::App& app, int& exit_code);
void add_versions_command(CLI::App& app, int& exit_code);

}  // namespace slipcheck
