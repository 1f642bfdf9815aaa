#include "shading/graph_compiler.h"

#include "scene/node_types.h"
#include "shading/node_functions.h"

namespace weft::shading {

namespace {

/// Passed to `describe`: collects what unconnected inputs take from the point, and whether any
/// input is connected.
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

template <class Node, class... Others>
constexpr bool is_one_of = (std::is_same_v<Node, Others> || ...);

/// Returns what the node needs to know of a point, its inputs aside.
template <class Node>
constexpr Needs own_needs(Node const&) {
    using namespace scene::nodes;
    if constexpr (is_one_of<Node, Texcoord>) return Needs::uv;
    if constexpr (is_one_of<Node, FacingRatio>) return Needs::view;
    if constexpr (is_one_of<Node, scene::nodes::Normal, Tangent, InstanceRandom, NormalMap>)
        return Needs::geometry;
    return Needs::nothing;
}

} // namespace

Program GraphCompiler::compile(scene::TextureId id, SourceLocation const& where,
                               scene::ValueType wanted) {
    Building building(*this, where);
    Operand result = operand(id);
    bool const to_number =
        wanted == scene::ValueType::number && result.type == scene::ValueType::color;
    building.program.result = to_number ? mean(result) : result;
    return complete(building);
}

Program GraphCompiler::complete(Building& building) const {
    Program& program = building.program;
    program.cost += int(program.instructions.size());
    if (program.cost > kMaxCost)
        throw InputError(building.where,
                         "expected a network that runs at most " + std::to_string(kMaxCost) +
                             " nodes for one point, found " + std::to_string(program.cost) +
                             " by bumps and projections inside of each other");
    return std::move(program);
}

template <class T>
int GraphCompiler::part(scene::Input<T> const& in) {
    Program part;
    if (in.texture) {
        part = compile(in.texture, building_->where, schema::input_type<T>);
    } else if constexpr (std::is_same_v<T, float>) {
        part.result.value = Vec3(in.value);
    } else {
        part.result.value = in.value.v;
    }
    building_->program.needs |= part.needs;
    auto& parts = building_->program.parts;
    parts.push_back(std::move(part));
    return int(parts.size()) - 1;
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

Operand GraphCompiler::limit(Operand const& value, scene::TextureId from,
                             schema::Attr const& attr) {
    scene::Texture const& node = scene_.textures[size_t(from.index)];
    bool const unlimited = !std::isfinite(attr.min) && !std::isfinite(attr.max);
    if (unlimited || std::holds_alternative<scene::ImageTexture>(node) ||
        std::holds_alternative<scene::Checkerboard>(node))
        return value;
    LimitOp op{{value.value}, float(attr.min), float(attr.max)};
    if (value.reg >= 0) op.in.texture.index = value.reg;
    return finish(op, Needs::nothing, value.reg >= 0, value.type);
}

Operand GraphCompiler::operand(scene::TextureId id) {
    auto& done = building_->done;
    if (auto const it = done.find(id.index); it != done.end()) return it->second;
    scene::Texture const& texture = scene_.textures[size_t(id.index)];
    auto const type_of = [&](scene::TextureId input) { return operand(input).type; };
    Operand const result = std::visit(
        [&](auto const& node) {
            scene::ValueType const type = scene::output_type(node, type_of);
            current_ = id;
            return translate(node, type);
        },
        texture);
    done[id.index] = result;
    return result;
}

template <class Node>
Operand GraphCompiler::translate(Node node, scene::ValueType type) {
    node.describe(Connector{*this});
    Needs needs = own_needs(node);
    bool connected = false;
    node.describe(InputNeeds{needs, connected});
    return finish(std::move(node), needs, connected, type);
}

Operand GraphCompiler::translate(scene::ConstantTexture const& node, scene::ValueType type) {
    return finish(node, Needs::nothing, false, type);
}

Operand GraphCompiler::translate(scene::ImageTexture const& node, scene::ValueType type) {
    scene::Input<scene::SurfaceUv> texcoord = node.texcoord;
    connect(texcoord);
    bool const connected = bool(texcoord.texture);
    Needs const needs = connected ? Needs::nothing : Needs::uv;
    bool const udim = node.filename.path.find(scene::kUdim) != std::string::npos;
    bool const around = options_.directions && !connected;
    auto lookup = [&](int32_t image) {
        // Tiles end at their borders: beside them is another.
        bool const clamp = udim || node.border == scene::TextureBorder::clamp;
        return ImageLookup{scene_.images[size_t(image)], node.exposure, clamp && !around,
                           clamp || around, node.filter};
    };
    if (!udim)
        return finish(ImageOp{texcoord, lookup(node.filename.resource)}, needs, connected, type);
    UdimOp op{texcoord, std::vector<int16_t>(100), {}};
    for (scene::UdimTile const& tile : scene_.udims[size_t(node.filename.resource)]) {
        op.lookups.push_back(lookup(tile.image));
        op.tile[size_t(tile.number - 1001)] = int16_t(op.lookups.size());
    }
    return finish(std::move(op), needs, connected, type);
}

/// Most conversions are none: all registers hold three numbers.
Operand GraphCompiler::translate(scene::nodes::Convert const& node, scene::ValueType type) {
    using scene::ValueType;
    Operand in{-1, node.in.value.v, scene::literal_type(node.in.value)};
    if (node.in.texture) in = operand(node.in.texture);
    bool const is_color = in.type == ValueType::color || in.type == ValueType::triple;
    if (type == ValueType::number && is_color) return mean(in);
    bool const grows = in.type == ValueType::vector2 && type != ValueType::vector2;
    if (grows && in.reg >= 0)
        return {emit(FlattenOp{{Vec3(0), {in.reg}}}, Needs::nothing), Vec3(0), type};
    in.type = type;
    return in;
}

Operand GraphCompiler::translate(scene::nodes::GeomPropValue const& node, scene::ValueType type) {
    VertexOp op;
    while (size_t(op.slot) < attributes_.size() &&
           attributes_[size_t(op.slot)].first != node.geomprop)
        ++op.slot;
    if (size_t(op.slot) == attributes_.size()) attributes_.emplace_back(node.geomprop, current_);
    op.transfer = scene::transfer_of(node.color_space);
    op.is_number = type == scene::ValueType::number;
    // Another type of fallback would need conversions: a literal is what it is for.
    op.fallback = node.fallback.v;
    return {emit(op, Needs::geometry), Vec3(0), type};
}

Operand GraphCompiler::translate(scene::nodes::Position const& node, scene::ValueType type) {
    return {emit(PositionOp{node.space, options_.origin}, Needs::geometry), Vec3(0), type};
}

Operand GraphCompiler::translate(scene::nodes::Bump const& node, scene::ValueType type) {
    BumpOp op{0, node.scale, node.normal, node.step};
    connect(op.scale);
    connect(op.normal);
    connect(op.step);
    op.part = part(node.height);
    building_->program.cost += 4 * building_->program.parts[size_t(op.part)].cost;
    return {emit(op, Needs::geometry), Vec3(0), type};
}

Operand GraphCompiler::translate(scene::nodes::Triplanar const& node, scene::ValueType type) {
    TriplanarOp op{0, node.scale, node.blend, {node.space, options_.origin}};
    connect(op.scale);
    connect(op.blend);
    op.part = part(node.in);
    building_->program.cost += 3 * building_->program.parts[size_t(op.part)].cost;
    return {emit(op, Needs::geometry), Vec3(0), type};
}

} // namespace weft::shading
