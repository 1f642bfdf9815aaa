// The parameters of a described type (schema/describe.h) as options of a command: `inputSpace`
// becomes --input-space. What the user gives is kept as text, and replaces the value in an object
// that may come from a scene file.
//
// Objects, lists and transforms have no text that one would type, and get no option.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "apps/weft/command_text.h"
#include "base/error.h"
#include "schema/schema.h"

namespace weft::apps {

/// Returns "--input-space" for the parameter "inputSpace".
inline std::string option_name(std::string_view parameter) {
    std::string name = "--";
    for (char c : parameter) {
        bool const upper = c >= 'A' && c <= 'Z';
        if (upper) name += '-';
        name += upper ? char(c - 'A' + 'a') : c;
    }
    return name;
}

/// The texts that the user gave, by parameter.
using OptionTexts = std::map<std::string, std::string>;

namespace detail {

template <class T>
inline constexpr bool has_option = requires(T& value) {
    schema::TextForm<T>::read(std::string_view(), value);
};

struct OptionAdder {
    CLI::App& command;
    OptionTexts& texts;
    std::string heading;

    template <class T>
    void operator()(std::string_view parameter, T& value, schema::Attr const& attr) {
        if constexpr (has_option<T>) {
            std::string type(schema::TextForm<T>::kind);
            for (char& c : type) c = char(std::toupper(static_cast<unsigned char>(c)));
            std::string help(attr.help);
            if (!attr.unit.empty()) help += " [" + std::string(attr.unit) + "]";
            if constexpr (schema::Choice<T>) {
                auto const names = choices(value);
                type = choice_text({names.begin(), names.end()});
            }
            std::string const name(parameter);
            command
                .add_option_function<std::string>(
                    option_name(parameter),
                    [&kept = texts, name](std::string const& text) { kept[name] = text; }, help)
                ->type_name(type)
                ->group(heading);
        }
    }
};

struct OptionApplier {
    OptionTexts const& texts;

    template <class T>
    void operator()(std::string_view parameter, T& value, schema::Attr const& attr) {
        auto const given = texts.find(std::string(parameter));
        if (given == texts.end()) return;
        if constexpr (has_option<T>) {
            bool const understood = schema::TextForm<T>::read(given->second, value);
            auto const numbers = schema::read_numbers(given->second);
            bool in_range = true;
            if (understood && numbers)
                for (double x : *numbers) in_range &= x >= attr.min && x <= attr.max;
            if (understood && in_range) return;
            std::string expected(schema::TextForm<T>::expected);
            if constexpr (schema::Choice<T>)
                for (std::string_view c : choices(value)) expected += " " + std::string(c);
            if (std::isfinite(attr.min))
                expected += " of at least " + schema::number_text(attr.min);
            if (std::isfinite(attr.max)) expected += ", at most " + schema::number_text(attr.max);
            throw InputError(option_name(parameter) + " expects " + expected + ", found '" +
                             given->second + "'");
        }
    }
};

} // namespace detail

/// Adds an option for each parameter of T, under `heading` in its help. `texts` has to live as long
/// as the command.
template <class T>
void add_described_options(CLI::App& command, OptionTexts& texts, std::string const& heading) {
    T object{};
    object.describe(detail::OptionAdder{command, texts, heading});
}

/// Sets the parameters of `object` that the user gave. Throws InputError with the option's name.
template <class T>
void apply_options(OptionTexts const& texts, T& object) {
    object.describe(detail::OptionApplier{texts});
}

} // namespace weft::apps
