#include "shading/materials.h"

#include <algorithm>

#include "scene/material_facts.h"
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

/// For messages: <bsdf type="layered" id="paint">.
std::string title_of(scene::Scene const& scene, scene::MaterialId id) {
    auto const& material = scene.materials[size_t(id.index)];
    std::string title = "<bsdf type=\"";
    title += match(material, [](auto const& m) { return m.info.type; });
    if (std::string_view const name = name_of(scene, id); !name.empty())
        title += "\" id=\"" + std::string(name);
    return title + "\">";
}

} // namespace

namespace {

/// Returns `n`, turned towards unit `wo` until that is just visible.
Vec3 visible_normal(Vec3 const& n, Vec3 const& wo) {
    constexpr float least_cosine = 1e-3f;
    float const cosine = dot(n, wo);
    return cosine < least_cosine ? normalize(n + wo * (least_cosine - cosine)) : n;
}

/// Returns `n`, turned towards `ng` until it mirrors `wo` to a hundredth above the surface, or to
/// nine tenths of wo's own height where that is less. Cycles has the same rule. All are unit, and
/// `n` and `wo` are on ng's side.
Vec3 mirroring_normal(Vec3 const& n, Vec3 const& wo, Vec3 const& ng) {
    float const height = dot(wo, ng);
    float const least = std::min(0.9f * height, 0.01f);
    if (2 * dot(n, wo) * dot(n, ng) - height >= least) return n;
    Vec3 const slope = n - ng * dot(n, ng);
    if (!(length_squared(slope) > 0)) return n;
    // In the plane of ng and n, the normal (sqrt(1 - s), sqrt(s)) mirrors (along, height) to the
    // height 2 (along sqrt(s (1 - s)) + height s) - height. That is `least` for a root of
    // 4 a s^2 - 2 b s + c = 0: the greater one where n leans away from wo.
    Vec3 const tangent = normalize(slope);
    float const along = dot(wo, tangent), goal = least + height;
    float const a = along * along + height * height, b = 2 * (a + height * least);
    float const root = safe_sqrt(b * b - 4 * a * goal * goal);
    float const s = std::min((along < 0 ? b + root : b - root) / (4 * a), 1.f);
    return tangent * safe_sqrt(1 - s) + ng * std::sqrt(s);
}

} // namespace

Vec3 surface_normal(SurfacePoint const& point, lobes::BentNormals bent) {
    bool const smooth = point.lift != Vec3(0) && bent == lobes::BentNormals::Softened;
    Vec3 const& n = smooth ? point.smooth_normal : point.ng;
    return dot(point.ng, point.wo) > 0 ? n : -n;
}

Frame shading_frame(SurfacePoint const& point, Vec3 const& normal, View const& view) {
    Vec3 n = dot(normal, view.ng) < 0 ? -normal : normal;
    switch (view.bent) {
    case lobes::BentNormals::Dropped: // of two sides, wo is on the front
        n = visible_normal(dot(n, view.wo) < 0 ? -n : n, view.wo);
        break;
    case lobes::BentNormals::Softened:
        n = mirroring_normal(n, view.wo, view.ng);
        break;
    case lobes::BentNormals::Folded:
        n = visible_normal(n, view.wo);
        break;
    }
    return point.dpdu == Vec3(0) ? Frame(n) : Frame(n, point.dpdu);
}

void Materials::compile(scene::Scene const& scene, scene::MaterialId id, GraphCompiler& compiler) {
    compile_with_parts(scene, id, compiler);
    CompiledMaterial& material = compiled_[size_t(id.index)];
    if (material.fits) return;
    int const most =
        std::max(most_lobes(*this, id, false, false), most_lobes(*this, id, false, true));
    if (most > lobes::Bsdf::capacity)
        throw InputError(location_of(scene, id), "expected a material of at most " +
                                                     std::to_string(lobes::Bsdf::capacity) +
                                                     " lobes, found " + title_of(scene, id) +
                                                     " of up to " + std::to_string(most));
    material.fits = true;
}

void Materials::compile_with_parts(scene::Scene const& scene, scene::MaterialId id,
                                   GraphCompiler& compiler) {
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
        match(material.parameters, [&](auto& m) { material.program = compiler.compile(m, where); });
    }
    auto const labels =
        scene::with_traits(scene.materials[size_t(id.index)],
                           [&]<class T>(auto const& m) { return T::labels(m, scene.layers); });
    for (std::string const& label : labels) material.labels.push_back(label_index(label, where));
    material.parts = scene::parts_of(scene, id);
    material.done = true;
    for (scene::MaterialId part : material.parts) {
        compile_with_parts(scene, part, compiler);
        if (CompiledMaterial& m = compiled_[size_t(part.index)]; m.most_lobes[0] < 0)
            m.most_lobes = {most_lobes(*this, part, true, false),
                            most_lobes(*this, part, true, true)};
    }
}

uint16_t Materials::label_index(std::string const& label, SourceLocation const& where) {
    if (label.empty()) return 0;
    size_t const at = size_t(std::find(labels_.begin(), labels_.end(), label) - labels_.begin());
    if (at > UINT16_MAX) throw InputError(where, "expected at most 65535 labels of layers");
    if (at == labels_.size()) labels_.push_back(label);
    return uint16_t(at);
}

Needs Materials::needs(scene::MaterialId id) const {
    Needs needs = (*this)[id].program.needs;
    for (scene::MaterialId part : (*this)[id].parts) needs |= this->needs(part);
    return needs;
}

bool Materials::uses_tangents(scene::MaterialId id) const {
    bool uses = scene::needs_tangents((*this)[id].parameters);
    for (scene::MaterialId part : (*this)[id].parts) uses |= uses_tangents(part);
    return uses;
}

void Materials::shade(scene::MaterialId id, SurfacePoint const& point, View const& view,
                      Shading& to) const {
    LobeBuilder{*this, point, view, to, to.bsdf.frame()}.build(id);
    to.bsdf.prepare(view.wo);
    if (view.look.diffuse_only) to.bsdf.keep_diffuse();
}

Color Materials::straight(scene::MaterialId id, SurfacePoint const& point, View const& view) const {
    Shading shading(empty_bsdf(point, view));
    LobeBuilder{*this, point, view, shading, shading.bsdf.frame()}.build(id);
    return shading.bsdf.straight();
}

} // namespace weft::shading
