// A libFuzzer target: whatever the bytes, read_ies returns a whole lamp or throws InputError.
//
//   clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined \
//       -Isrc -I/usr/include/Imath tests/fuzz/fuzz_ies.cpp src/base/error.cpp src/io/ies.cpp \
//       src/io/mesh_text.cpp src/base/file_bytes.cpp src/schema/text.cpp -lfmt -o fuzz_ies
//   ./fuzz_ies -max_len=4096 -malloc_limit_mb=64 CORPUS tests/io/ies tests/io/bad
#include "base/error.h"
#include "io/ies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>

extern "C" int LLVMFuzzerTestOneInput(uint8_t const* data, size_t size) {
    std::string_view const bytes(reinterpret_cast<char const*>(data), size);
    try {
        weft::scene::Photometry const lamp = weft::io::read_ies(bytes, "fuzz.ies");
        auto ascends = [](auto const& angles) {
            return std::adjacent_find(angles.begin(), angles.end(), std::greater_equal()) ==
                   angles.end();
        };
        bool const whole = lamp.vertical.size() >= 2 && ascends(lamp.vertical) &&
                           ascends(lamp.horizontal) &&
                           lamp.candela.size() == lamp.vertical.size() * lamp.horizontal.size() &&
                           (lamp.horizontal.size() == 1 ||
                            (lamp.horizontal.front() == 0 && lamp.horizontal.back() == 360)) &&
                           std::all_of(lamp.candela.begin(), lamp.candela.end(),
                                       [](float c) { return c >= 0 && std::isfinite(c); });
        if (!whole) __builtin_trap(); // the reader let through what it promises to refuse
    } catch (weft::InputError const&) {
        // A refused file is the other good outcome.
    }
    return 0;
}
