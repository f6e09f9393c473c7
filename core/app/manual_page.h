#pragma once

#include <string>

#include "app/command_words.h"

namespace slipcheck {

/// "slipcheck-engines" of the command `slipcheck engines`: the name of its page.
std::string page_name(const CommandWords& command);

/// The manual page, section 1, of a command: of `top` itself what all commands share, of one below
/// it that with all below it. `version` is the program's. In the language of man(7).
std::string manual_page(const CommandWords& top, const CommandWords& command,
                        const std::string& version);

}  // namespace slipcheck
