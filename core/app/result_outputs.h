#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "report/rows/report_content.h"

namespace slipcheck {

/// The files that `run` and `report` make of results; an empty path is not written.
struct ResultOutputs {
  std::string html, csv, phases_csv, markdown, engines, junit;  ///< files
  std::string svg, xyz, vtk;                                    ///< folders
  bool without_script = false;
  bool allow_undecided = false;  ///< is no failure

  /// Whether something of it shows how bodies move.
  bool show_motion() const;
};

/// Adds the options; that of the page under its own name, "--html" or "-o,--html".
void add_result_outputs(CLI::App& command, ResultOutputs& outputs, const std::string& page_option);

/// Refuses what cannot be written in the end: throws BadOption.
void check_outputs(const ResultOutputs& outputs);

/// Writes what is asked for. Throws WriteFailure, and std::runtime_error where gnuplot fails.
void write_outputs(const ResultOutputs& outputs, const ReportContent& content);

}  // namespace slipcheck
