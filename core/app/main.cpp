#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/say.h"
#include "base/stop_scope.h"
#include "base/text.h"
#include "report/rows/context.h"
#include "scenario/fault.h"
#include "scenario/rules/rules.h"
#include "scene/scene.h"
#include "studies/sweep/sweep_store.h"

namespace slipcheck {
namespace {

/// The exit code, unless some of what was printed is lost: a full disk shows only now.
int printed(int exit_code) {
  if (exit_code == kNotWritten) return exit_code;  // which has been told
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && !std::ferror(stdout)) return exit_code;
  say("slipcheck: cannot write to stdout{}\n",
      errno == 0 ? "" : ": " + std::generic_category().message(errno));
  return kNotWritten;
}

/// Lines that say what is wrong, with names and values out of files that others wrote.
std::string lines_of(std::string_view text) {
  std::string lines;
  while (true) {
    const std::size_t end = text.find('\n');
    lines += printable(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    lines += '\n';
    text.remove_prefix(end + 1);
  }
}

/// The words that could stand where `written` does: commands, or the options of the command that
/// was given.
std::vector<std::string> words_like(const CLI::App& app, const std::string& written) {
  const auto given = app.get_subcommands();
  const CLI::App& command = given.empty() ? app : *given.back();
  std::vector<std::string> words;
  if (written.starts_with("-"))
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  else
    for (const CLI::App* each : command.get_subcommands({})) words.push_back(each->get_name());
  return words;
}

/// "Did you mean run?" for the first argument that no command knows; empty where nothing is near.
std::string meant_word(const CLI::App& app) {
  for (const std::string& extra : app.remaining(true)) {
    const std::string written = extra.substr(0, extra.find('='));
    if (const std::string near = nearest(written, words_like(app, written)); !near.empty())
      return fmt::format("Did you mean {}?\n", near);
  }
  return {};
}

int run_command_line(int argc, char** argv) {
  CLI::App app{
      "Slipcheck holds physics engines against a reference of spheres that collide, slide and "
      "roll."};
  app.set_version_flag("--version", fmt::format("slipcheck {} ({}, {})", context().version,
                                                context().commit, context().build));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all within tolerance, 1 something deviates or is undecided, 2 bad input,\n"
      "3 an engine failed, 4 the results could not be written, 130 interrupted.\n\nExample:\n  "
      "slipcheck run "
      "scenarios/symmetric-30cms.yaml --phases 64");
  int exit_code = kWithinTolerance;
  try {
    add_run_command(app, exit_code);
    add_check_command(app, exit_code);
    add_engines_command(app, exit_code);
    add_completion_command(app, exit_code);
    add_conformance_command(app, exit_code);
    add_convert_command(app, exit_code);
    add_explain_command(app, exit_code);
    add_figures_command(app, exit_code);
    add_gas_command(app, exit_code);
    add_list_command(app, exit_code);
    add_manual_command(app, exit_code);
    add_merge_command(app, exit_code);
    add_precision_command(app, exit_code);
    add_query_command(app, exit_code);
    add_report_command(app, exit_code);
    add_schema_command(app, exit_code);
    add_stability_command(app, exit_code);
    add_sweep_command(app, exit_code);
    add_tune_command(app, exit_code);
    add_versions_command(app, exit_code);
    const StopScope scope(&interrupted());
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version end well; everything else is bad input.
    std::ostringstream out, trouble;
    const bool well = app.exit(error, out, trouble) == 0;
    std::fputs(out.str().c_str(), stdout);
    say("{}", trouble.str());
    if (!well) say("{}", meant_word(app));
    return well ? kWithinTolerance : kBadInput;
  } catch (const BadScenario& bad) {
    say("{}\n", lines_of(bad.what()));
    return kBadInput;
  } catch (const Unsupported& unsupported) {
    say("{}\n", lines_of(unsupported.what()));
    return kBadInput;
  } catch (const Interrupted& stopped) {
    say("{}\n", stopped.what());
    return kInterrupted;
  } catch (const BadOption& bad) {
    say("slipcheck: {}\n", lines_of(bad.what()));
    return kBadInput;
  } catch (const BadStore& bad) {
    say("slipcheck: {}\n", lines_of(bad.what()));
    return kBadInput;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    say("slipcheck: {}\n", lines_of(error.what()));
    return kNotWritten;
  }
  return exit_code;
}

constexpr char kOutOfMemory[] = "slipcheck: out of memory\n";

/// Destructors that need memory (a JSON tree's, to take itself apart) end here where there is none:
/// that too is told, and no abort.
[[noreturn]] void end_for_want_of_memory() {
  const std::exception_ptr thrown = std::current_exception();
  if (!thrown) std::abort();
  try {
    std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    static_cast<void>(!::write(STDERR_FILENO, kOutOfMemory, sizeof kOutOfMemory - 1));
    ::_exit(kNotWritten);
  } catch (...) {
    std::abort();
  }
}

}  // namespace
}  // namespace slipcheck

int main(int argc, char** argv) {
  // What grows beyond the limit of a file's size is then an error of its write.
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(slipcheck::end_for_want_of_memory);
  // What is larger goes back to the system once it is freed: of a million bodies a quarter would
  // lie idle, as the limit rises by itself with what was freed.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  try {
    return slipcheck::printed(slipcheck::run_command_line(argc, argv));
  } catch (const std::bad_alloc&) {
    // There may be none to word it with either.
    std::fputs(slipcheck::kOutOfMemory, stderr);
    return slipcheck::kNotWritten;
  }
}
