#include "shading/graph_compiler.h"

#include "scene/node_types.h"
#include "shading/node_functions.h"

namespace weft::shading {

namespace {

ImageFilter image_filter(scene::TextureFilter filter) {
    switch (filter) {
    case scene::TextureFilter::nearest:
        return ImageFilter::nearest;
    case scene::TextureFilter::bilinear:
        break;
    case scene::TextureFilter::mipmap:
        return ImageFilter::mipmap;
    }
    return ImageFilter::bilinear;
}

/// Passed to `describe`: what the unconnected inputs of a node take from the point, and whether
/// any input is connected.
struct InputNeeds {
    Needs& needs;
    bool& connected;

    template <class T>
    void operator()(std::string_view, scene::Input<T> const& in, schema::Attr const&) const {
        connected |= bool(in.texture);
        if (in.texture) return;
        if constexpr (std::is_same_v<T, scene::SurfaceUv>)
            needs |= Needs::uv;
        else if constexpr (schema::SurfaceDefault<T>)
            needs |= Needs::geometry;
    }
    template <class T>
    void operator()(std::string_view, T const&, schema::Attr const&) const {}
    template <class T>
    void group(T& member) const {
        member.describe(*this);
    }
};

} // namespace

Program GraphCompiler::compile(scene::TextureId id, Operand& result, SourceLocation const& where) {
    Building building(*this, where);
    result = operand(id);
    return std::move(building.program);
}

int32_t GraphCompiler::emit(Instruction instruction, Needs needs) {
    auto& instructions = building_->program.instructions;
    if (instructions.size() == size_t(kMaxRegisters))
        throw InputError(building_->where, "expected at most " + std::to_string(kMaxRegisters) +
                                               " nodes in the network below, found more");
    instructions.push_back(std::move(instruction));
    building_->program.needs |= needs;
    return int32_t(instructions.size()) - 1;
}

Operand GraphCompiler::finish(Instruction instruction, Needs needs, bool connected,
                              scene::ValueType type) {
    if (options_.fold && !connected && needs == Needs::nothing) {
        Program const program{{std::move(instruction)}, needs};
        Values values;
        evaluate(program, SurfacePoint(), values);
        return {-1, values[0], type};
    }
    return {emit(std::move(instruction), needs), Vec3(0), type};
}

Operand GraphCompiler::mean(Operand const& color) {
    if (color.reg < 0) return {-1, Vec3(average(to_color(color.value))), scene::ValueType::number};
    auto const [it, fresh] = building_->mean.emplace(color.reg, -1);
    if (fresh) it->second = emit(MeanOp{{Color(0), {color.reg}}}, Needs::nothing);
    return {it->second, Vec3(0), scene::ValueType::number};
}

Operand GraphCompiler::operand(scene::TextureId id) {
    auto& done = building_->done;
    if (auto const it = done.find(id.index); it != done.end()) return it->second;
    scene::Texture const& texture = scene_.textures[size_t(id.index)];
    auto const type_of = [&](scene::TextureId input) { return operand(input).type; };
    Operand const result = std::visit(
        [&](auto const& node) { return translate(node, scene::output_type(node, type_of)); },
        texture);
    done[id.index] = result;
    return result;
}

template <class Node>
Operand GraphCompiler::translate(Node node, scene::ValueType type) {
    node.describe(Connector{*this});
    Needs needs = Needs::nothing;
    bool connected = false;
    node.describe(InputNeeds{needs, connected});
    return finish(std::move(node), needs, connected, type);
}

Operand GraphCompiler::translate(scene::ConstantTexture const& node, scene::ValueType type) {
    return finish(node, Needs::nothing, false, type);
}

Operand GraphCompiler::translate(scene::ImageTexture const& node, scene::ValueType type) {
    ImageOp op;
    op.texcoord = node.texcoord;
    connect(op.texcoord);
    op.lookup = {scene_.images[size_t(node.filename.resource)], node.exposure,
                 node.border == scene::TextureBorder::clamp, image_filter(node.filter)};
    bool const connected = bool(op.texcoord.texture);
    return finish(op, connected ? Needs::nothing : Needs::uv, connected, type);
}

} // namespace weft::shading
