// The command line as plain data: what completions for shells and the manual page are made of. It
// is read from the declarations that also parse the arguments.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <variant>
#include <vector>

namespace weft::apps {

// What a shell can offer for a value: nothing, fixed words, files by the ends of their names (lower
// case, with the dot; none means any), or folders. Folders are offered on the way to a file, too.
struct AnyText {};
struct Words {
    std::vector<std::string> words;
};
struct Files {
    std::vector<std::string> suffixes;
};
struct Folders {};
using Offer = std::variant<AnyText, Words, Files, Folders>;

/// An option, a flag, or an argument that is known by its place.
struct ArgumentText {
    std::vector<std::string> names; ///< such as "-o" and "--output"; none: known by its place
    std::string value;              ///< what stands for its value in help; "" for a flag
    std::string help;
    std::string group; ///< the heading in help
    Offer offer;
    bool required = false;
    bool repeats = false; ///< takes several values
};

struct CommandText {
    std::string name, help;
    std::vector<ArgumentText> options, arguments;
};

/// Returns the program itself, and then its commands in the order of their declaration. Throws
/// std::logic_error where an option names its value by a word of which `offer_of` has not been
/// told.
std::vector<CommandText> command_texts(CLI::App& app);

/// Returns what stands for a value that is one of the words: "{a,b}".
std::string choice_text(std::vector<std::string> const& words);

} // namespace weft::apps
