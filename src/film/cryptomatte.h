// Names as Cryptomatte ids (Friedman and Jones 2015, "Fully automatic ID mattes with support for
// motion blur and transparency"; the specification's version 1.2.0).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "image/image.h"

namespace weft::film {

/// Returns MurmurHash3_x86_32 (A. Appleby) of the bytes of `text`.
uint32_t murmur_hash3(std::string_view text, uint32_t seed = 0);

/// Returns the bits of the float that stands for `name`: its hash, with the lowest bit of the
/// exponent flipped where it would be 0, a subnormal number, an infinity or not a number.
uint32_t cryptomatte_id(std::string_view name);

/// Returns what the header of a file says about the Cryptomatte called `layer` ("CryptoObject"):
/// how names became ids, and which names did.
image::Metadata cryptomatte_metadata(std::string const& layer,
                                     std::map<std::string, uint32_t> const& manifest);

} // namespace weft::film
