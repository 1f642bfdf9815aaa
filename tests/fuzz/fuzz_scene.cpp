// A libFuzzer target: whatever the text, parse_scene returns jobs or throws InputError.
//
// Files are looked for in a folder that does not exist, so that no input reads the machine's own.
// An absolute path still could: the reader takes regular files alone, whatever they hold.
#include "io/scene_file.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(uint8_t const* data, size_t size) {
    std::string_view const text(reinterpret_cast<char const*>(data), size);
    try {
        weft::io::SceneFile const file =
            weft::io::parse_scene(text, "fuzz.xml", "/nonexistent/folder");
        // Promised at least one.
        if (file.jobs.empty() && file.postprocesses.empty()) __builtin_trap();
    } catch (weft::InputError const&) {
        // A refused file is the other good outcome.
    }
    return 0;
}
