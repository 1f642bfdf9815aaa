// A render that is not whole, as a file: what a checkpoint keeps, what a shard writes, and what
// `weft merge` joins. It holds the film's exact sums, and the identity of the render, so that parts
// of different pictures are never mixed.
//
// Layout: a line with the format's version, the size of a JSON object (8 bytes, little-endian), the
// object, the film's state (film/film.h), and a 64-bit hash of all that comes before it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/job.h"
#include "session/render.h"

namespace weft::session {

/// All that decides which value a sample has, in words: {"seed", "0"}, ... Renders whose identities
/// are equal make the same samples.
using Identity = std::vector<std::pair<std::string, std::string>>;

/// Of a render that `render` would make. `options.kernel` counts as the user gave it.
Identity identify(lights::Stage const& stage, scene::RenderJob const& job,
                  RenderOptions const& options);

/// "seed is 1 here and 0 there; ...", or "" where they are equal.
std::string difference(Identity const& here, Identity const& there);

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

/// The state of that render before its first sample.
RenderState starting_state(lights::Stage const& stage, scene::RenderJob const& job,
                           RenderOptions const& options);

/// As bytes.
std::string write_state(RenderState const& state);

/// Throws InputError, naming `name`, where the bytes are no state, damaged, or of another version.
RenderState read_state(std::string_view bytes, std::string const& name);

/// The same in a file, whose place it takes in one step (image/atomic_file.h). Throws IoError.
void save_state(std::string const& path, RenderState const& state);
RenderState load_state(std::string const& path);

/// Joins parts to one picture, in the order of their samples: shards give the bits of a single
/// render, ranges of samples those of a single render but for the rounding of sums in double.
/// `names` are for messages. Throws InputError where parts are missing, there twice, unfinished, or
/// of another render.
RenderState merge(std::vector<RenderState> parts, std::vector<std::string> const& names);

} // namespace weft::session
