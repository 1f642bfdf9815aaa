// A library with the C interface of Open Image Denoise, which keeps a record of its calls and, for
// denoising, takes half of the colour (or of the guide where there is none). WEFT_FAKE_OLDER: with
// the names of version 1. WEFT_FAKE_LACKING: without one function. Where the file named by
// $WEFT_FAKE_OIDN_ERROR exists, the step that is its content fails.
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace {

struct Image {
    float* data;
    size_t width, height, stride;
};

std::map<std::string, Image> images;
std::ostringstream calls;
std::string text, failing;

void step(std::string const& name) {
    if (failing.empty())
        if (char const* file = std::getenv("WEFT_FAKE_OIDN_ERROR")) {
            std::string wanted;
            std::ifstream(file) >> wanted;
            if (wanted == name) failing = "cannot do " + name;
        }
}

} // namespace

extern "C" {

/// What was called so far; the record then begins anew.
char const* fake_oidn_calls() {
    text = calls.str();
    calls.str("");
    return text.c_str();
}

void* oidnNewDevice(int type) {
    calls << "device " << type << "\n";
    step("device");
    return failing.empty() ? &images : nullptr;
}
void oidnCommitDevice(void*) {
    calls << "commit device\n";
    step("commit-device");
}
int oidnGetDeviceError(void*, char const** message) {
    if (failing.empty()) return 0;
    text = failing;
    failing.clear();
    *message = text.c_str();
    return 2;
}
void oidnReleaseDevice(void*) { calls << "release device\n"; }
void* oidnNewFilter(void*, char const* type) {
    calls << "filter " << type << "\n";
    images.clear();
    return &calls;
}
void oidnSetSharedFilterImage(void*, char const* name, void* data, int format, size_t width,
                              size_t height, size_t offset, size_t pixel_stride,
                              size_t row_stride) {
    calls << name << " " << format << " " << width << "x" << height << " " << offset << " "
          << pixel_stride << " " << row_stride << "\n";
    images[name] = {static_cast<float*>(data), width, height, pixel_stride / sizeof(float)};
}
#ifdef WEFT_FAKE_OLDER
#define SET_BOOL oidnSetFilter1b
#define SET_INT oidnSetFilter1i
#else
#define SET_BOOL oidnSetFilterBool
#define SET_INT oidnSetFilterInt
#endif
void SET_BOOL(void*, char const* name, bool value) { calls << name << " " << value << "\n"; }
void SET_INT(void*, char const* name, int value) { calls << name << " " << value << "\n"; }
void oidnCommitFilter(void*) {
    calls << "commit\n";
    step("commit");
}
#ifndef WEFT_FAKE_LACKING
void oidnExecuteFilter(void*) {
    calls << "execute\n";
    step("execute");
    char const* const name = images.contains("color")    ? "color"
                             : images.contains("albedo") ? "albedo"
                                                         : "normal";
    Image const &from = images[name], &to = images["output"];
    for (size_t i = 0; i < from.width * from.height; ++i)
        for (size_t c = 0; c < 3; ++c)
            to.data[i * to.stride + c] = from.data[i * from.stride + c] / 2;
}
#endif
void oidnReleaseFilter(void*) { calls << "release filter\n"; }
}
