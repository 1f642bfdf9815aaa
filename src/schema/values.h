// The types that a described parameter may have, beside bool, int, float, std::string, SharedText,
// Color, Vec2, Vec3, Affined and enumerations with named choices.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/affine.h"
#include "base/color.h"

namespace weft::schema {

/// A typed index into one of the scene's vectors; -1 is "none". `Kind::category` is the tag.
template <class Kind>
struct Id {
    int32_t index = -1;
    constexpr explicit operator bool() const { return index >= 0; }
    friend constexpr bool operator==(Id, Id) = default;
};

/// A file that a parameter names. The reader resolves the path against the scene file's folder
/// and sets `resource` to the loaded data's index.
struct FileName {
    std::string path;
    int32_t resource = -1;
    friend bool operator==(FileName const&, FileName const&) = default;
};

/// What fills an Input: a node, written as a texture.
struct TextureKind {
    static constexpr char const* category = "texture";
};

/// What a node gives and an input takes, named in files as MaterialX does. `inputs`: what the
/// inputs of type AnyValue have; `chosen`: a parameter says it; `triple`: a literal of three
/// numbers, a colour or a vector.
enum class ValueType : uint8_t { none, number, color, vector2, vector3, inputs, chosen, triple };

constexpr std::string_view type_name(ValueType t) {
    constexpr std::array<std::string_view, 8> names{"nothing",
                                                    "float",
                                                    "color",
                                                    "vector2",
                                                    "vector3",
                                                    "what its inputs are",
                                                    "what `output` says",
                                                    "3 numbers"};
    return names[size_t(t)];
}

/// A literal of 1, 2 or 3 numbers, for inputs that take every type.
struct AnyValue {
    Vec3 v{0, 0, 0}; ///< one number stands in all three; of two, z is 0
    int count = 1;   ///< how many numbers it was written with

    constexpr AnyValue() = default;
    constexpr explicit AnyValue(float x) : v(x, x, x) {}
    constexpr AnyValue(float x, float y, float z) : v(x, y, z), count(3) {}
    friend constexpr bool operator==(AnyValue const&, AnyValue const&) = default;
};

/// Colours at ascending positions; at least one.
struct ColorStop {
    float position = 0;
    Color color;
    friend constexpr bool operator==(ColorStop const&, ColorStop const&) = default;
};
struct ColorStops {
    std::vector<ColorStop> stops{{0, Color(0)}, {1, Color(1)}};
    friend bool operator==(ColorStops const&, ColorStops const&) = default;
};

/// The values of inputs that, where nothing is connected, take what the surface has at the point
/// (MaterialX: defaultgeomprop).
struct SurfaceUv {
    friend constexpr bool operator==(SurfaceUv, SurfaceUv) = default;
};
struct SurfacePosition { ///< in the object's space
    friend constexpr bool operator==(SurfacePosition, SurfacePosition) = default;
};
struct SurfaceNormal { ///< unit, world space
    friend constexpr bool operator==(SurfaceNormal, SurfaceNormal) = default;
};

/// Names what an input of T takes from a node: for AnyValue whatever it is.
template <class T>
inline constexpr ValueType input_type = ValueType::vector3;
template <>
inline constexpr ValueType input_type<float> = ValueType::number;
template <>
inline constexpr ValueType input_type<Color> = ValueType::color;
template <>
inline constexpr ValueType input_type<Vec2> = ValueType::vector2;
template <>
inline constexpr ValueType input_type<SurfaceUv> = ValueType::vector2;
template <>
inline constexpr ValueType input_type<AnyValue> = ValueType::inputs;

/// Inputs that have no literal: unconnected, they are the surface's own.
template <class T>
concept SurfaceDefault = std::is_same_v<T, SurfaceUv> || std::is_same_v<T, SurfacePosition> ||
    std::is_same_v<T, SurfaceNormal>;

/// T without contents; zeros for vectors, which leave themselves as they are otherwise.
template <class T>
constexpr T blank() {
    return T{};
}
template <>
constexpr Vec2 blank<Vec2>() {
    return {0, 0};
}
template <>
constexpr Vec3 blank<Vec3>() {
    return {0, 0, 0};
}

/// A parameter that is a constant or, where `texture` is set, what that node gives at the point.
/// In a compiled program `texture` is the index of a register.
template <class T>
struct Input {
    T value = blank<T>();
    Id<TextureKind> texture{};
    friend constexpr bool operator==(Input const&, Input const&) = default;
};

} // namespace weft::schema
