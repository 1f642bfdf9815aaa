// From the nodes of a scene to programs.
//
// For one struct with Inputs (a material) or one node: walks the network below it depth first,
// folds what depends on no point into literals, gives every other node one instruction and
// one register, and inserts what converts a colour to a number or keeps a calculated value in its
// parameter's range.
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
    /// The uv of points are directions (base/lat_long.h). Images that are looked up there continue
    /// around the seam and end at the poles, whatever their border.
    bool directions = false;
    /// Of the points' positions, in the scene as it was given (World::origin).
    Vec3 origin{0, 0, 0};
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
        return complete(building);
    }
    /// The program for the node `id` alone; `wanted`: number to make one of a colour.
    Program compile(scene::TextureId id, SourceLocation const& where,
                    scene::ValueType wanted = scene::ValueType::inputs);

    /// The vertex properties that programs ask for, by slot: name, and a node that does.
    std::vector<std::pair<std::string, scene::TextureId>> const& attributes() const {
        return attributes_;
    }

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
        void operator()(std::string_view, scene::Input<T>& in, schema::Attr const& attr) const {
            compiler.connect(in, attr);
        }
        template <class T>
        void operator()(std::string_view, T&, schema::Attr const&) const {}
        template <class T>
        void group(T& member) const {
            member.describe(*this);
        }
    };

    Program complete(Building& building) const;
    template <class T>
    void connect(scene::Input<T>& in, schema::Attr const& attr = {});
    /// `value` within the parameter's range. Images and checkerboards are left as they are.
    Operand limit(Operand const& value, scene::TextureId from, schema::Attr const& attr);
    /// Compiles the network of an input into a part of the program, and returns its index.
    template <class T>
    int part(scene::Input<T> const& in);
    Operand operand(scene::TextureId id);
    Operand mean(Operand const& color);
    int32_t emit(Instruction instruction, Needs needs);
    template <class Node>
    Operand translate(Node node, scene::ValueType type);
    Operand translate(scene::ConstantTexture const& node, scene::ValueType type);
    Operand translate(scene::ImageTexture const& node, scene::ValueType type);
    Operand translate(scene::nodes::Convert const& node, scene::ValueType type);
    Operand translate(scene::nodes::GeomPropValue const& node, scene::ValueType type);
    Operand translate(scene::nodes::Position const& node, scene::ValueType type);
    Operand translate(scene::nodes::Bump const& node, scene::ValueType type);
    Operand translate(scene::nodes::Triplanar const& node, scene::ValueType type);
    /// The instruction's result, at once where it needs no point and no register.
    Operand finish(Instruction instruction, Needs needs, bool connected, scene::ValueType type);

    scene::Scene const& scene_;
    CompileOptions options_;
    std::vector<std::pair<std::string, scene::TextureId>> attributes_;
    scene::TextureId current_; ///< the node being translated
    Building* building_ = nullptr;
};

template <class T>
void GraphCompiler::connect(scene::Input<T>& in, schema::Attr const& attr) {
    if (!in.texture) return;
    scene::TextureId const from = in.texture;
    Operand result = operand(from);
    if constexpr (std::is_same_v<T, float>)
        if (result.type == scene::ValueType::color) result = mean(result);
    if constexpr (std::is_same_v<T, float> || std::is_same_v<T, Color>)
        result = limit(result, from, attr);
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
