#include "studies/tuning/tuning_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "studies/tuning/tuning_fields.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

/// The first line, by which a journal is told from any other file.
constexpr std::string_view kHead = "{\"slipcheck-tuning-journal\":1}\n";

std::string line_of(const std::string& question, const TuningJournal::Answer& answer) {
  const Json json = FieldWriter<Json, NotFinite::null>::json_of_value(answer);
  return fmt::format("{{\"question\":{},\"answer\":{}}}\n", question, json.dump());
}

TuningJournal::Answer answer_of(const nlohmann::json& json) {
  TuningJournal::Answer answer;
  BasicFieldReader<true>::read(JsonNode(json, "answer"), answer);
  return answer;
}

std::string read_all(int descriptor) {
  std::string text;
  char buffer[1 << 16];
  for (;;) {
    const ssize_t got = ::read(descriptor, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw BadJournal(std::strerror(errno));
    if (got == 0) return text;
    text.append(buffer, static_cast<std::size_t>(got));
  }
}

}  // namespace

TuningJournal::TuningJournal(const std::filesystem::path& file) : file_(file) {
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw BadJournal(fmt::format("{}: {}", file.string(), std::strerror(errno)));
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) throw BadJournal("another process writes it");
    const std::string text = read_all(descriptor_);
    // An interrupted first write left a part of the head.
    if (kHead.starts_with(text)) {
      if (::ftruncate(descriptor_, 0) != 0) throw BadJournal(std::strerror(errno));
      append(std::string(kHead));
    } else {
      read(text);
    }
  } catch (const std::exception& error) {
    ::close(descriptor_);
    throw BadJournal(fmt::format("{}: {}", file.string(), error.what()));
  }
}

TuningJournal::~TuningJournal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void TuningJournal::read(const std::string& text) {
  if (!text.starts_with(kHead)) throw BadJournal("must be a journal of slipcheck tune");
  std::size_t line = 1;
  std::size_t begin = kHead.size();
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    ++line;
    try {
      const Json entry = Json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                     text.begin() + static_cast<std::ptrdiff_t>(end));
      answers_[entry.at("question").dump()] = answer_of(entry.at("answer"));
    } catch (const Json::exception&) {
      throw BadJournal(fmt::format("line {} is no entry of a journal", line));
    } catch (const BadJson& bad) {
      throw BadJournal(fmt::format("line {} is no entry of a journal: {}", line, bad.what()));
    }
  }
  // What follows the last whole line was cut off when it was written.
  if (begin < text.size() && ::ftruncate(descriptor_, static_cast<off_t>(begin)) != 0)
    throw BadJournal(std::strerror(errno));
}

const TuningJournal::Answer* TuningJournal::find(const std::string& question) const {
  const auto found = answers_.find(question);
  return found == answers_.end() ? nullptr : &found->second;
}

void TuningJournal::add(const std::vector<std::pair<std::string, Answer>>& answers) {
  std::string text;
  for (const auto& [question, answer] : answers) {
    answers_[question] = answer;
    text += line_of(question, answer);
  }
  if (descriptor_ >= 0 && !text.empty()) append(text);
}

void TuningJournal::append(const std::string& text) {
  std::string_view left = text;
  while (!left.empty()) {
    const ssize_t written = ::write(descriptor_, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      throw std::runtime_error(
          fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(errno)));
    left.remove_prefix(static_cast<std::size_t>(written));
  }
  // To the disk once a second: what is written outlives the process anyhow, and syncing each time
  // would take longer than a run.
  const auto now = std::chrono::steady_clock::now();
  if (now - synced_ < std::chrono::seconds(1)) return;
  synced_ = now;
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL)
    throw std::runtime_error(
        fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(errno)));
}

}  // namespace slipcheck
