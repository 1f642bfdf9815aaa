#include "session/plan.h"

#include <fmt/format.h>

#include "schema/text.h"
#include "session/scene_tags.h"

namespace weft::session {

namespace {

/// Where a render without a number of samples of its own ends at the latest.
constexpr uint32_t kMostSamples = 1 << 16;

film::Region region_of(world::World const& world, PictureOptions const& options) {
    Vec2i const size = world.camera().size();
    if (!options.crop) return {{0, 0}, size};
    film::Region const& c = *options.crop;
    bool const inside = c.from.x >= 0 && c.from.y >= 0 && c.to.x <= size.x && c.to.y <= size.y;
    if (!inside || c.width() <= 0 || c.height() <= 0)
        throw InputError(fmt::format("--crop expects a region inside of the picture of {} x {} "
                                     "pixels, found {},{},{},{}",
                                     size.x, size.y, c.from.x, c.from.y, c.to.x, c.to.y));
    return c;
}

film::Layout make_layout(film::SceneTags const& tags, scene::RenderJob const& job,
                         RenderOptions const& options) {
    auto const from_scene = wanted_aovs(job.integrator);
    std::vector<film::Aov> aovs(from_scene.begin(), from_scene.end());
    aovs.insert(aovs.end(), options.picture.aovs.begin(), options.picture.aovs.end());
    film::LayoutOptions o;
    o.half_sums = options.picture.half_sums || options.limits.noise > 0;
    o.light_groups = tags.light_groups;
    o.layers = tags.layers;
    if (scene::Outputs const* const outputs = scene::outputs_of(job.integrator))
        o.cryptomatte_levels = outputs->cryptomatte_levels;
    else if (!aovs.empty())
        throw InputError(
            job.where,
            fmt::format("expected an integrator that follows light for AOVs, found <integrator "
                        "type=\"{}\">",
                        match(job.integrator, [](auto const& i) { return i.info.type; })));
    return film::Layout(aovs, std::move(o));
}

template <class Settings>
std::string settings_text(Settings const& settings) {
    return match(settings, [](auto const& s) {
        return std::string(s.info.type) + schema::write_attributes(s);
    });
}

std::string channels_text(film::Layout const& layout) {
    std::string text;
    for (std::string const& name : layout.channel_names()) text += (text.empty() ? "" : " ") + name;
    return text;
}

/// Says for how many samples per pixel footprints are made, where those are others than the
/// picture's.
std::string footprint_text(Plan const& plan) {
    return uint32_t(plan.footprint_samples) == plan.samples
               ? "as samples per pixel"
               : fmt::format("as of {} samples", plan.footprint_samples);
}

} // namespace

int sample_count(scene::Sampler const& sampler) {
    return match(sampler, [](auto const& s) { return s.count; });
}

std::span<film::Aov const> wanted_aovs(scene::Integrator const& integrator) {
    scene::Outputs const* const outputs = scene::outputs_of(integrator);
    return outputs ? std::span<film::Aov const>(outputs->aovs) : std::span<film::Aov const>();
}

uint32_t sample_limit(scene::RenderJob const& job, Limits const& limits) {
    if (limits.spp > 0) return uint32_t(limits.spp);
    return limits.noise > 0 || limits.seconds > 0 ? kMostSamples
                                                  : uint32_t(sample_count(job.sampler));
}

Plan make_plan(lights::Stage const& stage, scene::RenderJob const& job,
               RenderOptions const& options) {
    film::Region const region = region_of(stage.world(), options.picture);
    film::Layout layout = make_layout(scene_tags(stage), job, options);
    film::SceneTags tags = scene_tags(stage, layout.aovs());
    int const spp = options.limits.spp;
    return {stage,
            job,
            region,
            std::move(tags),
            std::move(layout),
            sample_limit(job, options.limits),
            spp > 0 ? spp : sample_count(job.sampler)};
}

Identity identify(Plan const& plan, RenderOptions const& options, uint64_t scene_hash) {
    Vec2i const size = plan.stage.world().camera().size();
    film::Region const& region = plan.region;
    PictureOptions const& picture = options.picture;
    double const noise = options.limits.noise;
    return {{"version", picture.version},
            {"scene", fmt::format("{:016x}", scene_hash)},
            {"integrator", settings_text(plan.job.integrator)},
            {"sampler",
             match(plan.job.sampler, [](auto const& s) { return std::string(s.info.type); })},
            {"samples per pixel", std::to_string(plan.samples)},
            {"texture footprints", footprint_text(plan)},
            {"noise", noise > 0 ? fmt::format("{}", noise) : "any"},
            {"seed", std::to_string(picture.seed)},
            {"size", fmt::format("{}x{}", size.x, size.y)},
            {"crop",
             fmt::format("{},{},{},{}", region.from.x, region.from.y, region.to.x, region.to.y)},
            {"channels", channels_text(plan.layout)},
            {"kernel", picture.kernel.empty() ? "any" : picture.kernel}};
}

std::string difference(Identity const& here, Identity const& there) {
    auto const value = [](Identity const& all, std::string const& key) -> std::string {
        for (auto const& [name, text] : all)
            if (name == key) return text;
        return "unknown";
    };
    std::string text;
    for (auto const& [key, mine] : here)
        if (std::string const other = value(there, key); other != mine)
            text += fmt::format("{}{} is '{}' here and '{}' there", text.empty() ? "" : "; ", key,
                                mine, other);
    return text;
}

} // namespace weft::session
