#include "shading/lobe_count.h"

#include "shading/lobe_builder.h"

namespace weft::shading {

/// Passed to `describe`: puts a literal in the place of every connected input.
struct LobeCount::ChooseInputs {
    LobeCount& count;

    template <class T>
    void operator()(std::string_view, scene::Input<T>& in, schema::Attr const& attr) const {
        if (!in.texture) return;
        count.has_choice_ = true;
        in = {value(T{}, attr), {}};
    }
    template <class T>
    void operator()(std::string_view, T const&, schema::Attr const&) const {}
    template <class T>
    void group(T& member) const {
        member.describe(*this);
    }

  private:
    float value(float, schema::Attr const& attr) const {
        float const low = std::isfinite(attr.min) ? float(attr.min) : -1;
        float const high = std::isfinite(attr.max)        ? float(attr.max)
                           : std::isfinite(attr.soft_max) ? float(attr.soft_max)
                                                          : low + 2;
        Choice choice = count.choice_;
        if (choice == Choice::any) choice = Choice(count.rng_.next_uint() % 3);
        return choice == Choice::least      ? low
               : choice == Choice::greatest ? high
                                            : lerp(low, high, 0.55f + 0.4f * count.rng_.next());
    }
    Color value(Color const&, schema::Attr const& attr) const {
        float const r = value(0.f, attr), g = value(0.f, attr);
        return {r, g, value(0.f, attr)};
    }
    /// A normal.
    Vec3 value(Vec3 const&, schema::Attr const&) const {
        return normalize(count.rng_.next3() - Vec3(0.5f, 0.5f, -0.1f));
    }
};

CompiledMaterial LobeCount::with_chosen_inputs(CompiledMaterial const& material) {
    CompiledMaterial chosen;
    chosen.parameters = material.parameters;
    chosen.layers = material.layers;
    chosen.labels = material.labels;
    ChooseInputs const choose{*this};
    match(chosen.parameters, [&](auto& m) { m.describe(choose); });
    for (scene::Layer& layer : chosen.layers) layer.describe(choose);
    return chosen;
}

int most_lobes(Materials const& materials, scene::MaterialId id, bool part, bool secondary) {
    using Choice = LobeCount::Choice;
    // What adds lobes mostly asks whether an input is 0, 1 or between, for each by itself: then the
    // first choice has the most. The others find what values between hide.
    constexpr std::array choices{Choice::inside, Choice::greatest, Choice::least, Choice::any,
                                 Choice::any,    Choice::any,      Choice::any,   Choice::any};
    SurfacePoint point;
    point.dpdu = {1, 0, 0};
    point.dpdv = {0, 1, 0};
    Rng rng(1);
    int most = 0;
    for (Choice const choice : choices) {
        bool has_choice = false;
        for (Vec3 const& wo : {Vec3(0, 0, 1), Vec3(0.8f, 0, 0.6f)}) {
            View const view{.wo = wo, .look = {.secondary = secondary}};
            Shading shading(empty_bsdf(point, view));
            LobeCount count(choice, rng);
            LobeBuilder builder{materials, point, view, shading, shading.bsdf.frame()};
            builder.part = part;
            builder.count = &count;
            builder.build(id);
            most = std::max(most, count.lobes());
            has_choice |= count.has_choice();
        }
        if (!has_choice) break;
    }
    return most;
}

} // namespace weft::shading
