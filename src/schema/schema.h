// The runtime form of the declarations: what `weft help`, the reference pages, the JSON for other
// programs and the scene reader's error messages are made from.
#pragma once

#include <string>
#include <vector>

#include "schema/describe.h"
#include "schema/text.h"

namespace weft::schema {

struct Field {
    std::string name;
    std::string kind;          ///< "float", "color", "choice", "choices", "object", "list", ...
    std::string category;      ///< for objects and lists: the tag that fills it
    std::string default_value; ///< as written in a file; "" where there is none
    std::vector<std::string> choices;
    Attr attr;
};

struct Schema {
    TypeInfo info;
    std::vector<Field> fields;
};

namespace detail {

struct SchemaBuilder {
    Schema& schema;

    template <class T>
    void operator()(std::string_view name, T& value, Attr const& attr) {
        using Text = TextForm<T>;
        Field field{std::string(name), std::string(Text::kind), {}, Text::write(value), {}, attr};
        if constexpr (requires { Text::category(); }) field.category = Text::category();
        if constexpr (Choice<T>)
            for (std::string_view c : choices(value)) field.choices.emplace_back(c);
        else if constexpr (ChoiceList<T>)
            for (std::string_view c : choices(typename T::value_type()))
                field.choices.emplace_back(c);
        schema.fields.push_back(std::move(field));
    }
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }
};

} // namespace detail

/// The schema of a described type, from one default object.
template <class T>
Schema schema_of() {
    static_assert(all_described<T>, "describe() leaves out a member of this type");
    Schema schema{T::info, {}};
    T object{};
    object.describe(detail::SchemaBuilder{schema});
    return schema;
}

/// The parameters of one type as text for a terminal.
std::string help_text(Schema const& schema);

/// A reference page in Markdown for the types of one category.
std::string reference_page(std::string const& category, std::vector<Schema> const& schemas);

/// All schemas as JSON: {"version": 1, "types": [{"category", "type", "help", "parameters":
/// [...]}]}.
std::string to_json(std::vector<Schema> const& schemas);

} // namespace weft::schema
