#include "apps/weft/man_page.h"

#include <algorithm>
#include <fmt/format.h>

namespace weft::apps {

namespace {

/// Text for a line of its own: what roff would take for commands stands for itself, and what is in
/// backquotes becomes bold.
std::string roff(std::string_view text) {
    std::string result;
    bool bold = false;
    if (text.starts_with('.') || text.starts_with('\'')) result = "\\&";
    for (char c : text) switch (c) {
        case '\\':
            result += "\\e";
            break;
        case '-':
            result += "\\-";
            break;
        case '\'':
            result += "\\(aq";
            break;
        case '^':
            result += "\\(ha";
            break;
        case '~':
            result += "\\(ti";
            break;
        case '\n':
            result += "\n.br\n";
            break;
        case '`':
            bold = !bold;
            result += bold ? "\\fB" : "\\fR";
            break;
        default:
            result += c;
        }
    return result;
}

/// "a|b" of "{a,b}", and other words as they are.
std::string value_text(ArgumentText const& argument) {
    std::string text = argument.value;
    if (!text.starts_with('{')) return text;
    text = text.substr(1, text.size() - 2);
    std::replace(text.begin(), text.end(), ',', '|');
    return text;
}

std::string item(ArgumentText const& argument) {
    std::string text = ".TP\n";
    for (size_t i = 0; i < argument.names.size(); ++i)
        text += fmt::format("{}\\fB{}\\fR", i ? ", " : "", roff(argument.names[i]));
    if (!argument.value.empty())
        text += fmt::format("{}\\fI{}\\fR", argument.names.empty() ? "" : " ",
                            roff(value_text(argument)));
    return text + "\n" + roff(argument.help) + "\n";
}

std::string synopsis(CommandText const& command) {
    std::string text = fmt::format("\\fBweft {}\\fR", roff(command.name));
    for (ArgumentText const& a : command.arguments)
        text += (a.required ? " \\fI" : " [\\fI") + roff(a.value) + (a.required ? "\\fR" : "\\fR]");
    bool optional = false;
    for (ArgumentText const& o : command.options) {
        optional |= !o.required;
        if (o.required)
            text +=
                fmt::format(" \\fB{}\\fR \\fI{}\\fR", roff(o.names.front()), roff(value_text(o)));
    }
    return text + (optional ? " [\\fIoption\\fR ...]" : "");
}

/// The options by their headings in help, in the order of these.
std::string option_items(CommandText const& command) {
    std::vector<std::string> groups;
    for (ArgumentText const& o : command.options)
        if (std::find(groups.begin(), groups.end(), o.group) == groups.end())
            groups.push_back(o.group);
    std::string text;
    for (std::string const& group : groups) {
        if (groups.size() > 1) text += fmt::format(".PP\n\\fI{}\\fR\n", roff(group));
        for (ArgumentText const& o : command.options)
            if (o.group == group) text += item(o);
    }
    return text;
}

constexpr std::string_view ends = R"(.SH EXIT STATUS
.TP
.B 0
It is done.
.TP
.B 1
A test or a comparison failed.
.TP
.B 2
The input was wrong.
.TP
.B 3
An internal error.
.TP
.B 130
Stopped by Ctrl\-C; a render writes what is done.
.SH ENVIRONMENT
.TP
.B WEFT_WEIGHTS
Folder with the weights of the denoiser's network. After it are searched
.IR $XDG_DATA_HOME/weft/weights ,
.I share/weft/weights
beside the program's folder, and
.I weft/weights
in each of
.BR $XDG_DATA_DIRS .
.TP
.B XDG_CACHE_HOME
Tiled copies of large textures are kept in
.I weft/textures
in this folder.
.TP
.B OCIO
The OpenColorIO configuration whose views can be named.
.SH SEE ALSO
\fBweft help\fR explains every type and parameter of the scene file, \fBweft help materials\fR the
ready materials.
)";

} // namespace

std::string man_page(std::vector<CommandText> const& commands) {
    CommandText const& program = commands.front();
    std::string text =
        ".\\\" Made by `weft docs --man`.\n.TH WEFT 1 \"\" \"weft " WEFT_VERSION
        "\" \"User Commands\"\n.SH NAME\nweft \\- path tracer\n.SH SYNOPSIS\n"
        "\\fBweft\\fR \\fIcommand\\fR [\\fIargument\\fR ...]\n.SH DESCRIPTION\n"
        "Renders film\\-quality pictures of scenes in Weft's scene format and in glTF, and works "
        "on such pictures.\n";
    text += option_items(program);
    text += ".SH COMMANDS\n";
    for (size_t i = 1; i < commands.size(); ++i) {
        CommandText const& command = commands[i];
        text += fmt::format(".SS {0}\n{1}\n.PP\n{2}.\n", roff(command.name), synopsis(command),
                            roff(command.help));
        for (ArgumentText const& argument : command.arguments) text += item(argument);
        text += option_items(command);
    }
    return text + std::string(ends);
}

} // namespace weft::apps
