// The part of WorldBuilder that says which rays meet which objects.
#include "world/world_builder.h"

namespace weft::world {

bool is_visible(scene::RayVisibility const& v, RayKind kind) {
    switch (kind) {
    case RayKind::camera:
        return v.camera;
    case RayKind::diffuse:
    case RayKind::subsurface:
        return v.diffuse;
    case RayKind::glossy:
        return v.glossy;
    case RayKind::transmission:
        return v.transmission;
    case RayKind::volume:
        return v.volume;
    }
    return true;
}

RayMask World::shadow_mask(Links const& blockers) const {
    for (size_t i = 0; i < shadow_links_.size(); ++i)
        if (shadow_links_[i] == blockers) return 1u << (kFirstLinkBit + i);
    return kShadowMask;
}

void WorldBuilder::mask_models() {
    for (scene::LightId id : scene_.contents.lights) {
        SourceLocation const where = location_of(scene_, id);
        scene::LightControls const& c =
            match(scene_.lights[size_t(id.index)],
                  [](auto const& l) -> scene::LightControls const& { return l.controls; });
        Links const links = world_.sets_.find(c.shadowed_by, "shadowedBy", where);
        if (!links || world_.shadow_mask(links) != kShadowMask) continue;
        if (world_.shadow_links_.size() == kLinkBits)
            throw InputError(where, "expected at most " + std::to_string(kLinkBits) +
                                        " different lists in 'shadowedBy', found another: '" +
                                        c.shadowed_by + "'");
        world_.shadow_links_.push_back(links);
    }
    for (Model& m : world_.models_) {
        scene::InstanceTraits const& t = m.traits;
        scene::RayVisibility const& v = t.visibility;
        m.ray_mask = kUnruledMask;
        for (RayKind kind : kAllRayKinds)
            if (is_visible(v, kind)) m.ray_mask |= mask_of(kind);
        if (v.shadow) m.ray_mask |= kShadowMask;
        if (v.shadow && t.shadow_catcher) m.ray_mask |= kCatcherMask;
        for (size_t i = 0; i < world_.shadow_links_.size(); ++i)
            if (v.shadow && world_.shadow_links_[i].accept(m.sets))
                m.ray_mask |= 1u << (kFirstLinkBit + i);
        world_.has_controls_ |= t.holdout || t.shadow_catcher || t.trace_distance > 0;
        world_.has_controls_ |= v != scene::RayVisibility{};
        world_.has_controls_by_kind_ |=
            v.diffuse != v.glossy || v.diffuse != v.transmission || v.diffuse != v.volume;
    }
    // A light that is not to be seen is an object that rays do not meet.
    for (auto const& [object, id] : world_.area_objects_) {
        auto const& controls = std::get<scene::AreaLight>(scene_.lights[size_t(id.index)]).controls;
        for (RayKind kind : kAllRayKinds)
            if (!(kind == RayKind::camera ? controls.visible_to_camera
                                          : controls.visible_to_secondary))
                world_.models_[world_.object(object).model].ray_mask &= ~mask_of(kind);
    }
}

} // namespace weft::world
