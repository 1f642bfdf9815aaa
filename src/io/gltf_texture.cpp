#include "io/gltf_texture.h"

#include "io/append.h"

namespace weft::io::gltf {

namespace {

using scene::Input;

} // namespace

void TextureReader::begin(VertexData const& vertices, uint64_t uv_set) {
    vertices_ = vertices;
    uvs_ = {uv_set, {}};
    texcoords_.clear();
    lookups_.clear();
}

int32_t TextureReader::load(size_t index, Lookup const& lookup, bool mip_levels) {
    Object o = file_.element("images", index);
    std::string const uri = o.text("uri");
    auto const view = o.index("bufferView", file_.count("bufferViews"), "bufferViews");
    o.ignore("mimeType"); // the bytes tell it better
    o.finish();
    image::ImageSource from{file_.report().at(o.path()).file};
    File::Resource resource;
    if (view) {
        from.bytes = file_.view_bytes(*view);
    } else if (!uri.empty()) {
        resource = file_.resolve(uri, o.path_of("uri"));
        if (resource.path.empty())
            from.bytes = resource.data;
        else
            from.path = resource.path;
    } else {
        file_.report().fail(o.path(), "expected 'uri' or 'bufferView', found neither");
    }
    auto const loaded = images_.load(from, {lookup.transfer, true}, mip_levels, lookup.channels);
    return index_of(scene_.images, loaded);
}

void TextureReader::read_sampler(Object& texture, Source& to) {
    constexpr uint64_t kNearest = 9728, kLinear = 9729, kFirstMipmap = 9984, kLastMipmap = 9987,
                       kRepeat = 10497, kClamp = 33071, kMirror = 33648;
    auto const index = texture.index("sampler", file_.count("samplers"), "samplers");
    if (!index) return;
    Object o = file_.element("samplers", *index);
    auto wrap = [&](char const* key) {
        uint64_t const mode = o.whole(key).value_or(kRepeat);
        if (mode != kRepeat && mode != kClamp && mode != kMirror)
            o.report().fail(o.path_of(key),
                            "expected 10497, 33071 or 33648, found " + std::to_string(mode));
        return mode == kClamp ? Wrap::clamp : mode == kMirror ? Wrap::mirror : Wrap::repeat;
    };
    to.wrap_u = wrap("wrapS");
    to.wrap_v = wrap("wrapT");
    uint64_t const larger = o.whole("magFilter").value_or(kLinear),
                   smaller = o.whole("minFilter").value_or(kLastMipmap);
    if (larger != kNearest && larger != kLinear)
        o.report().fail(o.path_of("magFilter"),
                        "expected 9728 or 9729, found " + std::to_string(larger));
    bool const mipmap = smaller >= kFirstMipmap && smaller <= kLastMipmap;
    if (!mipmap && smaller != kNearest && smaller != kLinear)
        o.report().fail(o.path_of("minFilter"),
                        "expected 9728, 9729 or 9984 to 9987, found " + std::to_string(smaller));
    to.filter = larger == kNearest ? scene::TextureFilter::nearest
                : mipmap           ? scene::TextureFilter::mipmap
                                   : scene::TextureFilter::bilinear;
    o.finish();
}

TextureReader::Source const& TextureReader::source(size_t texture) {
    auto const [it, fresh] = sources_.try_emplace(texture);
    if (!fresh) return it->second;
    Object o = file_.element("textures", texture);
    read_sampler(o, it->second);
    it->second.image = o.index("source", file_.count("images"), "images");
    o.finish();
    if (!it->second.image)
        file_.report().warn(o.path(), "has no image that can be read and is left out");
    return it->second;
}

TextureReader::Placement TextureReader::placement(Object& info) {
    Placement p;
    p.set = info.whole("texCoord").value_or(0);
    if (auto transform = info.extension("KHR_texture_transform")) {
        p.set = transform->whole("texCoord").value_or(p.set);
        p.rotation = transform->number("rotation", 0);
        auto pair = [&](char const* key, std::array<double, 2>& to) {
            if (auto const v = transform->numbers(key, 2); !v.empty()) to = {v[0], v[1]};
        };
        pair("offset", p.offset);
        pair("scale", p.scale);
        transform->finish();
    }
    if (p.set != uvs_.own && p.set >= vertices_.uv_sets) {
        file_.report().warn(info.path(), "names uvs that its mesh does not have, and is looked up "
                                         "with others");
        p.set = uvs_.own;
    }
    return p;
}

/// The transform is about the point (0, 1) of our uvs and turns them the other way round; `place2d`
/// moves the pattern, not the uvs.
scene::TextureId TextureReader::texcoord(Placement const& p) {
    auto const [it, fresh] = texcoords_.try_emplace(p);
    scene::TextureId& uv = it->second;
    if (!fresh) return uv;
    if (p.set != uvs_.own) {
        uvs_.further.insert(p.set);
        scene::nodes::GeomPropValue property;
        property.geomprop = uv_property(p.set);
        property.output = scene::nodes::AnyType::vector2;
        uv = nodes.add(property);
    }
    Placement const unmoved{.set = p.set};
    if (p == unmoved) return uv;
    auto inverse = [](double x) { return x == 0 ? 0.f : float(1 / x); }; // by 0 both give 0
    scene::nodes::Place2d node;
    node.texcoord.texture = uv;
    node.pivot.value = {0, 1};
    node.scale.value = {inverse(p.scale[0]), inverse(p.scale[1])};
    node.rotate.value = degrees(-float(p.rotation));
    node.offset.value = {-float(p.offset[0]), float(p.offset[1])};
    return uv = nodes.add(node);
}

/// Uvs that an image with clamped borders takes for the wrapping that `image` nodes do not know.
scene::TextureId TextureReader::wrap(Source const& source, scene::TextureId uv) {
    if (source.wrap_u == source.wrap_v && source.wrap_u != Wrap::mirror) return uv;
    scene::TextureId const from = uv ? uv : nodes.add(scene::nodes::Texcoord{});
    auto wrapped = [&](int axis, Wrap mode) {
        Input<float> const x = nodes.extract(from, axis);
        auto modulo = [&](float period) {
            return nodes.binary<scene::nodes::ModuloOp>(x, Input<float>{period});
        };
        if (mode == Wrap::clamp) return x;
        if (mode == Wrap::repeat) return modulo(1);
        Input<float> const centred = nodes.subtract(modulo(2), {1});
        return nodes.subtract({1}, {1, nodes.add(scene::nodes::Absval{{{}, centred.texture}})});
    };
    Input<float> const u = wrapped(0, source.wrap_u), v = wrapped(1, source.wrap_v);
    return nodes.add(scene::nodes::Combine2{u, v});
}

scene::TextureId TextureReader::image(Source const& source, scene::TextureId uv,
                                      Lookup const& lookup) {
    bool const repeats = source.wrap_u == Wrap::repeat && source.wrap_v == Wrap::repeat;
    scene::ImageTexture node;
    node.filename.path = file_.report().at("images[" + std::to_string(*source.image) + "]").file;
    node.filter = source.filter;
    node.filename.resource =
        load(*source.image, lookup, node.filter == scene::TextureFilter::mipmap);
    node.border = repeats ? scene::TextureBorder::repeat : scene::TextureBorder::clamp;
    node.linear = lookup.transfer == image::Transfer::linear;
    node.color_space = scene::ColorSpace::srgb_texture;
    node.texcoord.texture = wrap(source, uv);
    return nodes.add(node);
}

scene::TextureId TextureReader::look_up(Object& owner, char const* key, Lookup const& lookup) {
    auto info = owner.object(key);
    if (!info) return {};
    auto const index = info->index("index", file_.count("textures"), "textures");
    if (!index)
        file_.report().fail(info->path_of("index"),
                            "expected an index into 'textures', found none");
    nodes.where = file_.report().at(info->path());
    for (char const* known : {"scale", "strength"}) info->ignore(known);
    Placement const placed = placement(*info);
    info->finish();
    Source const& from = source(*index);
    if (!from.image) return {};
    scene::TextureId const uv = texcoord(placed);
    auto const [node, fresh] = lookups_.try_emplace({*index, uv.index, lookup});
    if (fresh) node->second = image(from, uv, lookup);
    return node->second;
}

Input<Color> TextureReader::color(Object& owner, char const* key, Color const& factor) {
    scene::TextureId const node =
        look_up(owner, key, {image::Transfer::srgb, image::Channels::color});
    if (!node) return {factor};
    return nodes.multiply(Input<Color>{Color(1), node}, Input<Color>{factor});
}

Input<float> TextureReader::number(Object& owner, char const* key, Channel channel, float factor) {
    bool const alpha = channel == Channel::alpha;
    scene::TextureId const node =
        look_up(owner, key,
                {image::Transfer::linear, alpha ? image::Channels::alpha : image::Channels::color});
    if (!node) return {factor};
    return nodes.multiply(nodes.extract(node, alpha ? 0 : int(channel)), Input<float>{factor});
}

Input<Vec3> TextureReader::normal(Object& owner, char const* key) {
    Input<Vec3> normal{Vec3(0)};
    auto info = owner.object(key);
    if (!info) return normal;
    float const scale = float(info->number("scale", 1));
    scene::TextureId const node = look_up(owner, key, {});
    if (!node) return normal;
    scene::nodes::NormalMap map;
    map.in.texture = node;
    map.scale.value = scale;
    normal.texture = nodes.add(map);
    return normal;
}

} // namespace weft::io::gltf
