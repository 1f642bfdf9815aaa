// Networks that end in a single input outside of materials: opacity, emission, environments,
// normal maps. Those that are asked for are compiled when the world is made.
#pragma once

#include <cassert>
#include <vector>

#include "shading/graph_compiler.h"

namespace weft::shading {

/// The light that a surface emits: colour times strength, from its `emission` or its material,
/// times a tint.
struct Emission {
    scene::Input<Color> color{Color(0)};
    scene::Input<float> strength{1};
    Color tint{1}; ///< a factor on it
    explicit operator bool() const { return color != scene::Input<Color>{Color(0)}; }
};

/// The opacity of a surface: that of its instance times that of its material.
struct Opacity {
    scene::Input<float> instance{1};
    scene::Input<float> material{1};
    friend bool operator==(Opacity const&, Opacity const&) = default;
};

class Textures {
  public:
    Textures() = default;
    explicit Textures(size_t count) : roots_(count) {}

    /// Compiles the network of `id`, if there is one. `where` is the place that messages name.
    void prepare(GraphCompiler& compiler, scene::TextureId id, SourceLocation const& where);

    /// Returns what the prepared network of `id` needs to know of a point.
    Needs needs(scene::TextureId id) const { return id ? root(id).program.needs : Needs::nothing; }
    Needs needs(Emission const& e) const {
        return needs(e.color.texture) | needs(e.strength.texture);
    }
    Needs needs(Opacity const& o) const {
        return needs(o.instance.texture) | needs(o.material.texture);
    }
    /// The value of a prepared network at `point`.
    Vec3 at(scene::TextureId id, SurfacePoint const& point) const;
    Color at(scene::Input<Color> const& input, SurfacePoint const& point) const {
        return input.texture ? color_at(input.texture, point) : input.value;
    }
    float at(scene::Input<float> const& input, SurfacePoint const& point) const {
        return input.texture ? number_at(input.texture, point) : input.value;
    }
    /// The same for networks that need nothing but uv.
    template <class T>
    T at(scene::Input<T> const& input, Vec2 uv) const {
        if (!input.texture) return input.value;
        assert(within(needs(input.texture), Needs::uv));
        SurfacePoint point;
        point.uv = uv;
        return at(input, point);
    }
    /// As `at`, kept to what light can be: at least 0. `place`: a SurfacePoint or a uv.
    template <class Place>
    Color radiance(scene::Input<Color> const& input, Place const& place) const {
        return max(at(input, place), 0);
    }
    template <class Place>
    Color radiance(Emission const& e, Place const& place) const {
        return radiance(e.color, place) * e.tint * std::max(at(e.strength, place), 0.f);
    }
    /// In 0 .. 1.
    template <class Place>
    float opacity(Opacity const& o, Place const& place) const {
        return std::clamp(at(o.instance, place), 0.f, 1.f) *
               std::clamp(at(o.material, place), 0.f, 1.f);
    }
    /// Returns the resolution of a prepared network (see graph.h).
    Vec2i resolution(scene::TextureId id) const { return shading::resolution(root(id).program); }

  private:
    struct Root {
        Program program;
        bool prepared = false;
    };
    Root const& root(scene::TextureId id) const {
        assert(roots_[size_t(id.index)].prepared);
        return roots_[size_t(id.index)];
    }
    Color color_at(scene::TextureId id, SurfacePoint const& point) const {
        Vec3 const v = at(id, point);
        return {v.x, v.y, v.z};
    }
    float number_at(scene::TextureId id, SurfacePoint const& point) const {
        Color const c = color_at(id, point);
        return root(id).program.result.type == scene::ValueType::color ? average(c) : c.r;
    }

    std::vector<Root> roots_; ///< by node
};

} // namespace weft::shading
