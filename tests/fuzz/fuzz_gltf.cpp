// A libFuzzer target: whatever the bytes, read_gltf gives valid meshes or throws InputError.
//
// Buffers and images are looked for in a folder that does not exist, so that no input reads the
// machine's own. An absolute path still could: the reader takes regular files alone.
#include "io/gltf.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(uint8_t const* data, size_t size) {
    std::string_view const bytes(reinterpret_cast<char const*>(data), size);
    weft::scene::Scene scene;
    weft::image::TextureCache textures;
    try {
        weft::io::read_gltf(bytes, "fuzz.gltf", "/nonexistent/folder", scene, textures);
    } catch (weft::InputError const&) {
        return 0; // a refused file is the other good outcome
    }
    try {
        for (auto const& mesh : scene.meshes) weft::scene::validate(*mesh, {"fuzz.gltf"});
    } catch (weft::InputError const&) {
        __builtin_trap(); // the reader let through what it promises to refuse
    }
    return 0;
}
