// The light of a clear day: sky, sun and the ground that they shine on.
#pragma once

#include <optional>
#include <string>

#include "scene/environment_light.h"

namespace weft::scene {

struct Date {
    int year = 2000, month = 1, day = 1;
};
/// Reads "2026-06-21". Returns nothing where it is no day of the Gregorian calendar.
std::optional<Date> parse_date(std::string_view text);

struct SkyLight {
    static constexpr schema::TypeInfo info{
        .category = "light",
        .type = "sky",
        .help = "A clear sky with the sun in it, after Hosek and Wilkie: y is up, north is -z and "
                "east is x. The sun's place is given by `date` and what belongs to it, or else by "
                "`direction`, or else by `elevation` and `azimuth`.",
        .example = "<light type=\"sky\" elevation=\"30\" azimuth=\"60\" turbidity=\"3\"/>"};
    float turbidity = 3;
    Color ground{0.2f};
    float elevation = 45;
    float azimuth = 45;
    Vec3 direction{0, 0, 0};
    std::string date;
    float time = 12;
    float time_zone = 0;
    float latitude = 49;
    float longitude = 7;
    float sun_size = 1;
    float sun_intensity = 1;
    float sky_intensity = 1;
    Affined transform;
    std::vector<PortalId> portals;
    LightControls controls;

    template <class F>
    constexpr void describe(F&& f) {
        f("turbidity", turbidity,
          {.min = 1,
           .max = 10,
           .help = "Haze: 1 is pure air, 2 a very clear day, 3 a clear one, 6 a warm and moist "
                   "one, 10 hazy."});
        f("ground", ground,
          {.min = 0,
           .max = 1,
           .help = "Albedo of the ground all around, which is seen below the horizon and brightens "
                   "the sky a little."});
        f("elevation", elevation,
          {.unit = "deg",
           .min = -90,
           .max = 90,
           .help = "Of the sun above the horizon. Below it only the sky is left, and fades."});
        f("azimuth", azimuth,
          {.unit = "deg",
           .min = -360,
           .max = 360,
           .help = "Of the sun: 0 north (-z), 90 east (x), 180 south, 270 west."});
        f("direction", direction,
          {.help = "Points towards the sun, instead of the two angles; 0 = take the angles."});
        f("date", date,
          {.help = "Year, month and day, as 2026-06-21: the sun stands where it is then."});
        f("time", time, {.unit = "h", .min = 0, .max = 24, .help = "Local time on that day."});
        f("timeZone", time_zone,
          {.unit = "h",
           .min = -14,
           .max = 14,
           .help = "Hours that local time is ahead of UTC, summer time included."});
        f("latitude", latitude,
          {.unit = "deg", .min = -90, .max = 90, .help = "North is positive."});
        f("longitude", longitude,
          {.unit = "deg", .min = -180, .max = 180, .help = "East is positive."});
        f("sunSize", sun_size,
          {.min = 0.1,
           .max = 100,
           .soft_max = 10,
           .help = "Factor on the sun's diameter of 0.533 degrees; its light stays the same, "
                   "shadows get softer."});
        f("sunIntensity", sun_intensity,
          {.min = 0, .help = "Factor on the sun's light; 0 = no sun."});
        f("skyIntensity", sky_intensity, {.min = 0, .help = "Factor on the sky's light."});
        f("transform", transform,
          {.help = "From a space with y up and north at -z to the world: turns sky and sun."});
        f("portal", portals, kPortalAttr);
        f.group(controls);
    }
};

} // namespace weft::scene
