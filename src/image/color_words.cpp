#include "image/color_words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <lcms2.h>

#include "base/vec.h"
#include "image/input.h"

namespace weft::image {

namespace {

/// A matrix by its columns.
struct Columns {
    Vec3d x, y, z;

    Vec3d operator*(Vec3d const& v) const { return x * v.x + y * v.y + z * v.z; }
    Columns operator*(Columns const& o) const { return {*this * o.x, *this * o.y, *this * o.z}; }
    double determinant() const { return dot(x, cross(y, z)); }
    Columns inverse() const {
        double const d = 1 / determinant();
        Vec3d const a = cross(y, z) * d, b = cross(z, x) * d, c = cross(x, y) * d; // rows
        return {{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}};
    }
};

/// XYZ of luminance 1.
Vec3d xyz_of(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

Vec3d white_of(Primaries const& p) { return xyz_of(double(p[6]), double(p[7])); }

/// From linear RGB to XYZ, where white has luminance 1 (SMPTE RP 177). Chromaticities with y = 0,
/// as those of XYZ itself, are directions all the same.
Columns to_xyz(Primaries const& p) {
    auto direction = [&](size_t i) {
        double const x = double(p[i]), y = double(p[i + 1]);
        return Vec3d(x, y, 1 - x - y);
    };
    Columns const m{direction(0), direction(2), direction(4)};
    Vec3d const scale = m.inverse() * white_of(p);
    return {m.x * scale.x, m.y * scale.y, m.z * scale.z};
}

/// From colours that are white as `from` to colours that are white as `to`, both XYZ.
Columns adaptation(Vec3d const& from, Vec3d const& to) {
    Columns const cones{
        {0.8951, -0.7502, 0.0389}, {0.2664, 1.7135, -0.0685}, {-0.1614, 0.0367, 1.0296}};
    Vec3d const a = cones * from, b = cones * to;
    Columns const scale{{b.x / a.x, 0, 0}, {0, b.y / a.y, 0}, {0, 0, b.z / a.z}};
    return cones.inverse() * (scale * cones);
}

bool is_close(Primaries const& a, Primaries const& b) {
    for (size_t i = 0; i < a.size(); ++i)
        if (!(std::abs(a[i] - b[i]) < 2e-3f)) return false;
    return true;
}

std::string text_of(Primaries const& p) {
    std::string text;
    for (size_t i = 0; i < p.size(); ++i) {
        char number[24];
        std::snprintf(number, sizeof number, "%s%.4g",
                      i == 0  ? ""
                      : i % 2 ? ","
                              : " ",
                      double(p[i]));
        text += number;
    }
    return text;
}

ColorConversion times(std::array<float, 9> const& m) {
    return [m](std::span<float> rgb) {
        for (size_t i = 0; i + 3 <= rgb.size(); i += 3) {
            float const r = rgb[i], g = rgb[i + 1], b = rgb[i + 2];
            for (size_t k = 0; k < 3; ++k)
                rgb[i + k] = m[3 * k] * r + m[3 * k + 1] * g + m[3 * k + 2] * b;
        }
    };
}

ColorConversion one_after_other(ColorConversion first, ColorConversion then) {
    if (!first) return then;
    if (!then) return first;
    return [first = std::move(first), then = std::move(then)](std::span<float> rgb) {
        first(rgb);
        then(rgb);
    };
}

/// What a file says, before anyone asks whether it counts.
struct Words {
    std::string what; ///< for messages; "": nothing but what screens have
    std::optional<Transfer> transfer;
    ColorConversion convert;
    std::string why_not; ///< it cannot be followed
};

void say_primaries(Words& words, Primaries const& primaries) {
    auto const matrix = matrix_to_rec709(primaries);
    if (!matrix) {
        if (!is_close(primaries, kRec709Primaries)) {
            words.what = "primaries " + text_of(primaries);
            words.why_not = "they lie on a line";
        }
        return;
    }
    words.what += (words.what.empty() ? "" : " and ") + ("primaries " + text_of(primaries));
    words.convert = one_after_other(std::move(words.convert), times(*matrix));
}

// ---- ICC profiles -------------------------------------------------------------------------------

using Profile = std::unique_ptr<void, cmsBool (*)(void*)>;

/// Linear Rec. 709 with its own white, as a profile.
Profile linear_rec709() {
    cmsCIExyY const white{double(kRec709Primaries[6]), double(kRec709Primaries[7]), 1};
    auto at = [](size_t i) {
        return cmsCIExyY{double(kRec709Primaries[i]), double(kRec709Primaries[i + 1]), 1};
    };
    cmsCIExyYTRIPLE const primaries{at(0), at(2), at(4)};
    cmsToneCurve* const line = cmsBuildGamma(nullptr, 1);
    cmsToneCurve* const lines[]{line, line, line};
    Profile profile(cmsCreateRGBProfile(&white, &primaries, lines), cmsCloseProfile);
    cmsFreeToneCurve(line);
    return profile;
}

std::string name_of(cmsHPROFILE profile) {
    char text[128] = {};
    cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", text, sizeof text);
    return text;
}

/// Returns whether a conversion does with some colours what sRGB's own curve does.
bool is_srgb(cmsHTRANSFORM transform) {
    for (int i = 0; i < 27; ++i) {
        float const in[3]{float(i % 3) / 2, float(i / 3 % 3) / 2, float(i / 9) / 2};
        float out[3];
        cmsDoTransform(transform, in, out, 1);
        for (int k = 0; k < 3; ++k)
            if (!(std::abs(out[k] - srgb_to_linear(in[k])) < 4e-3f)) return false;
    }
    return true;
}

void say_profile(Words& words, std::span<uint8_t const> bytes, int channels) {
    Profile const profile(cmsOpenProfileFromMem(bytes.data(), uint32_t(bytes.size())),
                          cmsCloseProfile);
    words.what = "an ICC profile";
    if (!profile) {
        words.why_not = "it is damaged";
        return;
    }
    words.what += " '" + name_of(profile.get()) + "'";
    bool const grey = cmsGetColorSpace(profile.get()) == cmsSigGrayData;
    if ((!grey && cmsGetColorSpace(profile.get()) != cmsSigRgbData) || (!grey && channels < 3)) {
        words.why_not = "it is not for the channels of the file";
        return;
    }
    Profile const to = linear_rec709();
    std::shared_ptr<void> const transform(
        cmsCreateTransform(profile.get(), grey ? TYPE_GRAY_FLT : TYPE_RGB_FLT, to.get(),
                           TYPE_RGB_FLT, INTENT_RELATIVE_COLORIMETRIC,
                           cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE),
        [](void* t) {
            if (t) cmsDeleteTransform(t);
        });
    if (!transform) {
        words.why_not = "it cannot be turned into linear Rec. 709";
        return;
    }
    if (!grey && is_srgb(transform.get())) {
        words.what = "";
        return;
    }
    words.transfer = Transfer::linear;                  // the profile has the curve
    words.convert = [transform](std::span<float> rgb) { // of grey the first of three counts
        for (size_t i = 0; i + 3 <= rgb.size(); i += 3) {
            float const in[3]{rgb[i], rgb[i + 1], rgb[i + 2]};
            cmsDoTransform(transform.get(), in, &rgb[i], 1);
        }
    };
}

// ---- PNG ----------------------------------------------------------------------------------------

/// Returns the contents of the first chunk of that name before the pixels.
std::optional<std::string_view> chunk(std::string_view png, std::string_view name) {
    for (size_t at = 8; at + 12 <= png.size();) {
        auto const byte = [&](size_t i) { return uint32_t(uint8_t(png[at + i])); };
        size_t const length = byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
        std::string_view const found = png.substr(at + 4, 4);
        if (found == "IDAT" || length > png.size() - at - 12) return {};
        if (found == name) return png.substr(at + 8, length);
        at += 12 + length;
    }
    return {};
}

/// The i-th number of a chunk, in hundred thousandths.
float number(std::string_view chunk, size_t i) {
    uint32_t n = 0;
    for (size_t k = 0; k < 4; ++k) n = n << 8 | uint8_t(chunk[4 * i + k]);
    return float(n) * 1e-5f;
}

/// Coding-independent code points (ITU-T H.273), of those that pictures have.
void say_code_points(Words& words, std::string_view cicp) {
    int const primaries = uint8_t(cicp[0]), transfer = uint8_t(cicp[1]);
    words.what = "the code points " + std::to_string(primaries) + "/" + std::to_string(transfer);
    if (transfer != 13 && transfer != 1 && transfer != 8) {
        words.why_not = "their transfer function is not known here";
        return;
    }
    if (primaries != 1 && primaries != 9 && primaries != 12) {
        words.why_not = "their primaries are not known here";
        return;
    }
    if (transfer == 13) words.transfer = Transfer::srgb;
    if (transfer == 8) words.transfer = Transfer::linear;
    if (primaries == 1 && transfer != 8) words.what = ""; // what screens have
    if (primaries == 9)
        say_primaries(words, {0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f});
    if (primaries == 12)
        say_primaries(words, {0.680f, 0.320f, 0.265f, 0.690f, 0.150f, 0.060f, 0.3127f, 0.3290f});
}

void say_gamma(Words& words, float encoded) {
    float const gamma = 1 / encoded;
    if (std::abs(gamma - 2.2f) < 0.05f) return;
    char text[32];
    std::snprintf(text, sizeof text, "a gamma of %.3g", double(gamma));
    words.what = text;
    words.transfer = Transfer::linear;
    if (std::abs(gamma - 1) < 0.01f) return;
    words.convert = [gamma](std::span<float> rgb) {
        for (float& x : rgb) x = std::pow(std::max(x, 0.f), gamma);
    };
}

void say_png_chunks(Words& words, std::string_view png) {
    if (auto const cicp = chunk(png, "cICP"); cicp && cicp->size() == 4)
        return say_code_points(words, *cicp);
    if (chunk(png, "sRGB")) return;
    if (auto const gama = chunk(png, "gAMA"); gama && gama->size() == 4 && number(*gama, 0) > 0)
        say_gamma(words, number(*gama, 0));
    if (auto const chrm = chunk(png, "cHRM"); chrm && chrm->size() == 32) {
        // White comes first here.
        Primaries const p{number(*chrm, 2), number(*chrm, 3), number(*chrm, 4), number(*chrm, 5),
                          number(*chrm, 6), number(*chrm, 7), number(*chrm, 0), number(*chrm, 1)};
        if (!words.transfer && matrix_to_rec709(p)) words.transfer = Transfer::srgb;
        say_primaries(words, p);
    }
}

// -------------------------------------------------------------------------------------------------

Words words_of(OIIO::ImageSpec const& spec, std::string_view png) {
    Words words;
    bool const cicp = !png.empty() && chunk(png, "cICP");
    if (OIIO::ParamValue const* const icc = spec.find_attribute("ICCProfile");
        icc && icc->type().basetype == OIIO::TypeDesc::UINT8 && !cicp) {
        say_profile(words, {static_cast<uint8_t const*>(icc->data()), icc->type().size()},
                    spec.nchannels);
    } else if (!png.empty()) {
        say_png_chunks(words, png);
    } else if (OIIO::ParamValue const* const p = spec.find_attribute("chromaticities");
               p && p->type().basetype == OIIO::TypeDesc::FLOAT &&
               p->type().size() == sizeof(Primaries)) {
        Primaries primaries;
        std::memcpy(primaries.data(), p->data(), sizeof primaries);
        say_primaries(words, primaries);
    } else if (!is_srgb_encoded(spec)) {
        words.transfer = Transfer::linear;
    }
    return words;
}

ColorWords followed(Words words, Encoding encoding, Transfer usual) {
    ColorWords result{usual, {}, {}};
    if (!words.what.empty() && (encoding.stated || !words.why_not.empty()))
        result.warnings.push_back(
            "the file says that its colours have " + words.what + ", which is not followed: " +
            (encoding.stated ? "the scene states another colour space" : words.why_not));
    if (encoding.stated || !words.why_not.empty()) return result;
    if (words.transfer) result.transfer = *words.transfer;
    result.convert = std::move(words.convert);
    return result;
}

} // namespace

std::optional<std::array<float, 9>> matrix_to_rec709(Primaries const& primaries) {
    if (is_close(primaries, kRec709Primaries)) return {};
    bool const is_xyz = is_close(primaries, kXyzPrimaries);
    if (!(primaries[7] > 1e-3f)) return {};
    auto direction = [&](size_t i) {
        double const x = double(primaries[i]), y = double(primaries[i + 1]);
        return Vec3d(x, y, 1 - x - y);
    };
    double const area = dot(direction(0), cross(direction(2), direction(4)));
    if (!(std::abs(area) > 1e-6)) return {};
    Columns const from_xyz = to_xyz(kRec709Primaries).inverse();
    Columns m = from_xyz;
    if (!is_xyz)
        m = from_xyz *
            (adaptation(white_of(primaries), white_of(kRec709Primaries)) * to_xyz(primaries));
    std::array<float, 9> rows;
    for (size_t i = 0; i < 3; ++i) {
        Vec3d const& c = i == 0 ? m.x : i == 1 ? m.y : m.z;
        rows[i] = float(c.x);
        rows[3 + i] = float(c.y);
        rows[6 + i] = float(c.z);
    }
    return rows;
}

ColorWords color_words(OIIO::ImageSpec const& spec, std::string_view png, Encoding encoding) {
    auto const type = spec.format.basetype;
    bool const integers = type == OIIO::TypeDesc::UINT8 || type == OIIO::TypeDesc::UINT16;
    return followed(words_of(spec, png), encoding, integers ? encoding.transfer : Transfer::linear);
}

ColorWords color_words(std::array<float, 3> const& multiplied,
                       std::optional<Primaries> const& primaries, Encoding encoding) {
    Words words;
    if (multiplied != std::array<float, 3>{1, 1, 1}) {
        words.what = "been multiplied by an exposure";
        words.convert = [m = multiplied](std::span<float> rgb) {
            for (size_t i = 0; i < rgb.size(); ++i) rgb[i] /= m[i % 3];
        };
    }
    // Radiance's own primaries, which most writers mean who name none.
    if (primaries) say_primaries(words, *primaries);
    return followed(std::move(words), encoding, Transfer::linear);
}

} // namespace weft::image
