// Denoising with the published network of Intel Open Image Denoise (Afra 2019-; Apache 2.0),
// evaluated by ourselves (post/unet.h): for systems that do not have that library.
//
// What goes into the network and comes out of it follows the published sources: colours are scaled
// by `auto_exposure` and encoded by `encode_hdr`; albedo is clipped to [0, 1], normals n become (n
// + 1) / 2. Of the published weights there are taken
//
//  rt_alb, rt_nrm, rt_hdr_calb_cnrm_large   `high` quality, with albedo and normal: the noise is
//                                           taken out of these first, then the large network for
//                                           clean guides sees them
//  rt_hdr_alb_nrm                           `balanced` quality: guides go in as they are
//  rt_hdr_alb, rt_hdr                       where there is no normal, or no albedo
//
// Left out: the "small" networks, and the large ones for guides, which gain nothing that shows.
//
// The weights are files of their own, which `tools/setup denoise` downloads.
#pragma once

#include <optional>

#include "post/denoise.h"
#include "post/unet.h"

namespace weft::post {

/// Files with weights; the guides' are "" where guides go in as they are.
struct NetworkWeights {
    std::string color, albedo, normal;
};

/// Returns the names of the files that the network for these inputs needs. The network does not use
/// normals without an albedo.
NetworkWeights weights_files(DenoiseInput const& input, Quality quality);

/// Returns the paths of those files, or nothing where one is in none of the folders.
std::optional<NetworkWeights> find_weights(NetworkWeights const& files,
                                           std::vector<std::string> const& folders);

/// Maps light, scaled to the picture's exposure and in [0, 65504], to [0, 1], in steps that look
/// alike to the eye; `decode_hdr` maps back. It is a fit of the curve of Aydin, Mantiuk and Seidel
/// 2008 ("Extending Quality Metrics to Full Luminance Range Images"), normalised at 100 cd/m^2 and
/// to 1 at 65504, as the network was trained with.
float encode_hdr(float light);
float decode_hdr(float code);

/// Returns into how many tiles `denoise_network` would cut a picture with that many input channels;
/// 0 where `memory` megabytes do not suffice for the smallest.
int tile_count(UnetSize size, int width, int height, int channels, int memory);

/// Denoises a picture with the weights at these paths. Throws InputError where one is not what it
/// should be, or where `memory` megabytes do not suffice for the smallest tiles. The size of the
/// tiles changes pixels by rounding alone (relatively about 1e-5). The result does not depend on
/// threads; it depends on the instruction set in the last bits.
image::Image denoise_network(DenoiseInput const& input, NetworkWeights const& weights, int memory);

} // namespace weft::post
