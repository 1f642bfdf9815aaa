// A libFuzzer target: whatever the bytes, read_ply returns a valid mesh or throws InputError.
//
//   clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined \
//       -Isrc -I/usr/include/Imath tests/fuzz/fuzz_ply.cpp src/base/error.cpp src/scene/mesh.cpp \
//       src/io/ply*.cpp src/io/mesh_text.cpp src/base/file_bytes.cpp -o fuzz_ply
//   ./fuzz_ply -max_len=4096 -malloc_limit_mb=64 CORPUS tests/io/bad
#include "io/ply.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(uint8_t const* data, size_t size) {
    std::string_view const bytes(reinterpret_cast<char const*>(data), size);
    try {
        weft::scene::Mesh const mesh = weft::io::read_ply(bytes, "fuzz.ply");
        try {
            weft::scene::validate(mesh, {"fuzz.ply"});
        } catch (weft::InputError const&) {
            __builtin_trap(); // the reader let through what it promises to refuse
        }
    } catch (weft::InputError const&) {
        // A refused file is the other good outcome.
    }
    return 0;
}
