// How long a large mesh takes from its file to a world that can be rendered.
#pragma once

#include <string>

namespace weft::bench {

struct LoadingFigures {
    size_t triangles = 0;
    double file_seconds = 0;   ///< reading the mesh file into memory, from the system's cache
    double kernel_seconds = 0; ///< Embree's own building over the mesh
    double read_seconds = 0;   ///< the scene file and the mesh, parsed and validated
    double commit_seconds = 0; ///< Stage::commit
    double ratio() const {
        return (read_seconds + commit_seconds) / (file_seconds + kernel_seconds);
    }
};

/// The best of `rounds` of each, taken in turns. `scene_file` shows one mesh, `mesh_file`.
/// Throws InputError.
LoadingFigures measure_loading(std::string const& scene_file, std::string const& mesh_file,
                               int rounds = 5);

} // namespace weft::bench
