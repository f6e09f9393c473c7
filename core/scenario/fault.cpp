#include "scenario/fault.h"

#include <utility>

namespace slipcheck {
namespace {

std::string all_messages(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += fault.message();
  }
  return text;
}

}  // namespace

std::string Fault::message() const {
  std::string text = file;
  if (location.line > 0) {
    text += ':' + std::to_string(location.line) + ':' + std::to_string(location.column);
  }
  if (!key.empty()) text += ": " + key;
  text += ": " + rule;
  if (!value.empty()) text += ", got " + value;
  return text;
}

BadScenario::BadScenario(std::vector<Fault> faults)
    : std::runtime_error(all_messages(faults)), faults_(std::move(faults)) {}

}  // namespace slipcheck
