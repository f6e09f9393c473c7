#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "studies/tuning/tuning_score.h"

namespace slipcheck {

/// A file that is no journal, or that another process writes; the message says which and why.
class BadJournal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What has been found out so far, by question: nothing is run twice, and a tuning that was
/// interrupted goes on where it was. Of a file: one JSON object a line, handed to the system before
/// add() returns; a last line that was cut off is dropped.
class TuningJournal {
 public:
  struct Answer {
    RunScore score;
    double seconds = 0;  ///< of wall time that it took, >= 0

    bool operator==(const Answer&) const = default;
  };

  /// In memory only.
  TuningJournal() = default;
  /// Opens a file, or makes one. Throws BadJournal.
  explicit TuningJournal(const std::filesystem::path& file);
  ~TuningJournal();
  TuningJournal(const TuningJournal&) = delete;
  TuningJournal& operator=(const TuningJournal&) = delete;

  /// Null where the question has not been answered. A question is the text of a JSON object.
  const Answer* find(const std::string& question) const;

  /// Throws std::runtime_error if the file cannot be written.
  void add(const std::vector<std::pair<std::string, Answer>>& answers);

  std::size_t size() const { return answers_.size(); }

 private:
  void read(const std::string& text);
  void append(const std::string& text);

  std::filesystem::path file_;
  int descriptor_ = -1;                           ///< -1: in memory only
  std::chrono::steady_clock::time_point synced_;  ///< to the disk
  std::map<std::string, Answer> answers_;
};

}  // namespace slipcheck
