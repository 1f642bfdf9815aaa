#include "post/oidn.h"

#include <dlfcn.h>

#include <memory>

#include "image/layers.h"
#include "post/exposure.h"

namespace weft::post {

namespace {

// As in the library's header oidn.h.
struct Device;
struct Filter;
constexpr int kCpuDevice = 1, kFloat3 = 3;

struct Functions {
    Device* (*new_device)(int type);
    void (*commit_device)(Device*);
    int (*get_device_error)(Device*, char const** message);
    void (*release_device)(Device*);
    Filter* (*new_filter)(Device*, char const* type);
    void (*set_image)(Filter*, char const* name, void* data, int format, size_t width,
                      size_t height, size_t offset, size_t pixel_stride, size_t row_stride);
    void (*set_bool)(Filter*, char const* name, bool value);
    void (*set_int)(Filter*, char const* name, int value);
    void (*commit_filter)(Filter*);
    void (*execute_filter)(Filter*);
    void (*release_filter)(Filter*);
};

/// The names of each function: that of version 2 and, where it differs, that of version 1.
struct Names {
    char const *name, *older = nullptr;
};
constexpr Names kSetBool{"oidnSetFilterBool", "oidnSetFilter1b"},
    kSetInt{"oidnSetFilterInt", "oidnSetFilter1i"};
constexpr Names kNames[] = {{"oidnNewDevice"},
                            {"oidnCommitDevice"},
                            {"oidnGetDeviceError"},
                            {"oidnReleaseDevice"},
                            {"oidnNewFilter"},
                            {"oidnSetSharedFilterImage"},
                            kSetBool,
                            kSetInt,
                            {"oidnCommitFilter"},
                            {"oidnExecuteFilter"},
                            {"oidnReleaseFilter"}};

void* find(void* handle, Names const& names) {
    void* found = dlsym(handle, names.name);
    return found || !names.older ? found : dlsym(handle, names.older);
}

template <class F>
void assign(OidnLibrary const& library, Names const& names, F*& function) {
    void* found = library.function(names.name);
    if (!found && names.older) found = library.function(names.older);
    function = reinterpret_cast<F*>(found);
}

Functions functions_of(OidnLibrary const& library) {
    Functions f;
    assign(library, {"oidnNewDevice"}, f.new_device);
    assign(library, {"oidnCommitDevice"}, f.commit_device);
    assign(library, {"oidnGetDeviceError"}, f.get_device_error);
    assign(library, {"oidnReleaseDevice"}, f.release_device);
    assign(library, {"oidnNewFilter"}, f.new_filter);
    assign(library, {"oidnSetSharedFilterImage"}, f.set_image);
    assign(library, kSetBool, f.set_bool);
    assign(library, kSetInt, f.set_int);
    assign(library, {"oidnCommitFilter"}, f.commit_filter);
    assign(library, {"oidnExecuteFilter"}, f.execute_filter);
    assign(library, {"oidnReleaseFilter"}, f.release_filter);
    return f;
}

void set_image(Functions const& f, Filter* filter, char const* name, image::Image const& image) {
    // The library only reads what is called otherwise than "output".
    auto* data = const_cast<float*>(image.pixels.data());
    f.set_image(filter, name, data, kFloat3, size_t(image.width), size_t(image.height), 0,
                size_t(image.channels) * sizeof(float), 0);
}

void sanitise(image::Image& image) {
    for (float& x : image.pixels) x = sane(x);
}

} // namespace

OidnLibrary::OidnLibrary(std::vector<std::string> const& names) {
    for (std::string const& name : names) {
        void* handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
        char const* error = handle ? nullptr : dlerror();
        char const* lacking = nullptr;
        if (handle)
            for (Names const& n : kNames)
                if (!find(handle, n)) lacking = n.name;
        if (handle && !lacking) {
            handle_ = handle;
            return;
        }
        problem_ += (problem_.empty() ? "" : "; ") +
                    (lacking ? name + " has no function " + lacking
                             : std::string(error ? error : "cannot be loaded"));
    }
}

void* OidnLibrary::function(char const* name) const { return dlsym(handle_, name); }

namespace {

/// The device, and what to do with it.
class Denoiser {
  public:
    Denoiser(OidnLibrary const& library, int memory)
        : f_(functions_of(library)), memory_(memory),
          device_(f_.new_device(kCpuDevice), f_.release_device) {
        if (!device_) check(); // the error of a device that could not be made
        f_.commit_device(device_.get());
        check();
    }

    using Named = std::pair<char const*, image::Image const*>;

    /// `flags`: those that are true.
    image::Image run(std::vector<Named> const& inputs, std::vector<char const*> const& flags) {
        std::unique_ptr<Filter, void (*)(Filter*)> const filter(f_.new_filter(device_.get(), "RT"),
                                                                f_.release_filter);
        check();
        image::Image const& first = *inputs.front().second;
        image::Image result = image::make_image(first.width, first.height, 3);
        for (auto const& [name, image] : inputs) set_image(f_, filter.get(), name, *image);
        set_image(f_, filter.get(), "output", result);
        for (char const* flag : flags) f_.set_bool(filter.get(), flag, true);
        f_.set_int(filter.get(), "maxMemoryMB", memory_);
        f_.commit_filter(filter.get());
        check();
        f_.execute_filter(filter.get());
        check();
        return result;
    }

  private:
    void check() const {
        char const* message = nullptr;
        if (f_.get_device_error(device_.get(), &message) != 0)
            throw InputError(std::string("Open Image Denoise: ") +
                             (message ? message : "unknown error"));
    }

    Functions f_;
    int memory_;
    std::unique_ptr<Device, void (*)(Device*)> device_;
};

} // namespace

image::Image denoise_oidn(OidnLibrary const& library, DenoiseInput const& input, Quality quality,
                          int memory) {
    Denoiser denoiser(library, memory);
    image::Image color = image::take_channels(*input.color, {0, 1, 2}), albedo, normal;
    sanitise(color);
    std::vector<Denoiser::Named> inputs{{"color", &color}};
    std::vector<char const*> flags{"hdr"};
    if (input.albedo && input.normal && quality == Quality::high) {
        albedo = denoiser.run({{"albedo", input.albedo}}, {});
        normal = denoiser.run({{"normal", input.normal}}, {});
        inputs.insert(inputs.end(), {{"albedo", &albedo}, {"normal", &normal}});
        flags.push_back("cleanAux");
    } else if (input.albedo) {
        inputs.emplace_back("albedo", input.albedo);
        // It takes normals only beside albedo.
        if (input.normal) inputs.emplace_back("normal", input.normal);
    }
    image::Image result = denoiser.run(inputs, flags);
    sanitise(result);
    return result;
}

} // namespace weft::post
