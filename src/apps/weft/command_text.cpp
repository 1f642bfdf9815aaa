#include "apps/weft/command_text.h"

#include <algorithm>
#include <stdexcept>

#include "apps/weft/commands.h"
#include "scene/aov.h"

namespace weft::apps {

namespace {

std::vector<std::string> split(std::string_view text, char at) {
    std::vector<std::string> parts{""};
    for (char c : text)
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

std::vector<std::string> aov_names() {
    std::vector<std::string> names{"list"};
    for (scene::AovInfo const& aov : scene::kAovs) names.emplace_back(aov.name);
    return names;
}

/// What can be offered for a value that help calls `word`. Every word that an option uses has a
/// row.
Offer offer_of(std::string const& word) {
    if (word.starts_with('{')) return Words{split(word.substr(1, word.size() - 2), ',')};
    auto const is = [&](std::initializer_list<std::string_view> words) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    Files const pictures{{".exr", ".hdr", ".png", ".jpg", ".jpeg", ".tif", ".tiff"}};
    if (is({"SCENE"})) return Files{{".xml", ".gltf", ".glb"}};
    if (is({"FILE...", "OLD", "NEW"})) return Files{{".xml"}};
    if (is({"IN", "IN...", "A [B...] REFERENCE", "LAYER|FILE", "OUT"})) return pictures;
    if (is({"OUT.png"})) return Files{{".png"}};
    if (is({"OUT.html"})) return Files{{".html", ".htm"}};
    if (is({"OUT.tx"})) return Files{{".tx"}};
    if (is({"PART"})) return Files{{".weft"}};
    if (is({"FILE"})) return Files{};
    if (is({"FOLDER"})) return Folders{};
    if (is({"AOV,..."})) return Words{aov_names()};
    if (is({"TYPE"})) return Words{help_topics()};
    if (is({"BOOLEAN"})) return Words{{"true", "false"}};
    if (is({"INT",     "UINT",   "INTEGER",     "FLOAT",
            "TEXT",    "STRING", "COLOR",       "VECTOR",
            "VECTOR2", "X",      "TIME",        "SIZE",
            "WxH|P%",  "x,y",    "x0,y0,x1,y1", "PATH.PARAM=VALUE",
            "K/N",     "A:B",    "HOST:PORT",   "LAYER,...",
            "LAYER",   "NAMES"}))
        return AnyText{};
    throw std::logic_error("offer_of has no row for values that help calls " + word);
}

/// What help shows for the value, without what checks add to it; a choice is its words in braces.
std::string value_word(CLI::Option& option) {
    std::string word = option.get_type_name(), checks;
    for (int i = 0;; ++i) {
        std::string text;
        try {
            text = option.get_validator(i)->get_description();
        } catch (CLI::OptionNotFound const&) { // beyond the last
            break;
        }
        if (text.starts_with('{')) return text;
        if (!text.empty()) checks += ":" + text;
    }
    return word.substr(0, word.size() - checks.size());
}

ArgumentText argument_text(CLI::Option& option) {
    ArgumentText text{.help = option.get_description(),
                      .group = option.get_group(),
                      .required = option.get_required(),
                      .repeats =
                          option.get_items_expected_max() > 1 ||
                          option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll};
    for (std::string const& name : option.get_snames()) text.names.push_back("-" + name);
    for (std::string const& name : option.get_lnames()) text.names.push_back("--" + name);
    if (option.get_items_expected_max() > 0) {
        text.value = value_word(option);
        text.offer = offer_of(text.value);
    }
    return text;
}

CommandText command_text(CLI::App& app) {
    CommandText text{.name = app.get_name(), .help = app.get_description()};
    for (CLI::Option* option : app.get_options())
        (option->get_positional() ? text.arguments : text.options)
            .push_back(argument_text(*option));
    return text;
}

} // namespace

std::vector<CommandText> command_texts(CLI::App& app) {
    std::vector<CommandText> texts{command_text(app)};
    for (CLI::App* command : app.get_subcommands({})) texts.push_back(command_text(*command));
    return texts;
}

std::string choice_text(std::vector<std::string> const& words) {
    std::string text;
    for (std::string const& word : words) text += (text.empty() ? "{" : ",") + word;
    return text + "}";
}

} // namespace weft::apps
