// The types that a described parameter may have, beside bool, int, float, std::string, Color,
// Vec2, Vec3, Affined and enumerations with named choices.
#pragma once

#include <cstdint>
#include <string>

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

/// What fills an Input: a texture.
struct TextureKind {
    static constexpr char const* category = "texture";
};

/// A parameter that is a constant or, where `texture` is set, varies over the surface.
template <class T>
struct Input {
    T value{};
    Id<TextureKind> texture{};
    friend constexpr bool operator==(Input const&, Input const&) = default;
};

} // namespace weft::schema
