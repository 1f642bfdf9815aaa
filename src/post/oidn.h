// Intel Open Image Denoise, where the system has it: looked for while the program runs, so that
// neither building nor running Weft needs it. Its C interface is stable since version 1.0; two
// functions changed their names in version 2, and either name will do.
//
// Left out: its devices for GPUs. The device is the CPU, which reads the pictures where they are.
#pragma once

#include "post/denoise.h"

namespace weft::post {

/// The library, loaded; it stays loaded until the program ends, since its threads may.
class OidnLibrary {
  public:
    /// Loads the first of `names` that the dynamic linker finds and that has all functions. Where
    /// none has, `*this` is false and `problem` says why.
    explicit OidnLibrary(std::vector<std::string> const& names);
    explicit operator bool() const { return handle_ != nullptr; }
    std::string const& problem() const { return problem_; }
    /// Returns a function of the library, or null where it has none of this name.
    void* function(char const* name) const;

  private:
    void* handle_ = nullptr;
    std::string problem_;
};

/// Denoises a picture. At `high` quality albedo and normal, where both are given, are denoised
/// first, as the library's documentation advises (version 1.4 or newer). Throws InputError with the
/// library's message where it fails. `memory` is in megabytes.
image::Image denoise_oidn(OidnLibrary const& library, DenoiseInput const& input, Quality quality,
                          int memory);

} // namespace weft::post
