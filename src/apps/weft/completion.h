// Scripts that complete Weft's commands, options and values in a shell, made of the command line's
// own declarations.
#pragma once

#include <string>
#include <vector>

#include "apps/weft/command_text.h"

namespace weft::apps {

/// Each takes what command_texts returns. Every script works when it is sourced, and when the shell
/// loads it from its folder of completions.
std::string bash_completion(std::vector<CommandText> const& commands);
std::string zsh_completion(std::vector<CommandText> const& commands);
std::string fish_completion(std::vector<CommandText> const& commands);

} // namespace weft::apps
