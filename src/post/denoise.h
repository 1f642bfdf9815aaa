// Takes the noise out of a rendered picture.
//
// Three backends, from the best to the one that is always there:
//
//  oidn     the library Intel Open Image Denoise, where the system has it (post/oidn.h)
//  network  its published network, evaluated by us with its published weights (post/network.h)
//  nlm      non-local means guided by albedo and normal (post/nlm.h)
//
// What is common to all: pixels that are not finite are taken for black, negative ones for 0; so
// the result is finite and not negative. Pixels keep their place, and nothing but the three colour
// channels is made: alpha and other layers are the caller's.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "image/image.h"
#include "scene/postprocess.h"

namespace weft::post {

using Backend = scene::DenoiseBackend;

/// How much work to spend. `high` denoises albedo and normal first, where both are given, and then
/// the colour with the larger network. `balanced` uses the smaller network, made for noisy guides.
using Quality = scene::DenoiseQuality;

struct DenoiseInput {
    image::Image const* color = nullptr; ///< linear RGB, any exposure; further channels are ignored
    image::Image const* albedo = nullptr; ///< of the first surface, in [0, 1]; may be null
    image::Image const* normal = nullptr; ///< unit vectors in any frame, 0 for none; may be null
    /// Light that is part of the colour and stays as it is, such as that of lamps in view; may be
    /// null. The rest is denoised without it. For the network bright light has coarse steps: it
    /// moves the edges of what is far brighter than white by more than their noise.
    image::Image const* kept = nullptr;
};

struct DenoiseOptions {
    Backend backend = Backend::automatic;
    Quality quality = Quality::high;
    /// Megabytes (2^20 bytes) that may be taken beside the pictures; at least 256. Where that is
    /// less than the whole picture needs it is done in tiles.
    int memory = 1024;
    /// A folder to look for the network's weights in before all others (`weight_folders`), or "".
    std::string weights;
    /// What the dynamic linker is asked for, in this order.
    std::vector<std::string> oidn_libraries{"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1",
                                            "libOpenImageDenoise.so"};
};

struct Denoised {
    image::Image image; ///< RGB, of the size of the colour
    Backend backend;    ///< that did it; not `automatic`
    /// The network did it in balanced quality, since the weights of high quality are not there.
    bool lacks_weights = false;
};

/// Denoises a picture. Throws InputError where sizes or numbers of channels do not match, where the
/// memory is too small, or where the system lacks the backend that is asked for; the message then
/// says how to get it.
Denoised denoise(DenoiseInput const& input, DenoiseOptions const& options);

/// Returns the name of a backend as files have it.
std::string_view backend_name(Backend backend);

/// Returns normals as vectors. Where no value is negative, the picture is taken for (n + 1) / 2, as
/// the `normal` and `aov` integrators draw it, and its black pixels for 0, no surface. Any other
/// picture is returned as it is.
image::Image unpack_normals(image::Image const& picture);

} // namespace weft::post
