#include "post/run.h"

#include "image/layers.h"
#include "post/apply.h"

namespace weft::post {

image::Image Inputs::colors(scene::ImageId id) const {
    image::Image const& image = pictures.at(id.index).image;
    auto const colors = image::find_colors(image.names);
    return colors ? image::take_channels(image, *colors) : image;
}

image::Image Inputs::layer(scene::ImageId id, std::string const& name) const {
    image::Image const& image = pictures.at(id.index).image;
    auto const channels = image::find_layer(image.names, name);
    return name.empty() ? image::Image() : image::take_channels(image, *channels);
}

Picture run(scene::PostprocessJob const& job, Pictures const& pictures) {
    auto const ids = scene::pictures_of(job.postprocess);
    Picture result;
    for (auto const& [name, id] : ids.inputs)
        if (name == "input") result = pictures.at(id.index);
    try {
        Applied applied =
            match(job.postprocess, [&](auto const& p) { return apply(p, Inputs{pictures}); });
        if (auto const colors = image::find_colors(result.image.names))
            image::put_channels(applied.image, *colors, result.image);
        else
            result.image = std::move(applied.image);
        std::string& how = result.header.texts["weft:postprocess"];
        how += (how.empty() ? "" : ", ") + applied.how;
    } catch (InputError const& e) {
        throw InputError(job.where, e.what());
    }
    return result;
}

} // namespace weft::post
