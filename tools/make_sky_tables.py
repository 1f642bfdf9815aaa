#!/usr/bin/env python3
"""Writes src/lights/hosek_wilkie_tables.h: the coefficients of Hosek and Wilkie's sky model.

    tools/make_sky_tables.py PROGRAM > src/lights/hosek_wilkie_tables.h

PROGRAM is any little-endian program that the authors' tables of doubles (ArHosekSkyModelData_XYZ.h,
version 1.4a) are compiled into, such as /usr/bin/blender of Debian 12 (3.4.1). The tables are found
by their first numbers and their size: three channels of 2 albedos x 10 turbidities x 6 control
points x 9 coefficients, and as many radiances without the last dimension.
"""

import struct
import sys

FIRST = {  # of albedo 0, turbidity 1
    "kShapeX": (1080, -1.117001e000, -1.867262e-001, -1.113505e001),
    "kShapeY": (1080, -1.127942e000, -1.905548e-001, -1.252356e001),
    "kShapeZ": (1080, -1.310023e000, -4.407658e-001, -3.640340e001),
    "kRadianceX": (120, 1.560219e000, 1.417388e000, 1.206927e000),
    "kRadianceY": (120, 1.632341e000, 1.395230e000, 1.375634e000),
    "kRadianceZ": (120, 1.168084e000, 2.156455e000, -3.980314e000),
}

LICENSE = """\
// clang-format off
// The coefficients of the sky model of Hosek and Wilkie 2012, "An Analytic Model for Full Spectral
// Sky-Dome Radiance", for CIE XYZ: version 1.4a of the authors' tables, made by
// tools/make_sky_tables.py. They are published under this licence:
//
// Copyright (c) 2012 - 2013, Lukas Hosek and Alexander Wilkie
// All rights reserved.
//
// Redistribution and use in source and binary forms, with or without modification, are permitted
// provided that the following conditions are met:
//
//     * Redistributions of source code must retain the above copyright notice, this list of
//       conditions and the following disclaimer.
//     * Redistributions in binary form must reproduce the above copyright notice, this list of
//       conditions and the following disclaimer in the documentation and/or other materials
//       provided with the distribution.
//     * None of the names of the contributors may be used to endorse or promote products derived
//       from this software without specific prior written permission.
//
// THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS AND CONTRIBUTORS "AS IS" AND ANY EXPRESS OR
// IMPLIED WARRANTIES, INCLUDING, BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND
// FITNESS FOR A PARTICULAR PURPOSE ARE DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT HOLDERS BE LIABLE
// FOR ANY DIRECT, INDIRECT, INCIDENTAL, SPECIAL, EXEMPLARY, OR CONSEQUENTIAL DAMAGES (INCLUDING, BUT
// NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR SERVICES; LOSS OF USE, DATA, OR PROFITS; OR
// BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY, WHETHER IN CONTRACT, STRICT
// LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY WAY OUT OF THE USE OF THIS
// SOFTWARE, EVEN IF ADVISED OF THE POSSIBILITY OF SUCH DAMAGE.
#pragma once

namespace weft::lights::hosek_wilkie {

// [albedo 0 or 1][turbidity - 1][control point of the Bezier curve over the elevation][coefficient]
"""


def nested(values, sizes):
    if not sizes:
        return f"{values[0]:.7g}"
    step = len(values) // sizes[0]
    parts = [nested(values[i * step : (i + 1) * step], sizes[1:]) for i in range(sizes[0])]
    return "{" + (", " if len(sizes) == 1 else ",\n ").join(parts) + "}"


def main():
    data = open(sys.argv[1], "rb").read()
    print(LICENSE, end="")
    for name, (count, *first) in FIRST.items():
        at = data.find(struct.pack("<3d", *first))
        if at < 0:
            sys.exit(f"{sys.argv[1]}: {name} is not there")
        values = struct.unpack(f"<{count}d", data[at : at + 8 * count])
        sizes = [2, 10, 6, 9] if count == 1080 else [2, 10, 6]
        text = "".join(f"[{n}]" for n in sizes)
        print(f"inline constexpr double {name}{text} = {nested(values, sizes)};")
    print("// clang-format on\n\n} // namespace weft::lights::hosek_wilkie")


main()
