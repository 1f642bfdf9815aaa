#include "image/rewrite.h"

#include <cassert>
#include <filesystem>

#include "image/input.h"
#include "image/output_file.h"

namespace weft::image {

namespace {

bool is_exr(std::string const& path) {
    std::string const e = std::filesystem::path(path).extension().string();
    return e == ".exr" || e == ".EXR";
}

} // namespace

void rewrite_exr(std::string const& path, std::string const& original, Image const& image,
                 Metadata const& more) {
    if (!is_exr(path)) throw InputError({path}, "expected the extension '.exr'");
    auto const input = open_flat_image(original);
    if (std::string_view(input->format_name()) != "openexr")
        throw InputError({original}, "expected an EXR file, found another format");
    OIIO::ImageSpec spec = input->spec();
    assert(spec.width == image.width && spec.height == image.height &&
           spec.nchannels == image.channels);
    if (image.is_converted) spec.erase_attribute("chromaticities");
    for (auto const& [name, value] : more) spec.attribute(name, value);
    write_file(path, "", [&](OIIO::ImageOutput& output, std::string const& name) {
        return output.open(name, spec) &&
               output.write_image(OIIO::TypeDesc::FLOAT, image.pixels.data());
    });
}

} // namespace weft::image
