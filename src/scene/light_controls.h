// What every light can be told besides its shape and its brightness.
#pragma once

#include <string>
#include <string_view>

#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene {

inline constexpr schema::Attr kGroupAttr{
    .help = "Light group: the `light_groups` AOV has a picture of the light of each. Letters, "
            "digits, _ and -; without one it is in `default`."};

struct LightControls {
    float weight = 1;
    std::string group;

    template <class F>
    constexpr void describe(F&& f) {
        f("weight", weight,
          {.min = 0, .help = "Factor on the chance of being picked by light sampling; 0 = never."});
        f("group", group, kGroupAttr);
    }
};

} // namespace weft::scene
