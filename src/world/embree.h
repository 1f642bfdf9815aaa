// Embree, whichever version is installed: 4, or 3.13. The two differ in how a ray query is called.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define WEFT_EMBREE_4 1
#else
#include <embree3/rtcore.h>
#define WEFT_EMBREE_4 0
#endif

namespace weft::world {

/// Of scenes whose queries may bring a filter.
#if WEFT_EMBREE_4
inline constexpr RTCSceneFlags kQueryFilters = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
inline constexpr RTCSceneFlags kQueryFilters = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

#if WEFT_EMBREE_4
using QueryContext = RTCRayQueryContext;
inline void init_context(QueryContext* context) { rtcInitRayQueryContext(context); }
inline void embree_intersect(RTCScene scene, QueryContext* context, RTCRayHit* ray) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = context;
    rtcIntersect1(scene, ray, &arguments);
}
/// Asks `filter` at every hit, after the geometry's own.
inline void embree_intersect(RTCScene scene, QueryContext* context, RTCRayHit* ray,
                             RTCFilterFunctionN filter) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = context;
    arguments.filter = filter;
    arguments.flags = RTCRayQueryFlags(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
    rtcIntersect1(scene, ray, &arguments);
}
inline void embree_occluded(RTCScene scene, QueryContext* context, RTCRay* ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = context;
    rtcOccluded1(scene, ray, &arguments);
}
#else
using QueryContext = RTCIntersectContext;
inline void init_context(QueryContext* context) { rtcInitIntersectContext(context); }
inline void embree_intersect(RTCScene scene, QueryContext* context, RTCRayHit* ray) {
    rtcIntersect1(scene, context, ray);
}
/// Asks `filter` at every hit, after the geometry's own.
inline void embree_intersect(RTCScene scene, QueryContext* context, RTCRayHit* ray,
                             RTCFilterFunctionN filter) {
    context->filter = filter;
    rtcIntersect1(scene, context, ray);
}
inline void embree_occluded(RTCScene scene, QueryContext* context, RTCRay* ray) {
    rtcOccluded1(scene, context, ray);
}
#endif

} // namespace weft::world
