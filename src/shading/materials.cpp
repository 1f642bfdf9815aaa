#include "shading/materials.h"

#include <algorithm>
#include <optional>

#include "shading/lobe_builder.h"

namespace weft::shading {

namespace {

/// The layers of a `layered` material as one struct, so that one program serves all.
struct LayerInputs {
    std::vector<scene::Layer>& layers;
    template <class F>
    void describe(F&& f) {
        for (scene::Layer& layer : layers) layer.describe(f);
    }
};

/// Whether an input may differ from `value`.
template <class T>
bool may_differ(scene::Input<T> const& in, T const& value) {
    return in.texture || in.value != value;
}

/// The materials that `m` is made of, none for most.
std::vector<scene::MaterialId> parts_of(scene::Material const& m,
                                        std::vector<scene::Layer> const& layers) {
    if (auto const* coat = std::get_if<scene::Coat>(&m)) return {coat->bsdf};
    if (auto const* mix = std::get_if<scene::Mix>(&m)) return mix->bsdfs;
    if (auto const* secondary = std::get_if<scene::Secondary>(&m)) return secondary->bsdfs;
    std::vector<scene::MaterialId> parts;
    for (scene::Layer const& layer : layers) parts.push_back(layer.bsdf);
    return parts;
}

/// What the parts are called that have a name of their own, by their order in the material.
std::vector<std::string> labels_of(scene::Material const& m,
                                   std::vector<scene::Layer> const& layers) {
    if (auto const* coat = std::get_if<scene::Coat>(&m)) return {coat->label};
    if (auto const* mix = std::get_if<scene::Mix>(&m)) return {mix->label0, mix->label1};
    std::vector<std::string> labels;
    for (scene::Layer const& layer : layers) labels.push_back(layer.label);
    return labels;
}

std::vector<scene::MaterialId> parts_of(scene::Scene const& scene, scene::MaterialId id) {
    auto const& material = scene.materials[size_t(id.index)];
    std::vector<scene::Layer> layers;
    if (auto const* layered = std::get_if<scene::Layered>(&material))
        for (scene::LayerId layer : layered->layers)
            layers.push_back(scene.layers[size_t(layer.index)]);
    return parts_of(material, layers);
}

/// The index behind the surface, if light goes there.
std::optional<scene::Input<float>> index_inside(scene::Scene const& scene, scene::MaterialId id) {
    auto const& material = scene.materials[size_t(id.index)];
    if (auto const* d = std::get_if<scene::Dielectric>(&material)) return d->ior;
    if (auto const* d = std::get_if<scene::RoughDielectric>(&material)) return d->ior;
    auto const* microfacet = std::get_if<scene::Microfacet>(&material);
    if (microfacet && microfacet->metal == scene::Metal::none &&
        may_differ(microfacet->transmittance, Color(0)))
        return microfacet->ior;
    auto const* disney = std::get_if<scene::Disney>(&material);
    if (disney && may_differ(disney->transmission, 0.f)) return disney->ior;
    for (scene::MaterialId part : parts_of(scene, id))
        if (auto const ior = index_inside(scene, part)) return ior;
    return {};
}

/// The most lobes that the material itself adds.
struct MostLobes {
    int operator()(scene::Disney const& m) const {
        bool const two_surfaces = may_differ(m.transmission_roughness, -1.f);
        int const glass = may_differ(m.transmission, 0.f) ? (two_surfaces ? 2 : 1) : 0;
        return may_differ(m.sheen, 0.f) + may_differ(m.clearcoat, 0.f) +
               may_differ(m.metallic, 0.f) + glass + 2 + may_differ(m.opacity, 1.f);
    }
    int operator()(scene::Principled const&) const { return 2; }
    int operator()(scene::Translucent const&) const { return 2; }
    int operator()(scene::Layered const&) const { return 0; }
    int operator()(scene::Mix const&) const { return 0; }
    int operator()(scene::Secondary const&) const { return 0; }
    template <class M>
    int operator()(M const&) const {
        return 1;
    }
};

struct UsesTangents {
    bool operator()(scene::Disney const& m) const { return may_differ(m.anisotropic, 0.f); }
    bool operator()(scene::Microfacet const& m) const { return may_differ(m.anisotropic, 0.f); }
    bool operator()(scene::Hair const&) const { return true; }
    template <class M>
    bool operator()(M const&) const {
        return false;
    }
};

} // namespace

Frame shading_frame(SurfacePoint const& point, Vec3 const& normal, View const& view) {
    Vec3 n = dot(normal, view.ng) < 0 ? -normal : normal;
    constexpr float least_cosine = 1e-3f;
    if (float const cosine = dot(n, view.wo); cosine < least_cosine)
        n = normalize(n + view.wo * (least_cosine - cosine));
    return point.dpdu == Vec3(0) ? Frame(n) : Frame(n, point.dpdu);
}

template <class F>
void Materials::for_each_part(scene::MaterialId id, F const& f) const {
    CompiledMaterial const& m = (*this)[id];
    for (scene::MaterialId part : parts_of(m.parameters, m.layers)) f(part);
}

void Materials::compile(scene::Scene const& scene, scene::MaterialId id, GraphCompiler& compiler) {
    CompiledMaterial& material = compiled_[size_t(id.index)];
    if (material.done) return;
    SourceLocation const where = location_of(scene, id);
    material.parameters = scene.materials[size_t(id.index)];
    if (auto const* layered = std::get_if<scene::Layered>(&material.parameters)) {
        for (scene::LayerId layer : layered->layers)
            material.layers.push_back(scene.layers[size_t(layer.index)]);
        LayerInputs inputs{material.layers};
        material.program = compiler.compile(inputs, where);
    } else {
        std::visit([&](auto& m) { material.program = compiler.compile(m, where); },
                   material.parameters);
    }
    for (std::string const& label : labels_of(material.parameters, material.layers))
        material.labels.push_back(label_index(label, where));
    material.done = true;
    for (scene::MaterialId part : parts_of(material.parameters, material.layers))
        compile(scene, part, compiler);
    if (int const most = most_lobes(id); most > lobes::Bsdf::capacity)
        throw InputError(where, "expected materials of at most " +
                                    std::to_string(lobes::Bsdf::capacity) + " lobes, found " +
                                    std::to_string(most) + " in the parts of this one");
}

uint16_t Materials::label_index(std::string const& label, SourceLocation const& where) {
    if (label.empty()) return 0;
    size_t const at = size_t(std::find(labels_.begin(), labels_.end(), label) - labels_.begin());
    if (at > UINT16_MAX) throw InputError(where, "expected at most 65535 labels of layers");
    if (at == labels_.size()) labels_.push_back(label);
    return uint16_t(at);
}

int Materials::most_lobes(scene::MaterialId id) const {
    int most = match((*this)[id].parameters, MostLobes{});
    int larger = 0;
    bool const either = std::holds_alternative<scene::Secondary>((*this)[id].parameters);
    for_each_part(id, [&](scene::MaterialId part) {
        most += either ? 0 : most_lobes(part);
        larger = std::max(larger, most_lobes(part));
    });
    return either ? larger : most;
}

Needs Materials::needs(scene::MaterialId id) const {
    Needs needs = (*this)[id].program.needs;
    for_each_part(id, [&](scene::MaterialId part) { needs |= this->needs(part); });
    return needs;
}

bool Materials::uses_tangents(scene::MaterialId id) const {
    bool uses = match((*this)[id].parameters, UsesTangents{});
    for_each_part(id, [&](scene::MaterialId part) { uses |= uses_tangents(part); });
    return uses;
}

void Materials::shade(scene::MaterialId id, SurfacePoint const& point, View const& view,
                      Shading& to) const {
    LobeBuilder{*this, point, view, to, to.bsdf.frame()}.build(id);
    to.bsdf.prepare(view.wo);
    if (view.look.diffuse_only) to.bsdf.keep_diffuse();
}

Color Materials::straight(scene::MaterialId id, SurfacePoint const& point, View const& view) const {
    Shading shading(lobes::Bsdf(shading_frame(point, point.ns, view), view.ng));
    LobeBuilder{*this, point, view, shading, shading.bsdf.frame()}.build(id);
    return shading.bsdf.straight();
}

scene::Input<float> interior_ior(scene::Scene const& scene, scene::MaterialId id) {
    return index_inside(scene, id).value_or(scene::Input<float>{1});
}

bool is_transmissive(scene::Scene const& scene, scene::MaterialId id) {
    return is_null_boundary(scene.materials[size_t(id.index)]) || index_inside(scene, id);
}

bool passes_straight(scene::Scene const& scene, scene::MaterialId id) {
    auto const& material = scene.materials[size_t(id.index)];
    if (auto const* m = std::get_if<scene::Transparent>(&material))
        return may_differ(m->transmittance, Color(0));
    for (scene::MaterialId part : parts_of(scene, id)) {
        auto const* disney = std::get_if<scene::Disney>(&scene.materials[size_t(part.index)]);
        if (passes_straight(scene, part) || (disney && may_differ(disney->opacity, 1.f)))
            return true;
    }
    return false;
}

} // namespace weft::shading
