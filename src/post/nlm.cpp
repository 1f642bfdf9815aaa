#include "post/nlm.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "post/exposure.h"

namespace weft::post {

namespace {

constexpr int kTile = 64;
constexpr int kSearch = 8;  ///< radius of the window in which pixels are averaged
constexpr int kPatch = 2;   ///< radius of the patches that are compared
constexpr int kNoise = 3;   ///< radius of the window of the noise estimate
constexpr int kOutlier = 2; ///< radius of the window in which outliers are told
/// Patches of the window's pixels; their noise, and the high pass under it, of what has no
/// outliers.
constexpr int kHalo = kSearch + kPatch + kNoise + 1 + kOutlier;
constexpr int kSide = kTile + 2 * kHalo;

constexpr float kStrength = 0.6f;     ///< k_c of the paper: larger is smoother
constexpr float kMostDifference = 40; ///< of one pixel of a patch, in units of the noise
/// The two pixels themselves must not differ by more than noise hardly ever does.
constexpr float kPointwise = 12;
constexpr float kAlbedoScale = 0.04f, kNormalScale = 0.15f;
/// What is darker is not divided by its own albedo: where an emitter, which has none, meets a
/// surface, that would blow up small differences.
constexpr float kLeastAlbedo = 0.2f;
constexpr float kMostSummedLight = 1e30f; ///< sums of it stay finite
constexpr float kLeastOwnWeight = 0.03f;

using TilePlane = std::vector<float>; ///< kSide x kSide

/// What is known about a tile and the pixels around it.
struct TileData {
    std::array<TilePlane, 3> light; ///< colour over albedo
    std::array<TilePlane, 3> logs;  ///< its logarithm, in which patches are compared
    TilePlane variance;             ///< of the noise in `logs`
    std::array<TilePlane, 3> albedo, normal;
    TilePlane difference, row_sums, pointwise; ///< scratch

    TileData() {
        for (auto* planes : {&light, &logs, &albedo, &normal})
            for (TilePlane& p : *planes) p.assign(size_t(kSide) * kSide, 0.f);
        for (TilePlane* p : {&variance, &difference, &row_sums, &pointwise})
            p->assign(size_t(kSide) * kSide, 0.f);
    }
};

constexpr size_t at(int x, int y) { return size_t(y) * kSide + size_t(x); }

/// Reads with the border's pixels repeated outside of the picture.
void load(DenoiseInput const& input, int x0, int y0, TileData& tile) {
    image::Image const& color = *input.color;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            int const px = std::clamp(x0 + x - kHalo, 0, color.width - 1),
                      py = std::clamp(y0 + y - kHalo, 0, color.height - 1);
            for (int c = 0; c < 3; ++c) {
                size_t const i = at(x, y), k = size_t(c);
                if (input.albedo)
                    tile.albedo[k][i] = std::min(sane(input.albedo->at(px, py, c)), 1.f);
                if (input.normal) {
                    float const n = input.normal->at(px, py, c);
                    tile.normal[k][i] = std::isfinite(n) ? std::clamp(n, -1.f, 1.f) : 0.f;
                }
                float const albedo = input.albedo ? std::max(tile.albedo[k][i], kLeastAlbedo) : 1.f;
                tile.light[k][i] = std::min(sane(color.at(px, py, c)), kMostSummedLight) / albedo;
            }
        }
}

/// The squared difference of the features of two pixels, in units of what tells surfaces apart.
float feature_distance(TileData const& tile, size_t p, size_t q) {
    float albedo = 0, normal = 0;
    for (size_t c = 0; c < 3; ++c) {
        float const a = tile.albedo[c][p] - tile.albedo[c][q],
                    n = tile.normal[c][p] - tile.normal[c][q];
        albedo += a * a;
        normal += n * n;
    }
    return std::max(albedo / (kAlbedoScale * kAlbedoScale), normal / (kNormalScale * kNormalScale));
}

/// Brings down what outshines all but two of the pixels of its surface around it more than
/// threefold. A surface of which little is seen, as a small lamp, stays as it is.
void remove_outliers(TileData& tile) {
    constexpr float kTooBright = 3;
    constexpr int kEnough = 8; // of 24
    TilePlane& luminance = tile.difference;
    for (size_t i = 0; i < luminance.size(); ++i)
        luminance[i] =
            0.2126f * tile.light[0][i] + 0.7152f * tile.light[1][i] + 0.0722f * tile.light[2][i];
    for (int y = kOutlier; y < kSide - kOutlier; ++y)
        for (int x = kOutlier; x < kSide - kOutlier; ++x) {
            size_t const i = at(x, y);
            std::array<float, 3> brightest{};
            int alike = 0;
            for (int dy = -kOutlier; dy <= kOutlier; ++dy)
                for (int dx = -kOutlier; dx <= kOutlier; ++dx) {
                    size_t const q = at(x + dx, y + dy);
                    if ((dx == 0 && dy == 0) || feature_distance(tile, i, q) > 4) continue;
                    ++alike;
                    float l = luminance[q];
                    for (float& b : brightest)
                        if (l > b) std::swap(l, b);
                }
            float const limit = kTooBright * brightest[2];
            if (alike >= kEnough && luminance[i] > limit)
                for (TilePlane& light : tile.light) light[i] *= limit / luminance[i] / kTooBright;
        }
}

void estimate_noise(float exposure, TileData& tile) {
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < tile.light[c].size(); ++i)
            tile.logs[c][i] = std::log1p(exposure * tile.light[c][i]);
    TilePlane &mean = tile.difference, &residual = tile.row_sums;
    for (size_t i = 0; i < mean.size(); ++i)
        mean[i] = (tile.logs[0][i] + tile.logs[1][i] + tile.logs[2][i]) / 3;
    for (int y = 1; y < kSide - 1; ++y)
        for (int x = 1; x < kSide - 1; ++x) {
            float around = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    if (dx != 0 || dy != 0) around += mean[at(x + dx, y + dy)];
            residual[at(x, y)] = std::abs(mean[at(x, y)] - around / 8);
        }
    // The deviation of a normal distribution from its median absolute deviation, and from that of
    // the difference to the mean of eight.
    float const scale = 1.4826f / std::sqrt(9.f / 8);
    constexpr int kBorder = kNoise + 1, kCount = (2 * kNoise + 1) * (2 * kNoise + 1);
    std::array<float, kCount> window;
    for (int y = kBorder; y < kSide - kBorder; ++y)
        for (int x = kBorder; x < kSide - kBorder; ++x) {
            size_t n = 0;
            for (int dy = -kNoise; dy <= kNoise; ++dy)
                for (int dx = -kNoise; dx <= kNoise; ++dx)
                    window[n++] = residual[at(x + dx, y + dy)];
            std::nth_element(window.begin(), window.begin() + kCount / 2, window.end());
            float const sigma = scale * window[kCount / 2];
            tile.variance[at(x, y)] = sigma * sigma;
        }
}

/// Sums of weights and weighted light of one tile.
struct Sums {
    std::array<std::array<float, 3>, size_t(kTile) * kTile> light{};
    std::array<float, size_t(kTile) * kTile> weight{};
    std::array<float, size_t(kTile) * kTile> largest{}; ///< of the other pixels
};

/// The differences of all pixels of the tile to those `offset` further, in `tile.pointwise`, and of
/// their patches, times a patch's pixels, in `tile.difference`.
void patch_differences(TileData& tile, int offset_x, int offset_y) {
    constexpr int kFrom = kHalo - kPatch, kTo = kHalo + kTile + kPatch;
    constexpr float kTiny = 1e-6f; ///< where there is no noise
    int64_t const shift = int64_t(offset_y) * kSide + offset_x;
    for (int y = kFrom; y < kTo; ++y)
        for (int x = kFrom; x < kTo; ++x) {
            size_t const p = at(x, y), q = size_t(int64_t(p) + shift);
            float squares = 0;
            for (size_t c = 0; c < 3; ++c) {
                float const d = tile.logs[c][p] - tile.logs[c][q];
                squares += d * d;
            }
            float const vp = tile.variance[p], vq = tile.variance[q];
            float const difference = (squares / 3 - (vp + std::min(vp, vq))) /
                                     (kTiny + kStrength * kStrength * (vp + vq));
            tile.pointwise[p] = difference;
            tile.difference[p] = std::min(difference, kMostDifference);
        }
    for (int y = kFrom; y < kTo; ++y)
        for (int x = kHalo; x < kHalo + kTile; ++x) {
            float sum = 0;
            for (int d = -kPatch; d <= kPatch; ++d) sum += tile.difference[at(x + d, y)];
            tile.row_sums[at(x, y)] = sum;
        }
    for (int y = kHalo; y < kHalo + kTile; ++y)
        for (int x = kHalo; x < kHalo + kTile; ++x) {
            float sum = 0;
            for (int d = -kPatch; d <= kPatch; ++d) sum += tile.row_sums[at(x, y + d)];
            tile.difference[at(x, y)] = sum;
        }
}

void add_offset(TileData& tile, int offset_x, int offset_y, Sums& sums) {
    patch_differences(tile, offset_x, offset_y);
    constexpr float kPixels = (2 * kPatch + 1) * (2 * kPatch + 1);
    int64_t const shift = int64_t(offset_y) * kSide + offset_x;
    for (int y = 0; y < kTile; ++y)
        for (int x = 0; x < kTile; ++x) {
            size_t const p = at(x + kHalo, y + kHalo), q = size_t(int64_t(p) + shift);
            float const distance =
                std::max({0.f, tile.difference[p] / kPixels, tile.pointwise[p] / kPointwise,
                          feature_distance(tile, p, q)});
            // exp(-16) counts for nothing, and most pixels are further away.
            if (distance > 16) continue;
            float const weight = std::exp(-distance);
            size_t const i = size_t(y) * kTile + size_t(x);
            for (size_t c = 0; c < 3; ++c) sums.light[i][c] += weight * tile.light[c][q];
            sums.weight[i] += weight;
            sums.largest[i] = std::max(sums.largest[i], weight);
        }
}

void denoise_tile(DenoiseInput const& input, float exposure, int x0, int y0, TileData& tile,
                  image::Image& to) {
    load(input, x0, y0, tile);
    remove_outliers(tile);
    estimate_noise(exposure, tile);
    auto const sums = std::make_unique<Sums>();
    for (int dy = -kSearch; dy <= kSearch; ++dy)
        for (int dx = -kSearch; dx <= kSearch; ++dx)
            if (dx != 0 || dy != 0) add_offset(tile, dx, dy, *sums);
    for (int y = 0; y < std::min(kTile, to.height - y0); ++y)
        for (int x = 0; x < std::min(kTile, to.width - x0); ++x) {
            size_t const i = size_t(y) * kTile + size_t(x), p = at(x + kHalo, y + kHalo);
            // The pixel itself counts as much as its nearest relative: its own weight, 1, says
            // nothing about its noise. Where nothing is like it it counts for itself.
            float const own = std::max(sums->largest[i], kLeastOwnWeight);
            for (int c = 0; c < 3; ++c) {
                size_t const k = size_t(c);
                float const albedo = input.albedo ? std::max(tile.albedo[k][p], kLeastAlbedo) : 1.f;
                to.at(x0 + x, y0 + y, c) =
                    albedo * (sums->light[i][k] + own * tile.light[k][p]) / (sums->weight[i] + own);
            }
        }
}

} // namespace

image::Image denoise_nlm(DenoiseInput const& input) {
    image::Image const& color = *input.color;
    image::Image result = image::make_image(color.width, color.height, 3);
    float const exposure = auto_exposure(color);
    auto tiles = [](int size) { return (size + kTile - 1) / kTile; };
    tbb::parallel_for(tbb::blocked_range2d<int>(0, tiles(color.height), 0, tiles(color.width)),
                      [&](tbb::blocked_range2d<int> const& range) {
                          TileData tile;
                          for (int y = range.rows().begin(); y < range.rows().end(); ++y)
                              for (int x = range.cols().begin(); x < range.cols().end(); ++x)
                                  denoise_tile(input, exposure, x * kTile, y * kTile, tile, result);
                      });
    return result;
}

} // namespace weft::post
