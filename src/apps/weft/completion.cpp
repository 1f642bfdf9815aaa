#include "apps/weft/completion.h"

#include <fmt/format.h>

#include "base/match.h"

namespace weft::apps {

namespace {

std::string joined(std::vector<std::string> const& words, std::string_view between) {
    return fmt::format("{}", fmt::join(words, between));
}

/// `text` with `with` before each of the characters `of`.
std::string escaped(std::string_view text, std::string_view of, std::string_view with = "\\") {
    std::string result;
    for (char c : text) {
        if (of.find(c) != std::string_view::npos) result += with;
        result += c;
    }
    return result;
}

/// In single quotes, for bash and zsh.
std::string in_single_quotes(std::string_view text) {
    std::string result = "'";
    for (char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
    return result + "'";
}

std::string extensions(Files const& files, std::string_view between) {
    std::string result;
    for (std::string const& suffix : files.suffixes)
        result += (result.empty() ? "" : std::string(between)) + suffix.substr(1);
    return result;
}

std::vector<std::string> option_names(CommandText const& command) {
    std::vector<std::string> names;
    for (ArgumentText const& option : command.options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

std::string bash_action(Offer const& offer) {
    return match(offer,
                 Overloaded{[](AnyText const&) { return std::string(":"); },
                            [](Words const& w) {
                                return "_weft_words " + in_single_quotes(joined(w.words, " "));
                            },
                            [](Files const& f) {
                                return f.suffixes.empty() ? "_weft_files"
                                                          : "_weft_files " + extensions(f, " ");
                            },
                            [](Folders const&) { return std::string("_weft_folders"); }});
}

constexpr std::string_view bash_functions = R"sh(
_weft_words() { COMPREPLY=($(compgen -W "$1" -- "$cur")); }
_weft_folders() {
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$cur")
}
# Files that end in one of these, in whatever case, and folders on the way to them.
_weft_files() {
    compopt -o filenames 2>/dev/null
    local file suffix
    COMPREPLY=()
    while IFS= read -r file; do
        [[ $# == 0 || -d ${file/#\~/$HOME} ]] && COMPREPLY+=("$file") && continue
        for suffix; do
            [[ ${file,,} == *.$suffix ]] && COMPREPLY+=("$file") && break
        done
    done < <(compgen -f -- "$cur")
}
_weft() {
    local cur=${COMP_WORDS[COMP_CWORD]} at=$COMP_CWORD
    COMPREPLY=()
    # bash takes --option=value apart.
    [[ $cur == = ]] && cur=
    [[ ${COMP_WORDS[COMP_CWORD]} != = && ${COMP_WORDS[COMP_CWORD - 1]} == = ]] && at=$((COMP_CWORD - 1))
    local prev=${COMP_WORDS[at - 1]}
)sh";

/// "render:-o|render:--output" of the options that have values.
std::string bash_pattern(CommandText const& command, ArgumentText const& option) {
    std::vector<std::string> names;
    for (std::string const& name : option.names) names.push_back(command.name + ":" + name);
    return joined(names, "|");
}

// zsh's _arguments ends a part of its specification at a colon, and a description at a bracket.
std::string zsh_text(std::string_view text) { return escaped(text, "[]:\\"); }

std::string zsh_action(ArgumentText const& argument) {
    return match(argument.offer,
                 Overloaded{[](AnyText const&) { return std::string(" "); },
                            [](Words const& w) {
                                std::vector<std::string> words;
                                for (std::string const& word : w.words)
                                    words.push_back(escaped(word, ":\\ ()"));
                                return "(" + joined(words, " ") + ")";
                            },
                            [](Files const& f) {
                                return f.suffixes.empty() ? std::string("_files")
                                                          : fmt::format("_files -g \"(#i)*.({})\"",
                                                                        extensions(f, "|"));
                            },
                            [](Folders const&) { return std::string("_files -/"); }});
}

std::string zsh_option(ArgumentText const& option) {
    std::string const text = fmt::format("[{}]", zsh_text(option.help));
    std::string const value =
        option.value.empty() ? ""
                             : fmt::format(":{}:{}", zsh_text(option.value), zsh_action(option));
    std::string const several = option.repeats ? "'*'"
                                : option.names.size() > 1
                                    ? in_single_quotes("(" + joined(option.names, " ") + ")")
                                    : "";
    std::string const names =
        option.names.size() > 1 ? "{" + joined(option.names, ",") + "}" : option.names.front();
    return several + names + in_single_quotes(text + value);
}

std::string zsh_argument(ArgumentText const& argument) {
    return in_single_quotes(fmt::format("{}:{}:{}",
                                        argument.repeats    ? "*"
                                        : argument.required ? ""
                                                            : ":",
                                        zsh_text(argument.value), zsh_action(argument)));
}

std::string fish_quoted(std::string_view text) { return "'" + escaped(text, "'\\") + "'"; }

constexpr std::string_view fish_functions =
    R"fish(# fish completion of weft; made by `weft completion fish`.
# Files that end in one of these, in whatever case, and folders on the way to them.
function __weft_files
    set -l endings (string join '|' $argv)
    complete -C "'' "(commandline -ct) | string match -ri -- "^.*(?:/|\\.(?:$endings))\$"
end
complete -c weft -f
)fish";

std::string fish_offer(Offer const& offer) {
    return match(
        offer,
        Overloaded{
            [](AnyText const&) { return std::string(" -x"); },
            [](Words const& w) { return " -x -a " + fish_quoted(joined(w.words, " ")); },
            [](Files const& f) {
                return f.suffixes.empty() ? std::string(" -r -F")
                                          : " -k -x -a '(__weft_files " + extensions(f, " ") + ")'";
            },
            [](Folders const&) { return std::string(" -x -a '(__fish_complete_directories)'"); }});
}

} // namespace

std::string bash_completion(std::vector<CommandText> const& commands) {
    std::string text = "# bash completion of weft; made by `weft completion bash`.";
    text += bash_functions;
    std::vector<std::string> first = option_names(commands.front());
    for (size_t i = 1; i < commands.size(); ++i) first.push_back(commands[i].name);
    text +=
        fmt::format("    ((COMP_CWORD == 1)) && _weft_words '{}' && return\n", joined(first, " "));
    text += "    case ${COMP_WORDS[1]}:$prev in\n";
    for (size_t i = 1; i < commands.size(); ++i)
        for (ArgumentText const& option : commands[i].options)
            if (!option.value.empty())
                text += fmt::format("    {}) {}; return ;;\n", bash_pattern(commands[i], option),
                                    bash_action(option.offer));
    text += "    esac\n    case ${COMP_WORDS[1]}:$cur in\n";
    for (size_t i = 1; i < commands.size(); ++i) {
        CommandText const& command = commands[i];
        text += fmt::format("    {}:-*) _weft_words '{}' ;;\n", command.name,
                            joined(option_names(command), " "));
        // A command's arguments are all of one kind.
        if (!command.arguments.empty())
            text += fmt::format("    {}:*) {} ;;\n", command.name,
                                bash_action(command.arguments.front().offer));
    }
    return text + "    esac\n}\ncomplete -F _weft weft\n";
}

std::string zsh_completion(std::vector<CommandText> const& commands) {
    std::string text = "#compdef weft\n# zsh completion of weft; made by `weft completion zsh`.\n\n"
                       "_weft() {\n    local curcontext=$curcontext state line\n    _arguments -C";
    for (ArgumentText const& option : commands.front().options)
        text += " \\\n        " + zsh_option(option);
    text += " \\\n        '1:command:->command' '*::argument:->argument'\n"
            "    case $state in\n    command)\n        local -a commands=(\n";
    for (size_t i = 1; i < commands.size(); ++i)
        text += fmt::format("            {}\n", in_single_quotes(commands[i].name + ":" +
                                                                 escaped(commands[i].help, ":\\")));
    text += "        )\n        _describe command commands\n        ;;\n    argument)\n        "
            "case $words[1] in\n";
    for (size_t i = 1; i < commands.size(); ++i) {
        text += fmt::format("        {})\n            _arguments -s", commands[i].name);
        for (ArgumentText const& option : commands[i].options)
            text += " \\\n                " + zsh_option(option);
        for (ArgumentText const& argument : commands[i].arguments)
            text += " \\\n                " + zsh_argument(argument);
        text += "\n            ;;\n";
    }
    return text +
           "        esac\n        ;;\n    esac\n}\n\n"
           "if [[ $funcstack[1] == _weft ]]; then _weft \"$@\"; else compdef _weft weft; fi\n";
}

std::string fish_completion(std::vector<CommandText> const& commands) {
    std::string text(fish_functions);
    auto const add = [&](std::string const& condition, ArgumentText const& argument) {
        text += "complete -c weft -n " + fish_quoted(condition);
        for (std::string const& name : argument.names)
            text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
        if (!argument.names.empty()) text += " -d " + fish_quoted(argument.help);
        if (!argument.value.empty()) text += fish_offer(argument.offer);
        text += '\n';
    };
    for (ArgumentText const& option : commands.front().options)
        add("__fish_use_subcommand", option);
    for (size_t i = 1; i < commands.size(); ++i) {
        CommandText const& command = commands[i];
        text += fmt::format("complete -c weft -n __fish_use_subcommand -a {} -d {}\n", command.name,
                            fish_quoted(command.help));
        std::string const condition = "__fish_seen_subcommand_from " + command.name;
        for (ArgumentText const& option : command.options) add(condition, option);
        if (!command.arguments.empty()) add(condition, command.arguments.front());
    }
    return text;
}

} // namespace weft::apps
