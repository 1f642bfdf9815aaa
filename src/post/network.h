// Denoising with the published network of Intel Open Image Denoise (Afra 2019-; Apache 2.0),
// evaluated by ourselves (post/unet.h): for systems that do not have that library.
//
// What goes into the network and comes out of it follows the published sources: colours are scaled
// by `auto_exposure` and encoded by `encode_hdr`; albedo is clipped to [0, 1], normals n become (n
// + 1) / 2. The weights are those for features with noise ("rt_hdr_alb_nrm"), and fewer where there
// is no normal or no albedo. Weights of the "large" and "small" networks, and those that take the
// noise out of the features first, are left out.
//
// The weights are files of their own, which `tools/setup denoise` downloads.
#pragma once

#include "post/denoise.h"

namespace weft::post {

/// The file of weights for these inputs: "rt_hdr_alb_nrm.tza", "rt_hdr_alb.tza" or "rt_hdr.tza".
/// Normals without albedo are of no use to the network.
std::string weights_file(DenoiseInput const& input);

/// Light, scaled to the picture's exposure and in [0, 65504], to [0, 1] in steps that look alike: a
/// fit of the curve of Aydin, Mantiuk and Seidel 2008 ("Extending Quality Metrics to Full
/// Luminance Range Images"), normalised at 100 cd/m^2 and to 1 at 65504, as the network was trained
/// with.
float encode_hdr(float light);
float decode_hdr(float code);

/// Into how many tiles it would cut a picture with that many inputs; 0: not even those suffice.
int tile_count(int width, int height, int channels, int memory);

/// Throws InputError where the file of weights `weights` is not what it should be, or where
/// `memory` megabytes do not suffice for the smallest tiles. The size of the tiles changes pixels
/// by rounding alone (relatively about 1e-5). The result does not depend on threads; it depends on
/// the instruction set in the last bits.
image::Image denoise_network(DenoiseInput const& input, std::string const& weights, int memory);

} // namespace weft::post
