// A scene file in today's words: what `weft convert` writes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace weft::io {

struct Converted {
    std::string text;
    std::vector<std::string> notes; ///< as of `modernise`; of files that it includes, too
};

/// Rewrites a scene file of other dialects (io/modernise.h), for a file at `new_path`. Only what
/// has to change does: comments, layout and whatever is today's already are as they were, and
/// relative file names lead from the new file to where they led. Included files are not converted;
/// the notes name them. Throws InputError.
Converted convert_scene(std::string_view text, std::string const& old_path,
                        std::string const& new_path);

} // namespace weft::io
