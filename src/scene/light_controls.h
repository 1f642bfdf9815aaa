// What every light can be told besides its shape and its brightness.
#pragma once

#include <string_view>

#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene {

struct LightControls {
    float weight = 1;

    template <class F>
    constexpr void describe(F&& f) {
        f("weight", weight,
          {.min = 0, .help = "Factor on the chance of being picked by light sampling; 0 = never."});
    }
};

} // namespace weft::scene
