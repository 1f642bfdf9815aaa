#include "io/gltf_material.h"

#include <algorithm>

#include "scene/scene_vectors.h"

namespace weft::io::gltf {

namespace {

using Input = scene::Input<float>;

float unit_number(Object& o, char const* key, double fallback) {
    return float(o.number(key, fallback, kUnit));
}

/// Warns of a texture that has no counterpart.
void leave_out(Object& o, char const* key, char const* why) {
    if (!o.has(key)) return;
    o.ignore(key);
    o.report().warn(o.path_of(key), why);
}

/// The set of uvs that a texture info names.
uint64_t uv_set(Object info) {
    auto transform = info.extension("KHR_texture_transform");
    uint64_t const set = info.whole("texCoord").value_or(0);
    return transform ? transform->whole("texCoord").value_or(set) : set;
}

/// The set of uvs that best makes the mesh's own: tangents come from those of the normal map.
uint64_t own_uv_set(Object material) {
    if (auto info = material.object("normalTexture")) return uv_set(*info);
    auto pbr = material.object("pbrMetallicRoughness");
    auto info = pbr ? pbr->object("baseColorTexture") : std::nullopt;
    return info ? uv_set(*info) : 0;
}

} // namespace

Surface const& MaterialReader::surface(std::optional<size_t> index, VertexData const& vertices) {
    auto const [it, fresh] = surfaces_.try_emplace({index, vertices});
    if (!fresh) return it->second;
    Json const defaults = Json::object();
    Object o =
        index ? file_.element("materials", *index) : Object(file_.report(), defaults, "materials");
    uint64_t const uvs = own_uv_set(o);
    textures_.begin(vertices, uvs < vertices.uv_sets ? uvs : 0);
    Surface const s = read(o, vertices);
    it->second = s;
    it->second.uvs = textures_.uvs();
    return it->second;
}

Surface MaterialReader::read(Object& material, VertexData const& vertices) {
    Surface s;
    scene::Disney disney;
    textures_.nodes.where = file_.report().at(material.path());
    read_opacity(material, vertices, disney);
    if (material.extension("KHR_materials_unlit")) {
        read_base(material, vertices, disney);
        disney.emission_color = std::exchange(disney.base_color, {Color(0)});
        disney.emission_strength.value = 1;
        disney.specular.value = disney.metallic.value = 0;
        disney.metallic.texture = disney.roughness.texture = {};
        s.is_unlit = true;
        // What else a lit material has does not show on an unlit one.
    } else {
        read_base(material, vertices, disney);
        read_specular(material, disney);
        disney.normal = textures_.normal(material, "normalTexture");
        read_coat_and_sheen(material, disney);
        read_anisotropy(material, disney);
        read_iridescence(material, disney);
        read_transmission(material, disney, s);
        read_emission(material, disney, s);
        leave_out(material, "occlusionTexture",
                  "is left out: the renderer computes occlusion itself");
        material.boolean("doubleSided", false);
        material.finish();
    }
    s.bsdf = scene::add(scene_, scene::MaterialKind{}, disney, file_.report().at(material.path()),
                        Object(material).text("name"));
    return s;
}

scene::TextureId MaterialReader::vertex_property(Object const& material, char const* name,
                                                 scene::nodes::AnyType type) {
    textures_.nodes.where = file_.report().at(material.path());
    scene::nodes::GeomPropValue property;
    property.geomprop = name;
    property.output = type;
    property.fallback = scene::AnyValue(1.f);
    return textures_.nodes.add(property);
}

void MaterialReader::read_base(Object& material, VertexData const& vertices, scene::Disney& to) {
    Json const defaults = Json::object();
    Object pbr = material.object("pbrMetallicRoughness")
                     .value_or(Object(file_.report(), defaults, material.path()));
    auto const factor = pbr.numbers("baseColorFactor", 4);
    Color rgb(1);
    if (!factor.empty()) rgb = Color(float(factor[0]), float(factor[1]), float(factor[2]));
    to.base_color = textures_.color(pbr, "baseColorTexture", rgb);
    if (vertices.color_components > 0)
        to.base_color = textures_.nodes.multiply(
            to.base_color,
            {Color(1), vertex_property(material, "color", scene::nodes::AnyType::color3)});
    to.metallic = textures_.number(pbr, "metallicRoughnessTexture", Channel::blue,
                                   unit_number(pbr, "metallicFactor", 1));
    to.roughness = textures_.number(pbr, "metallicRoughnessTexture", Channel::green,
                                    unit_number(pbr, "roughnessFactor", 1));
    pbr.finish();
}

void MaterialReader::read_opacity(Object& material, VertexData const& vertices, scene::Disney& to) {
    std::string const mode = material.text("alphaMode", "OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
        file_.report().fail(material.path_of("alphaMode"),
                            "expected OPAQUE, MASK or BLEND, found " + in_quotes(mode));
    float const cutoff = float(material.number("alphaCutoff", 0.5, kNotNegative));
    if (mode == "OPAQUE") return;
    if (auto pbr = material.object("pbrMetallicRoughness")) {
        auto const factors = pbr->numbers("baseColorFactor", 4);
        float const factor = factors.empty() ? 1 : std::clamp(float(factors[3]), 0.f, 1.f);
        to.opacity = textures_.number(*pbr, "baseColorTexture", Channel::alpha, factor);
    }
    if (vertices.color_components == 4)
        to.opacity = textures_.nodes.multiply(
            to.opacity,
            {1, vertex_property(material, kAlphaProperty, scene::nodes::AnyType::number)});
    if (mode == "MASK") to.opacity = textures_.nodes.step(to.opacity, cutoff);
}

void MaterialReader::read_emission(Object& material, scene::Disney& to, Surface& surface) {
    Color const factor = material.color("emissiveFactor", Color(0), kUnit);
    float strength = 1;
    if (auto extension = material.extension("KHR_materials_emissive_strength")) {
        strength = float(extension->number("emissiveStrength", 1, kNotNegative));
        extension->finish();
    }
    material.ignore("emissiveTexture");
    if (is_black(factor) || strength == 0) return;
    to.emission_color = textures_.color(material, "emissiveTexture", factor);
    to.emission_strength.value = strength;
    surface.radiance = strength * max_component(factor);
}

void MaterialReader::read_specular(Object& material, scene::Disney& to) {
    if (auto o = material.extension("KHR_materials_ior")) {
        double const ior = o->number("ior", 1.5, kNotNegative);
        to.ior.value = float(std::clamp(ior, 1., 100.));
        if (double(to.ior.value) != double(float(ior)))
            o->report().warn(o->path_of("ior"), "is read as the nearest index from 1 to 100");
        o->finish();
    }
    if (auto o = material.extension("KHR_materials_specular")) {
        to.specular = textures_.number(*o, "specularTexture", Channel::alpha,
                                       0.5f * unit_number(*o, "specularFactor", 1));
        to.specular_tint = textures_.color(*o, "specularColorTexture",
                                           o->color("specularColorFactor", Color(1), kUnit));
        // Metals, whose tint would be that of the silhouette, have none in glTF.
        if (to.specular_tint != scene::Input<Color>{Color(1)})
            to.specular_tint = textures_.nodes.mix(to.specular_tint, {Color(1)}, to.metallic);
        o->finish();
    }
}

void MaterialReader::read_coat_and_sheen(Object& material, scene::Disney& to) {
    if (auto o = material.extension("KHR_materials_clearcoat")) {
        to.clearcoat = textures_.number(*o, "clearcoatTexture", Channel::red,
                                        unit_number(*o, "clearcoatFactor", 0));
        to.clearcoat_roughness = textures_.number(*o, "clearcoatRoughnessTexture", Channel::green,
                                                  unit_number(*o, "clearcoatRoughnessFactor", 0));
        to.clearcoat_normal = textures_.normal(*o, "clearcoatNormalTexture");
        if (to.normal.texture && !to.clearcoat_normal.texture)
            to.clearcoat_normal.texture =
                textures_.nodes.add(scene::nodes::Normal{scene::nodes::Space::world});
        o->finish();
    }
    if (auto o = material.extension("KHR_materials_sheen")) {
        Color const color = o->color("sheenColorFactor", Color(0), kUnit);
        float const strongest = max_component(color);
        Color const tint = strongest > 0 ? color * (1 / strongest) : Color(1);
        to.sheen.value = strongest;
        to.sheen_tint = textures_.color(*o, "sheenColorTexture", tint);
        to.sheen_roughness = textures_.number(*o, "sheenRoughnessTexture", Channel::alpha,
                                              unit_number(*o, "sheenRoughnessFactor", 0));
        o->finish();
    }
}

void MaterialReader::read_anisotropy(Object& material, scene::Disney& to) {
    auto o = material.extension("KHR_materials_anisotropy");
    if (!o) return;
    float const strength = unit_number(*o, "anisotropyStrength", 0);
    double const turns = o->number("anisotropyRotation", 0) / (2 * double(kPi));
    to.anisotropic_rotation.value = float(turns - std::floor(turns));
    Input const s = textures_.number(*o, "anisotropyTexture", Channel::blue, strength);
    if (s.texture)
        o->report().warn(o->path_of("anisotropyTexture"),
                         "its directions are left out: only its strength is read");
    o->finish();
    if (strength == 0) return;
    using namespace scene::nodes;
    Nodes& n = textures_.nodes;
    // A perfectly smooth surface has no ratio.
    Input const b = n.binary<MaxOp>(n.multiply(to.roughness, to.roughness), Input{1e-3f});
    Input const t = n.binary<AddOp>(b, n.multiply(n.subtract({1}, b), n.multiply(s, s)));
    Input const a = n.subtract({1}, n.binary<DivideOp>(b, t));
    to.anisotropic = n.binary<MinOp>(n.multiply(a, {1 / 0.9f}), Input{1});
    to.roughness = n.binary<PowerOp>(n.multiply(t, b), Input{0.25f});
}

void MaterialReader::read_iridescence(Object& material, scene::Disney& to) {
    auto o = material.extension("KHR_materials_iridescence");
    if (!o) return;
    float const factor = unit_number(*o, "iridescenceFactor", 0);
    to.thin_film_ior.value = float(o->number("iridescenceIor", 1.3, {1, 4}));
    float const least = float(o->number("iridescenceThicknessMinimum", 100, kNotNegative)),
                most = float(o->number("iridescenceThicknessMaximum", 400, kNotNegative));
    if (factor > 0) {
        // Without a texture the film is as thick as it gets.
        Input const t = textures_.number(*o, "iridescenceThicknessTexture", Channel::green, 1);
        to.thin_film_thickness = textures_.nodes.lerp(least, most, t);
        if (factor < 1)
            o->report().warn(o->path_of("iridescenceFactor"),
                             "is read as 1: a film is there or not");
        leave_out(*o, "iridescenceTexture", "is left out: a film is everywhere or nowhere");
    }
    for (char const* key : {"iridescenceThicknessTexture", "iridescenceTexture"}) o->ignore(key);
    o->finish();
}

void MaterialReader::read_transmission(Object& material, scene::Disney& to, Surface& surface) {
    if (auto o = material.extension("KHR_materials_transmission")) {
        to.transmission = textures_.number(*o, "transmissionTexture", Channel::red,
                                           unit_number(*o, "transmissionFactor", 0));
        o->finish();
    }
    auto o = material.extension("KHR_materials_volume");
    bool const clear = to.transmission.value == 0;
    double const thickness = o ? o->number("thicknessFactor", 0, kNotNegative) : 0;
    if (thickness == 0) {
        to.thin_walled = !clear;
        to.transmission_roughness = to.roughness;
    }
    if (!o) return;
    o->ignore("thicknessTexture");
    double const distance = o->number("attenuationDistance", 0, kNotNegative);
    Color const color = o->color("attenuationColor", Color(1), kUnit);
    o->finish();
    if (clear || thickness == 0 || !(distance > 0) || color == Color(1)) return;
    // Black would absorb infinitely; this much is as black over any distance that light covers.
    auto absorption = [&](float c) {
        return float(-std::log(std::max(double(c), 1e-6)) / distance);
    };
    surface.medium =
        scene::add(scene_, scene::MediumKind{},
                   scene::HomogeneousMedium{.absorption = {absorption(color.r), absorption(color.g),
                                                           absorption(color.b)}});
}

} // namespace weft::io::gltf
