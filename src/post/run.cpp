#include "post/run.h"

#include "post/apply.h"

namespace weft::post {

Picture run(scene::PostprocessJob const& job, Pictures const& pictures) {
    auto const ids = scene::pictures_of(job.postprocess);
    Picture result;
    for (auto const& [name, id] : ids.inputs)
        if (name == "input") result.metadata = pictures.at(id.index).metadata;
    try {
        Applied applied =
            match(job.postprocess, [&](auto const& p) { return apply(p, Inputs{pictures}); });
        result.image = std::move(applied.image);
        std::string& how = result.metadata["weft:postprocess"];
        how += (how.empty() ? "" : ", ") + applied.how;
    } catch (InputError const& e) {
        throw InputError(job.where, e.what());
    }
    return result;
}

} // namespace weft::post
