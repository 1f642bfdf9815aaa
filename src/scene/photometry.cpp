#include "scene/photometry.h"

#include <cmath>

namespace weft::scene {

namespace {

bool is_ascending(std::vector<float> const& angles, float most) {
    bool right = !angles.empty() && angles.front() >= 0 && angles.back() <= most;
    for (size_t i = 1; i < angles.size(); ++i) right &= angles[i] > angles[i - 1];
    return right;
}

} // namespace

void validate(Photometry const& lamp, SourceLocation const& where) {
    if (lamp.vertical.size() < 2 || !is_ascending(lamp.vertical, 180))
        throw InputError(where, "expected at least 2 ascending vertical angles from 0 to 180");
    auto const& around = lamp.horizontal;
    bool const turn = around.size() == 1 || (!around.empty() && around.back() == 360);
    if (!is_ascending(around, 360) || around.front() != 0 || !turn)
        throw InputError(where, "expected horizontal angles that ascend from 0 to 360, or 0 alone");
    if (lamp.candela.size() != lamp.vertical.size() * around.size())
        throw InputError(where, "expected one intensity for each pair of angles, found " +
                                    std::to_string(lamp.candela.size()));
    for (float const c : lamp.candela)
        if (!(c >= 0 && std::isfinite(c)))
            throw InputError(where,
                             "expected intensities of at least 0, found " + std::to_string(c));
}

} // namespace weft::scene
