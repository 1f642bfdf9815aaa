// What each kind of postprocess does.
#pragma once

#include "post/run.h"

namespace weft::post {

/// The pictures that one postprocess may read.
struct Inputs {
    Pictures const& pictures;

    /// Null where the parameter is not given.
    image::Image const* find(scene::ImageId id) const {
        return id ? &pictures.at(id.index).image : nullptr;
    }
};

/// A picture that a postprocess has made, and what to note in its file about how ("denoising
/// (nlm)"). Throws InputError without a place.
struct Applied {
    image::Image image;
    std::string how;
};

Applied apply(scene::Denoising const& denoising, Inputs const& inputs);
Applied apply(scene::Bloom const& bloom, Inputs const& inputs);
Applied apply(scene::Tonemap const& tonemap, Inputs const& inputs);

} // namespace weft::post
