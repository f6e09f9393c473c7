#include "engine/engine_text.h"

#include "base/text.h"

namespace slipcheck {

std::string harmless(std::string_view text) {
  std::string result;
  for (const char c : printable(text)) {
    const bool begins_word = result.size() == 1 || result.ends_with(" :");
    const bool is_command =
        (c == ':' && result.ends_with(':') && begins_word) || (c == '[' && result.ends_with("##"));
    if (is_command) result += ' ';
    result += c;
  }
  return result;
}

void make_harmless(nlohmann::json& message) {
  if (message.is_string()) {
    auto& text = message.get_ref<std::string&>();
    if (valid_utf8(text) == text) text = harmless(text);
  } else if (message.is_array()) {
    for (nlohmann::json& each : message) make_harmless(each);
  } else if (message.is_object()) {
    nlohmann::json members = nlohmann::json::object();
    for (auto& [name, each] : message.items()) {
      make_harmless(each);
      members[valid_utf8(name) == name ? harmless(name) : name] = std::move(each);
    }
    message = std::move(members);
  }
}

}  // namespace slipcheck
