// The manual page weft(1), made of the command line's own declarations.
#pragma once

#include <string>
#include <vector>

#include "apps/weft/command_text.h"

namespace weft::apps {

/// Returns the page in the language of man(7), of what command_texts returns.
std::string man_page(std::vector<CommandText> const& commands);

} // namespace weft::apps
