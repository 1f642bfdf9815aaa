// A render that is not whole, as a file: what a checkpoint keeps, what a shard writes, and what
// `weft merge` joins. It holds the film's exact sums, and the identity of the render, so that parts
// of different pictures are never mixed.
//
// Layout: a line with the format's version, the size of a JSON object (8 bytes, little-endian), the
// object, the film's state (film/film.h), and a 64-bit hash of all that comes before it.
#pragma once

#include <string>
#include <vector>

#include "session/render.h"

namespace weft::session {

struct RenderState {
    Identity identity;
    Part part;
    int tile_size = 32;   ///< decides which tiles a shard has
    uint32_t samples = 0; ///< per pixel, of the whole render
    PassState pass;
    double seconds = 0; ///< of rendering so far
    uint64_t bad_samples = 0;
    std::vector<BadSample> first_bad_samples;
    std::string note; ///< the program's own, kept as it is
    film::Film film;
};

/// Returns everything about a result that a state file keeps but for its film, which is empty.
RenderState make_state(RenderResult const& result, Plan const& plan, RenderOptions const& options);

/// Returns the state of a render before its first sample.
RenderState starting_state(Plan const& plan, RenderOptions const& options);

/// Returns everything about a result that a state file keeps; its film is moved there.
RenderState to_state(RenderResult&& result, Plan const& plan, RenderOptions const& options);

/// Returns the state as bytes.
std::string write_state(RenderState const& state);

/// Throws InputError, naming `name`, where the bytes are no state, damaged, or of another version.
RenderState read_state(std::string_view bytes, std::string const& name);

/// Writes the state to a file, whose place it takes in one step (image/atomic_file.h). Throws
/// IoError.
void save_state(std::string const& path, RenderState const& state);
/// Throws IoError where the file cannot be read, and InputError as `read_state` does.
RenderState load_state(std::string const& path);

/// Joins parts to one picture, in the order of their samples: shards give the bits of a single
/// render, ranges of samples those of a single render but for the rounding of sums in double.
/// `names` are for messages. Throws InputError where parts are missing, there twice, unfinished, or
/// of another render.
RenderState merge(std::vector<RenderState> parts, std::vector<std::string> const& names);

} // namespace weft::session
