// What the nodes of a network give. Numbers fit every input; a colour fits a number as its mean;
// between colours and vectors a `convert` node has to say what is meant.
#pragma once

#include <optional>

#include "base/match.h"
#include "scene/texture.h"
#include "schema/describe.h"

namespace weft::scene {

constexpr ValueType literal_type(AnyValue const& v) {
    return v.count == 1 ? ValueType::number : v.count == 2 ? ValueType::vector2 : ValueType::triple;
}

/// Returns whether an input that takes `wanted` can be fed with `given`.
constexpr bool accepts(ValueType wanted, ValueType given) {
    return wanted == ValueType::inputs || given == ValueType::number || given == wanted ||
           (wanted == ValueType::number && given == ValueType::color);
}

/// The type that values of both types have together, or none.
constexpr std::optional<ValueType> common_type(ValueType a, ValueType b) {
    if (a == b || b == ValueType::number) return a;
    if (a == ValueType::number) return b;
    auto solid = [](ValueType t) { return t == ValueType::color || t == ValueType::vector3; };
    if (a == ValueType::triple && solid(b)) return b;
    if (b == ValueType::triple && solid(a)) return a;
    return {};
}

/// Passed to `describe`: the common type of the AnyValue inputs, and the first that has none.
/// `type_of` tells what the node of an id gives.
template <class F>
struct InputTypes {
    F& type_of;
    ValueType type = ValueType::number;
    std::string_view clash = {}; ///< the name of an input that does not fit those before it
    ValueType clashing = ValueType::none;

    void operator()(std::string_view name, Input<AnyValue> const& in, schema::Attr const&) {
        if (!clash.empty()) return;
        ValueType const given = in.texture ? type_of(in.texture) : literal_type(in.value);
        if (auto const common = common_type(type, given)) {
            type = *common;
        } else {
            clash = name;
            clashing = given;
        }
    }
    template <class T>
    void operator()(std::string_view, T const&, schema::Attr const&) {}
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }
};
template <class F>
InputTypes(F&) -> InputTypes<F>;

/// Returns the type of what `node` gives.
template <class Node, class F>
ValueType output_type(Node node, F const& type_of) {
    if constexpr (requires { node.output_type(); }) {
        return node.output_type();
    } else if constexpr (Node::info.output == ValueType::inputs) {
        InputTypes<F const> types{type_of};
        node.describe(types);
        return types.type == ValueType::triple ? ValueType::color : types.type;
    } else {
        return Node::info.output;
    }
}

} // namespace weft::scene
