// Writes src/lobes/albedo_tables.h: directional albedos of the microfacet lobes on the grids of
// lobes/albedo.h, as 16-bit fractions. Run it again whenever distributions, shadowing or grids
// change:
//     g++ -std=c++20 -O2 -Isrc tools/make_albedo_tables.cpp -o make_albedo_tables
//     ./make_albedo_tables > src/lobes/albedo_tables.h
//
// A visible normal m drawn for wo weighs F(wo.m) G2 / G1(wo), so that the albedo is the mean of
// that over the unit square: here over a Hammersley set.
#include <cstdio>
#include <string>

#include "lobes/albedo.h"
#include "lobes/fresnel.h"

namespace {

using namespace weft;
using namespace weft::lobes;

constexpr uint32_t kSamples = 1 << 14;

Vec2 hammersley(uint32_t i) {
    uint32_t r = i;
    r = (r << 16) | (r >> 16);
    r = ((r & 0x00ff00ffu) << 8) | ((r & 0xff00ff00u) >> 8);
    r = ((r & 0x0f0f0f0fu) << 4) | ((r & 0xf0f0f0f0u) >> 4);
    r = ((r & 0x33333333u) << 2) | ((r & 0xccccccccu) >> 2);
    r = ((r & 0x55555555u) << 1) | ((r & 0xaaaaaaaau) >> 1);
    return {(float(i) + 0.5f) / kSamples, float(double(r) * 0x1p-32 + 0.5 / kSamples)};
}

/// `eta` = 0 stands for the white reflection.
template <class Distribution>
DielectricAlbedo integrate(float cos_o, float alpha, float eta) {
    // The ends of the axes stand for limits that the lobes themselves do not take.
    float const c = std::max(cos_o, 1e-4f), a = std::max(alpha, 1e-3f);
    Distribution const d{a, a};
    Vec3 const wo{safe_sqrt(1 - c * c), 0, c};
    float const sigma_o = d.projected_area(wo);
    double reflected = 0, transmitted = 0;
    for (uint32_t i = 0; i < kSamples; ++i) {
        Vec3 const m = d.sample_visible_normal(wo, hammersley(i));
        float const cos_m = dot(wo, m);
        if (!(cos_m > 0)) continue;
        float cos_t = 0;
        float const fresnel = eta > 0 ? fresnel_dielectric(cos_m, eta, cos_t) : 1.f;
        Vec3 const r = reflect(wo, m);
        if (r.z > 0) reflected += fresnel * shadowing_above(c, sigma_o, r.z, d.projected_area(r));
        if (!(fresnel < 1)) continue;
        Vec3 const t = refract(wo, m, cos_m, cos_t, eta);
        if (t.z < 0) {
            transmitted += (1 - fresnel) * shadowing_across(c, sigma_o, -t.z, d.projected_area(t));
        }
    }
    return {float(reflected / kSamples), float(transmitted / kSamples)};
}

/// Prints 16-bit fractions, comma after comma, in lines of at most 100 columns.
class Writer {
  public:
    void value(float fraction) {
        std::string const text = std::to_string(int(fraction * 65535 + 0.5f)) + ",";
        if (line_.size() + text.size() > 100) flush();
        line_ += text;
    }
    void flush() {
        if (!line_.empty()) std::printf("%s\n", line_.c_str());
        line_.clear();
    }

  private:
    std::string line_;
};

float node(int i, int nodes) { return float(i) / float(nodes - 1); }

template <class Distribution>
void write_tables(char const* name) {
    using namespace albedo_grid;
    Writer out;
    std::printf("inline constexpr uint16_t %s_reflection[] = {\n", name);
    for (int a = 0; a < alphas; ++a)
        for (int c = 0; c < cosines; ++c)
            out.value(
                integrate<Distribution>(cosine_at(node(c, cosines)), alpha_at(node(a, alphas)), 0)
                    .reflected);
    out.flush();
    std::printf("};\ninline constexpr uint16_t %s_dielectric[] = {\n", name);
    for (int leaving = 0; leaving < 2; ++leaving)
        for (int part = 0; part < 2; ++part)
            for (int e = 0; e < indices; ++e)
                for (int a = 0; a < alphas; ++a)
                    for (int c = 0; c < cosines; ++c) {
                        // Total reflection does not fade as the indices meet: it shrinks. The
                        // first node stands for that limit rather than for equal indices.
                        float const ratio = std::max(index_at(node(e, indices)), 1.001f);
                        float const u = node(c, cosines);
                        float const eta = leaving ? 1 / ratio : ratio;
                        float const cos_o = leaving ? leaving_cosine_at(u, eta) : cosine_at(u);
                        DielectricAlbedo const albedo =
                            integrate<Distribution>(cos_o, alpha_at(node(a, alphas)), eta);
                        out.value(part == 0 ? albedo.reflected : albedo.transmitted);
                    }
    out.flush();
    std::printf("};\n");
}

} // namespace

int main() {
    std::printf("// Written by tools/make_albedo_tables.cpp; see lobes/albedo.h for the axes.\n"
                "// clang-format off\n"
                "#pragma once\n\n"
                "#include <cstdint>\n\n"
                "namespace weft::lobes::albedo_tables {\n\n"
                "// In 1 / 65535. Reflection: [alpha][cosine]. Dielectric:\n"
                "// [entering, leaving][reflected, transmitted][index][alpha][cosine].\n");
    write_tables<Ggx>("ggx");
    write_tables<Beckmann>("beckmann");
    std::printf("\n} // namespace weft::lobes::albedo_tables\n");
}
