// What each kind of postprocess does.
#pragma once

#include "post/run.h"

namespace weft::post {

/// The pictures that one postprocess may read.
struct Inputs {
    Pictures const& pictures;

    /// Returns the colours of a picture: its channels R, G and B, or all where these are not there.
    image::Image colors(scene::ImageId id) const;
    /// Returns the three channels of a layer of a picture; empty for the layer "".
    image::Image layer(scene::ImageId id, std::string const& name) const;
    /// Returns the names of a picture's channels.
    std::vector<std::string> const& channels(scene::ImageId id) const {
        return pictures.at(id.index).image.names;
    }
};

/// The colours of a picture that a postprocess has made of those of its `input`, and what to note
/// in its file about how ("denoising (nlm)"). Throws InputError without a place.
struct Applied {
    image::Image image;
    std::string how;
};

Applied apply(scene::Denoising const& denoising, Inputs const& inputs);
Applied apply(scene::Bloom const& bloom, Inputs const& inputs);
Applied apply(scene::Tonemap const& tonemap, Inputs const& inputs);

} // namespace weft::post
