#include "post/flip.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/color.h"

namespace weft::post {

namespace {

/// One number per pixel.
struct Plane {
    int width = 0, height = 0;
    std::vector<float> values;

    Plane(int w, int h) : width(w), height(h), values(size_t(w) * size_t(h)) {}
    float* row(int y) { return values.data() + size_t(y) * size_t(width); }
    float const* row(int y) const { return values.data() + size_t(y) * size_t(width); }
};

template <class F>
void for_rows(int height, F const& f) {
    tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](auto const& rows) {
        for (int y = rows.begin(); y != rows.end(); ++y) f(y);
    });
}

/// Weights at -radius ... radius.
using Kernel = std::vector<float>;

/// Filters along x, then along y; pixels beyond the border are those at the border.
Plane filter(Plane const& in, Kernel const& along_x, Kernel const& along_y) {
    Plane middle(in.width, in.height), out(in.width, in.height);
    int const rx = int(along_x.size()) / 2, ry = int(along_y.size()) / 2;
    for_rows(in.height, [&](int y) {
        for (int x = 0; x < in.width; ++x) {
            float sum = 0;
            for (int i = -rx; i <= rx; ++i)
                sum += along_x[size_t(i + rx)] * in.row(y)[std::clamp(x + i, 0, in.width - 1)];
            middle.row(y)[x] = sum;
        }
    });
    for_rows(in.height, [&](int y) {
        float* const to = out.row(y);
        for (int i = -ry; i <= ry; ++i) {
            float const* const from = middle.row(std::clamp(y + i, 0, in.height - 1));
            float const w = along_y[size_t(i + ry)];
            for (int x = 0; x < in.width; ++x) to[x] += w * from[x];
        }
    });
    return out;
}

/// exp(-x^2 / (2 deviation^2)) at whole pixels; `deviation` in pixels.
std::vector<double> gaussian(double deviation, int radius) {
    std::vector<double> g;
    for (int x = -radius; x <= radius; ++x)
        g.push_back(std::exp(-double(x) * x / (2 * deviation * deviation)));
    return g;
}

double sum_of(std::vector<double> const& values) {
    double sum = 0;
    for (double v : values) sum += v;
    return sum;
}

Kernel normalized(std::vector<double> const& g) {
    double const sum = sum_of(g);
    Kernel k;
    for (double v : g) k.push_back(float(v / sum));
    return k;
}

/// Positive weights scaled to the sum 1, negative ones to -1.
Kernel balanced(std::vector<double> const& g) {
    double positive = 0, negative = 0;
    for (double v : g) (v > 0 ? positive : negative) += v;
    Kernel k;
    for (double v : g) k.push_back(float(v > 0 ? v / positive : -v / negative));
    return k;
}

// The white point and matrix that FLIP is published with: sRGB's primaries, rounded differently.
constexpr std::array<double, 3> kWhite{0.950428545, 1.000000000, 1.088900371};
constexpr double kToXyz[3][3] = {{10135552 / 24577794., 8788810 / 24577794., 4435075 / 24577794.},
                                 {2613072 / 12288897., 8788810 / 12288897., 887015 / 12288897.},
                                 {1425312 / 73733382., 8788810 / 73733382., 70074185 / 73733382.}};
constexpr double kFromXyz[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                   {-0.969224334, 1.875930071, 0.041554224},
                                   {0.055639423, -0.204011202, 1.057148933}};

/// XYZ over the white's.
Vec3d relative_xyz(Color const& c) {
    Vec3d xyz;
    for (int i = 0; i < 3; ++i)
        xyz[i] = (kToXyz[i][0] * c.r + kToXyz[i][1] * c.g + kToXyz[i][2] * c.b) / kWhite[size_t(i)];
    return xyz;
}

/// YCxCz: CIELAB without its cube roots, so that blurring it blurs light.
struct Opponent {
    Plane y, cx, cz;
};

Opponent opponent_of(image::Image const& image) {
    Opponent o{
        {image.width, image.height}, {image.width, image.height}, {image.width, image.height}};
    bool const grey = image.channels < 3;
    for_rows(image.height, [&](int y) {
        for (int x = 0; x < image.width; ++x) {
            auto channel = [&](int c) {
                float const v = image.at(x, y, grey ? 0 : c);
                return v > 0 ? std::min(v, 1.f) : 0.f;
            };
            Vec3d const w = relative_xyz({channel(0), channel(1), channel(2)});
            o.y.row(y)[x] = float(116 * w.y - 16);
            o.cx.row(y)[x] = float(500 * (w.x - w.y));
            o.cz.row(y)[x] = float(200 * (w.y - w.z));
        }
    });
    return o;
}

/// The contrast sensitivity of one channel as one or two Gaussians: each of the weight
/// a sqrt(pi / b) and the shape exp(-pi^2 x^2 / b), x in degrees (table 1 of the paper).
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kAchromatic{1, 0.0047, 0, 1}, kRedGreen{1, 0.0053, 0, 1},
    kBlueYellow{34.1, 0.04, 13.5, 0.025};

Plane blurred(Plane const& in, Sensitivity const& s, double pixels_per_degree) {
    int const radius =
        int(std::ceil(3 * std::sqrt(kBlueYellow.b1 / (2 * M_PI * M_PI)) * pixels_per_degree));
    auto shape = [&](double b) {
        return gaussian(std::sqrt(b / 2) / M_PI * pixels_per_degree, radius);
    };
    std::vector<double> const g1 = shape(s.b1);
    Plane out = filter(in, normalized(g1), normalized(g1));
    if (s.a2 == 0) return out;
    std::vector<double> const g2 = shape(s.b2);
    double const w1 = s.a1 * std::sqrt(M_PI / s.b1) * sum_of(g1) * sum_of(g1);
    double const w2 = s.a2 * std::sqrt(M_PI / s.b2) * sum_of(g2) * sum_of(g2);
    Plane const second = filter(in, normalized(g2), normalized(g2));
    for (size_t i = 0; i < out.values.size(); ++i)
        out.values[i] = float((w1 * out.values[i] + w2 * second.values[i]) / (w1 + w2));
    return out;
}

/// CIELAB of relative XYZ, chroma scaled by Hunt's effect.
Vec3 hunt_lab(Vec3d const& xyz) {
    auto f = [](double t) {
        constexpr double delta = 6. / 29;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4. / 29;
    };
    double const fx = f(xyz.x), fy = f(xyz.y), fz = f(xyz.z), l = 116 * fy - 16;
    return {float(l), float(0.01 * l * 500 * (fx - fy)), float(0.01 * l * 200 * (fy - fz))};
}

float hyab(Vec3 const& a, Vec3 const& b) {
    Vec3 const d = a - b;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

/// What the blurred picture looks like on a screen, which shows nothing outside of [0, 1].
Vec3 seen(float y, float cx, float cz) {
    double const wy = (y + 16) / 116.;
    double const xyz[3] = {(wy + cx / 500.) * kWhite[0], wy * kWhite[1],
                           (wy - cz / 200.) * kWhite[2]};
    auto channel = [&](int i) {
        return float(std::clamp(
            kFromXyz[i][0] * xyz[0] + kFromXyz[i][1] * xyz[1] + kFromXyz[i][2] * xyz[2], 0., 1.));
    };
    return hunt_lab(relative_xyz({channel(0), channel(1), channel(2)}));
}

/// Errors of colour in [0, 1]: 95 % of the range for the nearer 40 % of the distances.
float redistributed(float distance) {
    static float const farthest =
        std::pow(hyab(hunt_lab(relative_xyz({0, 1, 0})), hunt_lab(relative_xyz({0, 0, 1}))), 0.7f);
    constexpr float near = 0.4f, share = 0.95f;
    float const d = std::pow(distance, 0.7f), knee = near * farthest;
    return d < knee ? share / knee * d : share + (d - knee) / (farthest - knee) * (1 - share);
}

Plane color_errors(Opponent const& a, Opponent const& b, double pixels_per_degree) {
    auto blur = [&](Opponent const& o) {
        return Opponent{blurred(o.y, kAchromatic, pixels_per_degree),
                        blurred(o.cx, kRedGreen, pixels_per_degree),
                        blurred(o.cz, kBlueYellow, pixels_per_degree)};
    };
    Opponent const p = blur(a), q = blur(b);
    Plane out(a.y.width, a.y.height);
    for_rows(out.height, [&](int y) {
        for (int x = 0; x < out.width; ++x)
            out.row(y)[x] =
                redistributed(hyab(seen(p.y.row(y)[x], p.cx.row(y)[x], p.cz.row(y)[x]),
                                   seen(q.y.row(y)[x], q.cx.row(y)[x], q.cz.row(y)[x])));
    });
    return out;
}

/// How strong an edge, or a point, is at each pixel.
struct Features {
    Plane edges, points;
};

Features features_of(Plane const& y, double pixels_per_degree) {
    double const deviation = 0.5 * 0.082 * pixels_per_degree; // of the eye's edge detectors
    int const radius = int(std::ceil(3 * deviation));
    std::vector<double> const g = gaussian(deviation, radius);
    std::vector<double> first = g, second = g;
    for (int x = -radius; x <= radius; ++x) {
        first[size_t(x + radius)] *= -x;
        second[size_t(x + radius)] *= x * x / (deviation * deviation) - 1;
    }
    Plane achromatic = y;
    for (float& v : achromatic.values) v = (v + 16) / 116;
    auto magnitude = [&](Kernel const& derivative) {
        Plane dx = filter(achromatic, derivative, normalized(g));
        Plane const dy = filter(achromatic, normalized(g), derivative);
        for (size_t i = 0; i < dx.values.size(); ++i)
            dx.values[i] = std::hypot(dx.values[i], dy.values[i]);
        return dx;
    };
    return {magnitude(balanced(first)), magnitude(balanced(second))};
}

void check_sizes(image::Image const& a, image::Image const& b) {
    if (a.width == b.width && a.height == b.height && (a.channels < 3) == (b.channels < 3)) return;
    auto size = [](image::Image const& i) {
        return std::to_string(i.width) + " x " + std::to_string(i.height) + " pixels of " +
               (i.channels < 3 ? "grey" : "colour");
    };
    throw InputError("images differ in shape: expected " + size(a) + ", found " + size(b));
}

float luminance_at(image::Image const& image, size_t pixel) {
    float const* const p = &image.pixels[pixel * size_t(image.channels)];
    float const y = image.channels < 3 ? p[0] : luminance({p[0], p[1], p[2]});
    return std::isfinite(y) && y > 0 ? y : 0;
}

/// Narkowicz 2016, without his exposure of 0.6.
struct Curve {
    static constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03, k3 = 0.6 * 0.6 * 2.43,
                            k4 = 0.6 * 0.59, k5 = 0.14;

    static float of(double x) {
        return float(std::clamp((k0 * x * x + k1 * x) / (k3 * x * x + k4 * x + k5), 0., 1.));
    }
    /// The light that becomes `t`.
    static double inverse(double t) {
        double const a = k0 - k3 * t, half = 0.5 * (k1 - k4 * t) / a, c = -k5 * t / a;
        return -half + std::sqrt(half * half - c);
    }
};

image::Image tone_mapped(image::Image const& image, float exposure) {
    image::Image result = image;
    double const gain = std::exp2(double(exposure));
    for (float& x : result.pixels) x = std::isfinite(x) && x > 0 ? Curve::of(gain * x) : 0;
    return result;
}

} // namespace

image::Image ldr_flip(image::Image const& reference, image::Image const& test,
                      float pixels_per_degree) {
    check_sizes(reference, test);
    Opponent const a = opponent_of(reference), b = opponent_of(test);
    Plane const colors = color_errors(a, b, pixels_per_degree);
    Features const fa = features_of(a.y, pixels_per_degree);
    Features const fb = features_of(b.y, pixels_per_degree);
    image::Image errors = image::make_image(reference.width, reference.height, 1);
    for (size_t i = 0; i < errors.pixels.size(); ++i) {
        float const feature = std::max(std::abs(fa.edges.values[i] - fb.edges.values[i]),
                                       std::abs(fa.points.values[i] - fb.points.values[i]));
        float const exponent = 1 - std::sqrt(std::min(feature / std::sqrt(2.f), 1.f));
        errors.pixels[i] = std::clamp(std::pow(colors.values[i], exponent), 0.f, 1.f);
        // pow(0, 0) is 1, but what has no error of colour has none.
        if (colors.values[i] == 0) errors.pixels[i] = 0;
    }
    return errors;
}

HdrFlip hdr_flip(image::Image const& reference, image::Image const& test, float pixels_per_degree) {
    check_sizes(reference, test);
    std::vector<float> light;
    for (size_t i = 0; i < size_t(reference.width) * size_t(reference.height); ++i)
        light.push_back(luminance_at(reference, i));
    auto const middle = light.begin() + std::ptrdiff_t(light.size() / 2);
    std::nth_element(light.begin(), middle, light.end());
    double const median = std::max(*middle, std::numeric_limits<float>::epsilon());
    double const brightest = *std::max_element(middle, light.end());
    HdrFlip result;
    if (brightest > 0) {
        double const near_white = Curve::inverse(0.85);
        result.start = float(std::log2(near_white / brightest));
        result.stop = float(std::log2(near_white / median));
    }
    result.exposures = std::max(2, int(std::ceil(result.stop - result.start)));
    result.errors = image::make_image(reference.width, reference.height, 1);
    for (int i = 0; i < result.exposures; ++i) {
        float const exposure =
            lerp(result.start, result.stop, float(i) / float(result.exposures - 1));
        image::Image const errors = ldr_flip(tone_mapped(reference, exposure),
                                             tone_mapped(test, exposure), pixels_per_degree);
        for (size_t p = 0; p < errors.pixels.size(); ++p)
            result.errors.pixels[p] = std::max(result.errors.pixels[p], errors.pixels[p]);
    }
    return result;
}

double mean_error(image::Image const& errors) {
    double sum = 0;
    for (float e : errors.pixels) sum += e;
    return errors.pixels.empty() ? 0 : sum / double(errors.pixels.size());
}

} // namespace weft::post
