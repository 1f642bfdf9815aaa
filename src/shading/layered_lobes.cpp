// Materials made of materials.
#include "shading/lobe_builder.h"

namespace weft::shading {

void LobeBuilder::build(scene::MaterialId id) const {
    CompiledMaterial const& material = materials[id];
    if (count) {
        CompiledMaterial const chosen = count->with_chosen_inputs(material);
        return build(chosen, Values());
    }
    Values values;
    evaluate(material.program, point, values);
    build(material, values);
}

void LobeBuilder::build(CompiledMaterial const& material, Values const& values) const {
    to.bsdf.use_frame(frame);
    LobeBuilder inner = *this;
    inner.layers = &material.layers;
    inner.labels = &material.labels;
    match(material.parameters, [&](auto const& m) {
        if (part) inner.add_presence(m, values);
        inner(m, values);
    });
}

template <class M>
void LobeBuilder::add_presence(M const& m, Values const& at) {
    using Traits = scene::MaterialTraits<M>;
    float const opacity = unit(at(Traits::opacity(m)));
    if (opacity < 1) add(Color(1 - opacity), lobes::Transparent{});
    weight *= opacity;
    if (auto const emission = Traits::emission(m); emission && view.entering)
        to.emission += weight * at(emission->color) * at(emission->strength);
}

void LobeBuilder::build_part(scene::MaterialId id, Color const& w, Frame const& f,
                             uint16_t l) const {
    if (is_black(w)) return;
    if (count) return count->add_part(materials[id], view.look.secondary);
    LobeBuilder inner = *this;
    inner.weight *= w;
    inner.frame = f;
    inner.part = true;
    inner.label = l;
    inner.build(id);
}

void LobeBuilder::operator()(scene::Layered const& m, Values const& at) const {
    float uncovered = 1;
    for (scene::Layer const& layer : *layers) {
        bool const last = &layer == &layers->back();
        if (!last && m.secondary == scene::SecondaryRays::base && view.look.secondary) continue;
        float const opacity = unit(at(layer.opacity));
        build_part(layer.bsdf, Color(uncovered * opacity), frame_around(at(layer.normal)),
                   label_of(size_t(&layer - layers->data())));
        uncovered *= 1 - opacity;
    }
}

void LobeBuilder::operator()(scene::Coat const& m, Values const& at) const {
    float const w = unit(at(m.weight));
    if (w == 0 || (m.secondary == scene::SecondaryRays::base && view.look.secondary)) {
        build_part(m.bsdf, Color(1), frame, label);
        return;
    }
    Frame const around = frame_around(at(m.normal));
    to.bsdf.use_frame(around);
    float const ior = at(m.ior), alpha = this->alpha(at(m.roughness));
    lobes::GgxReflection const lobe{
        {alpha, alpha, lobes::Shadowing::Correlated}, lobes::DielectricFresnel{ior}, true};
    LobeBuilder coat = *this;
    coat.label = label_of(0);
    Color const reflected = coat.add_layer(Color(w), lobe, around);
    Color const through =
        layer_transmittance(unit(at(m.tint)), at(m.thickness), ior, dot(around.n, view.wo));
    build_part(m.bsdf, rest_of(w * reflected) * lerp(Color(1), through, w), frame, label);
}

void LobeBuilder::operator()(scene::Mix const& m, Values const& at) const {
    bool const first_alone = m.secondary == scene::SecondaryRays::base && view.look.secondary;
    float const amount = first_alone ? 0 : unit(at(m.amount));
    build_part(m.bsdfs[0], Color(1 - amount), frame, label_of(0));
    build_part(m.bsdfs[1], Color(amount), frame, label_of(1));
}

void LobeBuilder::operator()(scene::Secondary const& m, Values const&) const {
    build_part(m.bsdfs[view.look.secondary ? 1 : 0], Color(1), frame, label);
}

} // namespace weft::shading
