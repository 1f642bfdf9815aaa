// Non-local means, guided by features: the backend that needs nothing but this program.
//
// A pixel becomes a weighted mean of the pixels around it whose surroundings look alike (Buades,
// Coll and Morel 2005), in the form of Rousselle, Manzi and Zwicker 2013 ("Robust Denoising using
// Feature and Color Information"), equations 1 to 4: the squared difference of two patches, less
// what noise alone makes of it, in units of the noise. Albedo and normals tell surfaces apart, and
// the weight is the smaller of what colour and features say. In our own way:
//
//  * Light is filtered, not colour: pixels are divided by the albedo first and multiplied
//    in the end, so that textures stay sharp.
//  * There is one picture and no variance beside it. The noise of a pixel is the median absolute
//    deviation of what a high pass leaves of the logarithm around it, which edges and outliers
//    do not disturb.
//  * A pixel far brighter than all but two of those around it is brought down to the third
//    brightest: a lone bright sample would otherwise stay or smear. This loses light, and it
//    is the only thing here that does so on purpose.
//
// Left out: variance and feature buffers of two half pictures, and the choice between several
// filters by estimated error, both of that paper: they need what a plain picture does not have.
#pragma once

#include "post/denoise.h"

namespace weft::post {

/// Denoises a picture. Guides that are given have the size of the colour and at least three
/// channels. The result depends neither on threads nor on tiles; a thread takes a few megabytes.
image::Image denoise_nlm(DenoiseInput const& input);

} // namespace weft::post
