// Where the sun stands, by time and place.
//
// Meeus 1998, "Astronomical Algorithms", chapters 7, 12, 13 and 25 (the sun's apparent position to
// lower accuracy, 0.01 degrees from 1800 to 2200). Left out: refraction (up to 0.5 degrees at the
// horizon), parallax, and the difference of uniform and universal time.
#pragma once

namespace weft::lights {

struct SolarPosition {
    double elevation = 0; ///< radians above the horizon
    double azimuth = 0;   ///< radians from north, through east
};

/// `month` from 1, `day` from 1; `hour`: local time, 0 to 24, of a zone `zone` hours ahead of UTC;
/// `latitude` (north) and `longitude` (east) in radians.
SolarPosition solar_position(int year, int month, int day, double hour, double zone,
                             double latitude, double longitude);

} // namespace weft::lights
