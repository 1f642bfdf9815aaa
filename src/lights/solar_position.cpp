#include "lights/solar_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::lights {

SolarPosition solar_position(int year, int month, int day, double hour, double zone,
                             double latitude, double longitude) {
    constexpr double deg = std::numbers::pi / 180;
    // Days since 2000-01-01 12:00 UT, in the Gregorian calendar (7.1).
    int const y = month <= 2 ? year - 1 : year, m = month <= 2 ? month + 12 : month;
    int const century = y / 100, leap = 2 - century + century / 4;
    double const days = std::floor(365.25 * (y + 4716)) + std::floor(30.6001 * (m + 1)) + day +
                        leap - 1524.5 - 2451545.0 + (hour - zone) / 24;
    double const t = days / 36525;

    // Chapter 25: mean longitude, anomaly and equation of centre, then the apparent longitude.
    double const mean = 280.46646 + t * (36000.76983 + t * 0.0003032);
    double const anomaly = (357.52911 + t * (35999.05029 - t * 0.0001537)) * deg;
    double const centre = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                          (0.019993 - t * 0.000101) * std::sin(2 * anomaly) +
                          0.000289 * std::sin(3 * anomaly);
    double const node = (125.04 - 1934.136 * t) * deg;
    double const lambda = (mean + centre - 0.00569 - 0.00478 * std::sin(node)) * deg;
    double const obliquity = (23.439291 - 0.0130042 * t + 0.00256 * std::cos(node)) * deg;
    double const ascension = std::atan2(std::cos(obliquity) * std::sin(lambda), std::cos(lambda));
    double const declination = std::asin(std::sin(obliquity) * std::sin(lambda));

    // Chapters 12 and 13: sidereal time, hour angle, horizontal coordinates.
    double const sidereal = (280.46061837 + 360.98564736629 * days + 0.000387933 * t * t) * deg;
    double const angle = sidereal + longitude - ascension;
    double const sine = std::sin(latitude) * std::sin(declination) +
                        std::cos(latitude) * std::cos(declination) * std::cos(angle);
    double const south =
        std::atan2(std::sin(angle), std::cos(angle) * std::sin(latitude) -
                                        std::tan(declination) * std::cos(latitude));
    double const azimuth = std::fmod(south + std::numbers::pi, 2 * std::numbers::pi);
    return {std::asin(std::clamp(sine, -1.0, 1.0)),
            azimuth < 0 ? azimuth + 2 * std::numbers::pi : azimuth};
}

} // namespace weft::lights
