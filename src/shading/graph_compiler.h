// From the nodes of a scene to programs.
//
// For one struct with Inputs (a material) or one node: walks the network below it depth first,
// folds what depends on no point into literals, gives every other node one instruction and
// one register, and inserts what converts a colour to a number.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "base/error.h"
#include "scene/scene.h"
#include "shading/graph.h"

namespace weft::shading {

struct CompileOptions {
    bool fold = true; ///< off, for tests: literals take registers, too
};

/// The result of a node: a register of its program or, where `reg` is -1, a literal.
struct Operand {
    int32_t reg = -1;
    Vec3 value{0, 0, 0};
    scene::ValueType type = scene::ValueType::number;
};

class GraphCompiler {
  public:
    explicit GraphCompiler(scene::Scene const& scene, CompileOptions const& options = {})
        : scene_(scene), options_(options) {}

    /// The program for the inputs of `described`, which then refer to its registers. Throws
    /// InputError at `where` for a network that is too large.
    template <class T>
    Program compile(T& described, SourceLocation const& where) {
        Building building(*this, where);
        described.describe(Connector{*this});
        return std::move(building.program);
    }
    /// The program for the node `id` alone, and where its result is.
    Program compile(scene::TextureId id, Operand& result, SourceLocation const& where);

  private:
    /// The program in the making: the innermost `Building`.
    struct Building {
        Building(GraphCompiler& c, SourceLocation const& at)
            : compiler(c), outer(c.building_), where(at) {
            c.building_ = this;
        }
        ~Building() { compiler.building_ = outer; }
        Building(Building const&) = delete;
        Building& operator=(Building const&) = delete;

        GraphCompiler& compiler;
        Building* outer;
        SourceLocation const& where;
        Program program;
        std::map<int32_t, Operand> done; ///< by node
        std::map<int32_t, int32_t> mean; ///< register of a colour -> register of its mean
    };

    /// Passed to `describe`: connects every input.
    struct Connector {
        GraphCompiler& compiler;
        template <class T>
        void operator()(std::string_view, scene::Input<T>& in, schema::Attr const&) const {
            compiler.connect(in);
        }
        template <class T>
        void operator()(std::string_view, T&, schema::Attr const&) const {}
        template <class T>
        void group(T& member) const {
            member.describe(*this);
        }
    };

    template <class T>
    void connect(scene::Input<T>& in);
    Operand operand(scene::TextureId id);
    Operand mean(Operand const& color);
    int32_t emit(Instruction instruction, Needs needs);
    template <class Node>
    Operand translate(Node node, scene::ValueType type);
    Operand translate(scene::ConstantTexture const& node, scene::ValueType type);
    Operand translate(scene::ImageTexture const& node, scene::ValueType type);
    /// The instruction's result, at once where it needs no point and no register.
    Operand finish(Instruction instruction, Needs needs, bool connected, scene::ValueType type);

    scene::Scene const& scene_;
    CompileOptions options_;
    Building* building_ = nullptr;
};

template <class T>
void GraphCompiler::connect(scene::Input<T>& in) {
    if (!in.texture) return;
    Operand result = operand(in.texture);
    if constexpr (std::is_same_v<T, float>)
        if (result.type == scene::ValueType::color) result = mean(result);
    if constexpr (schema::SurfaceDefault<T>) {
        // Their literals have no place but a register.
        if (result.reg < 0) {
            scene::ConstantTexture literal;
            literal.value = {result.value.x, result.value.y, result.value.z};
            result.reg = emit(literal, Needs::nothing);
        }
    } else if (result.reg < 0) {
        in.texture = {};
        Vec3 const& v = result.value;
        if constexpr (std::is_same_v<T, float>)
            in.value = v.x;
        else if constexpr (std::is_same_v<T, Color>)
            in.value = {v.x, v.y, v.z};
        else if constexpr (std::is_same_v<T, Vec2>)
            in.value = {v.x, v.y};
        else if constexpr (std::is_same_v<T, Vec3>)
            in.value = v;
        else
            in.value.v = v;
        return;
    }
    in.texture.index = result.reg;
}

} // namespace weft::shading
