// The balls of lamps that have a size, for rays that may meet them. They are no objects: a ray
// meets all that lie on its way, and goes on behind them (lights/luminaire.h).
#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "world/embree.h"
#include "world/ray.h"

namespace weft::lights {

class LampScene {
  public:
    struct Ball {
        Vec3 centre;
        float radius;
        int32_t light; ///< its index
    };
    struct Meeting {
        int32_t light;
        float t;
        Vec3 n; ///< unit, outwards
    };

    /// Throws std::runtime_error where memory is short.
    LampScene(RTCDevice device, std::vector<Ball> balls);
    ~LampScene();
    LampScene(LampScene const&) = delete;
    LampScene& operator=(LampScene const&) = delete;

    /// Calls f(Meeting) for every ball that the ray meets before its t_max, in an order that
    /// depends on the ray alone. `from`: where on the ray's line light sampling started.
    template <class F>
    void each(world::Ray const& ray, Vec3 const& from, F&& f) const {
        using Function = std::remove_reference_t<F>;
        visit(ray, from, &f, [](void* function, Meeting const& meeting) {
            (*static_cast<Function*>(function))(meeting);
        });
    }

  private:
    using Call = void (*)(void*, Meeting const&);
    struct Query;

    void visit(world::Ray const& ray, Vec3 const& from, void* function, Call call) const;
    static void bounds(RTCBoundsFunctionArguments const* args);
    static void intersect(RTCIntersectFunctionNArguments const* args);

    std::vector<Ball> balls_;
    RTCScene scene_ = nullptr;
};

} // namespace weft::lights
