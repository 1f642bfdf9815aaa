// Compiled node networks: flat programs that a point runs.
//
// An instruction is the node's own struct, in which the index of a connected node has become the
// index of the register that holds its result (GraphCompiler does that through `describe`, so no
// code knows the nodes' parameters but the node's function itself). Registers hold three floats:
// a number stands in all three, a vector2 leaves z at 0 or undefined. Instructions run in
// topological order, each once per point, whatever number of inputs it feeds. What needs no point
// was folded away. A program runs on the stack, without allocation or virtual calls.
#pragma once

#include <array>
#include <tuple>
#include <variant>
#include <vector>

#include "base/match.h"
#include "scene/texture.h"
#include "shading/image_lookup.h"
#include "shading/surface_point.h"

namespace weft::shading {

/// Instructions of one program, and so the registers it needs. 128 nodes are 1.5 KB of stack.
inline constexpr int kMaxRegisters = 128;
/// Instructions run for one point, where bumps of bumps multiply.
inline constexpr int kMaxCost = 10000;

/// What a program needs to know of a SurfacePoint, as a set of bits.
enum class Needs : uint8_t {
    nothing = 0,
    uv = 1,
    geometry = 2, ///< anything else that is the surface's: position, normal, tangents, attributes
    view = 4,     ///< wo
};
constexpr Needs operator|(Needs a, Needs b) { return Needs(uint8_t(a) | uint8_t(b)); }
constexpr Needs& operator|=(Needs& a, Needs b) { return a = a | b; }
/// Returns whether `b` has all the bits of `a`.
constexpr bool within(Needs a, Needs b) { return (uint8_t(a) & ~uint8_t(b)) == 0; }

/// An image, all of whose parameters are its lookup's.
struct ImageOp {
    scene::Input<scene::SurfaceUv> texcoord;
    ImageLookup lookup;
};

/// Images side by side over uv; black where there is none.
struct UdimOp {
    scene::Input<scene::SurfaceUv> texcoord;
    std::vector<int16_t> tile; ///< 100, by u + 10 v: 1 + index into `lookups`; 0: none
    std::vector<ImageLookup> lookups;
};

/// A property of the mesh's vertices.
struct VertexOp {
    int slot = 0; ///< in VertexAttributes::columns
    Vec3 fallback{0, 0, 0};
    image::Transfer transfer = image::Transfer::linear;
    bool is_number = false;

    template <class F>
    constexpr void describe(F&&) {}
};

/// The normal of a surface raised by the program `part`.
struct BumpOp {
    int part = 0;
    scene::Input<float> scale;
    scene::Input<scene::SurfaceNormal> normal;
    scene::Input<float> step;
};

/// The position of the point.
struct PositionOp {
    scene::nodes::Space space{};
    Vec3 origin{0, 0, 0}; ///< of the points' positions, in the scene as it was given

    template <class F>
    constexpr void describe(F&&) {}
};

/// The program `part` seen along the three axes.
struct TriplanarOp {
    int part = 0;
    scene::Input<float> scale, blend;
    PositionOp position;
};

/// z as 0: a vector2 that becomes a vector3.
struct FlattenOp {
    scene::Input<Vec3> in;
};

/// A value kept to the range that its parameter allows.
struct LimitOp {
    scene::Input<Vec3> in;
    float min = 0, max = 1;
};

/// A colour as the number that is its channels' mean.
struct MeanOp {
    scene::Input<Color> in;
};

namespace detail {

/// The instruction that a node becomes: itself, where nothing is said here.
template <class Node>
struct InstructionOf {
    using type = Node;
};
template <>
struct InstructionOf<scene::ImageTexture> {
    using type = ImageOp;
};

template <>
struct InstructionOf<scene::nodes::GeomPropValue> {
    using type = VertexOp;
};
template <>
struct InstructionOf<scene::nodes::Position> {
    using type = PositionOp;
};
template <>
struct InstructionOf<scene::nodes::Bump> {
    using type = BumpOp;
};
template <>
struct InstructionOf<scene::nodes::Triplanar> {
    using type = TriplanarOp;
};
template <>
struct InstructionOf<scene::nodes::Convert> {
    using type = FlattenOp;
};

template <class Variant>
struct Instructions;
template <class... Node>
struct Instructions<std::variant<Node...>> {
    using type = std::variant<typename InstructionOf<Node>::type..., UdimOp, MeanOp, LimitOp>;
};

} // namespace detail

using Instruction = detail::Instructions<scene::Texture>::type;
static_assert(sizeof(Instruction) <= 136); // what is large and rare belongs behind a pointer

/// The result of a node: a register of its program or, where `reg` is -1, a literal.
struct Operand {
    int32_t reg = -1;
    Vec3 value{0, 0, 0};
    scene::ValueType type = scene::ValueType::number;
};

struct Program {
    std::vector<Instruction> instructions; ///< each writes the register of its own index
    Needs needs = Needs::nothing;
    Operand result;             ///< of a program for a single node
    std::vector<Program> parts; ///< networks that bump and triplanar run at other points
    int cost = 0;               ///< instructions run for one point, those of parts included
};

/// The results of a program: what the inputs of the struct it was compiled for read.
class Values {
  public:
    float operator()(scene::Input<float> const& in) const {
        return in.texture ? of(in.texture).x : in.value;
    }
    Color operator()(scene::Input<Color> const& in) const {
        return in.texture ? color(of(in.texture)) : in.value;
    }
    Vec2 operator()(scene::Input<Vec2> const& in) const {
        return in.texture ? Vec2(of(in.texture).x, of(in.texture).y) : in.value;
    }
    Vec3 operator()(scene::Input<Vec3> const& in) const {
        return in.texture ? of(in.texture) : in.value;
    }
    Vec3 operator()(scene::Input<scene::AnyValue> const& in) const {
        return in.texture ? of(in.texture) : in.value.v;
    }
    Vec3& operator[](size_t index) { return registers_[index]; }

  private:
    static Color color(Vec3 const& v) { return {v.x, v.y, v.z}; }
    Vec3 const& of(scene::TextureId id) const { return registers_[size_t(id.index)]; }

    std::array<Vec3, kMaxRegisters> registers_; // not initialised: every one is written first
};

/// Returns (width, height) of the largest image that a program looks up. Patterns count as at least
/// 512 x 256, which resolves most of them; a constant is (1, 1).
Vec2i resolution(Program const& program);

/// Runs the program at `point`.
void evaluate(Program const& program, SurfacePoint const& point, Values& values);

/// The result of a program for a single node.
Vec3 evaluate(Program const& program, SurfacePoint const& point);

} // namespace weft::shading
