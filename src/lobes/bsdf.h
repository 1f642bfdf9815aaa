// A BSDF as a flat list of weighted lobes, each around one of a few shading frames.
//
// Most surfaces have one frame. A layer with a normal map of its own adds another, and so does a
// highlight that is stretched along a turned axis, and a fibre. `use_frame` chooses the frame of
// the lobes that are added after it.
//
// Materials add lobes, and `prepare` decides how often each is picked. `sample` picks one, samples
// it, and then evaluates the *whole* list, so that value and density cannot disagree (single-sample
// MIS with the balance heuristic, Veach 1997, 9.2.4). Delta lobes have no value that `eval` could
// add, so `sample` returns the one it picked alone.
//
// Shading normals do not let light leak through the surface. Light that is reflected stays on wo's
// side of the surface, and light that is transmitted leaves it (Veach 1997, 5.3, lets the shading
// normal decide). `BentNormals` says what becomes of light that a bent normal sends elsewhere.
#pragma once

#include <cassert>
#include <memory>
#include <variant>

#include "base/frame.h"
#include "base/match.h"
#include "lobes/burley_diffuse.h"
#include "lobes/clearcoat.h"
#include "lobes/diffuse_transmission.h"
#include "lobes/disney_sheen.h"
#include "lobes/hair.h"
#include "lobes/lambert.h"
#include "lobes/microfacet_dielectric.h"
#include "lobes/microfacet_reflection.h"
#include "lobes/oren_nayar.h"
#include "lobes/sheen.h"
#include "lobes/specular_dielectric.h"
#include "lobes/specular_reflection.h"
#include "lobes/subsurface_diffuse.h"
#include "lobes/thin_transmission.h"
#include "lobes/transparent.h"

namespace weft::lobes {

/// Every kind of lobe. All are trivially copyable and destructible.
using LobeVariant =
    std::variant<Lambert, SpecularReflection, SpecularDielectric, GgxReflection, BeckmannReflection,
                 AshikhminShirleyReflection, GgxDielectric, BeckmannDielectric,
                 AshikhminShirleyDielectric, OrenNayar, BurleyDiffuse, DiffuseTransmission,
                 Transparent, Sheen, DisneySheen, Clearcoat, Hair, SubsurfaceDiffuse,
                 GgxThinTransmission, BeckmannThinTransmission, AshikhminShirleyThinTransmission>;

struct Lobe {
    Color weight;           ///< multiplies the kind's value
    float pick = 1;         ///< probability that `Bsdf::sample` picks it
    uint8_t frame = 0;      ///< index of the frame it lies around
    bool looked_up = false; ///< `albedo` is known
    uint16_t layer = 0;     ///< of the material, for pictures by layer; 0: of none with a name
    Color albedo{};         ///< of `kind`, for the wo that the list is made for
    LobeVariant kind;
};

inline LobeFlags flags_of(Lobe const& lobe) {
    return match(lobe.kind, [](auto const& l) { return l.flags(); });
}
/// How wide the lobe is, in [0, 1]; see lobe.h.
inline float width_of(Lobe const& lobe) {
    return match(lobe.kind, [](auto const& l) { return l.width(); });
}

/// What becomes of light that a bent normal sends to the wrong side of the surface.
enum class BentNormals : uint8_t {
    /// It is lost, as in most renderers.
    Dropped,
    /// It is lost, and what is near to that fades out where the surface scatters diffusely: Chiang,
    /// Li and Burley 2019, "Taming the shadow terminator".
    Softened,
    /// It is *folded*: mirrored at the surface's tangent plane, as if the surface had scattered it
    /// once more. The value for wi is then f(wi) + f(fold wi), each counted where its own side is
    /// right. Mirroring keeps solid angles, so that no lobe loses power: a bent white mirror is
    /// white. The price is reciprocity, which shading normals break anyway.
    Folded
};

/// What a lobe lies around.
struct LobeFrame {
    Frame shading; ///< n is on wo's side
    /// Unit, on wo's side: the surface's normal, which tells reflection from transmission.
    Vec3 ng{0, 0, 1};
    BentNormals bent = BentNormals::Dropped;

    friend bool operator==(LobeFrame const&, LobeFrame const&) = default;
};

struct BsdfSample {
    Vec3 wi{0, 0, 0};
    Color weight;          ///< f |cos wi| / pdf
    float pdf = 0;         ///< per solid angle, or a probability for Delta; 0 means failure
    Scattering scattering; ///< the kind of the lobe picked, and the side of wi
    float eta_scale = 1;   ///< eta^2 of the lobe picked if it transmitted, else 1
    uint16_t layer = 0;    ///< of the lobe picked
};

class Bsdf {
  public:
    /// Sixteen layers of four lobes each. Whoever makes lists must know that theirs fit: a lobe too
    /// many ends the program.
    static constexpr int capacity = 64;

    /// An empty list around one frame, n of which is on wo's side. The room for lobes stays
    /// uninitialised: what is not used costs no time.
    explicit Bsdf(LobeFrame const& frame) { frames_[0] = frame; }
    Bsdf(Bsdf const& o) { copy(o); }
    Bsdf& operator=(Bsdf const& o) {
        if (this != &o) copy(o);
        return *this;
    }

    /// Returns the frame that the list was made with: that of the surface itself.
    Frame const& frame() const { return frames_[0].shading; }
    BentNormals bent_normals() const { return frames_[0].bent; }
    /// Returns the frame of a lobe of this list.
    Frame const& frame(Lobe const& lobe) const { return frames_[lobe.frame].shading; }

    /// Lobes added from here on lie around `shading`, whose n is on wo's side, of the surface
    /// itself. Frames that no lobe lies around take no room.
    void use_frame(Frame const& shading) { use_frame({shading, frames_[0].ng, frames_[0].bent}); }
    /// The same for lobes of something else than the surface: a fibre has a geometric normal of its
    /// own.
    void use_frame(LobeFrame const& frame) {
        for (current_frame_ = 0; current_frame_ < frame_count_; ++current_frame_)
            if (frames_[current_frame_] == frame) return;
        frames_[frame_count_] = frame;
    }

    /// Appends an alternative of LobeVariant, or a LobeVariant; weights are >= 0. A black weight
    /// adds nothing. Ends the program where there is no room.
    template <class L>
    void add(Color const& weight, L const& kind, uint16_t layer = 0) {
        if (!is_black(weight)) append(weight, kind, layer);
    }
    /// The same for a lobe that has been prepared for wo by `look_up_albedo`, which gave `albedo`.
    template <class L>
    void add_looked_up(Color const& weight, L const& kind, uint16_t layer, Color const& albedo) {
        if (is_black(weight)) return;
        Lobe& lobe = append(weight, kind, layer);
        lobe.albedo = albedo;
        lobe.looked_up = true;
    }

    /// Shares out the picks by albedo as seen from `wo` (world space), and looks up what lobes need
    /// of tables for it. Call it between the last `add` and the first `sample` or `eval`, which are
    /// then for this wo alone.
    void prepare(Vec3 const& wo);

    /// Returns the sum over the smooth lobes, and the density with which `sample` gives wi. Both
    /// directions are unit vectors in world space.
    /// Not inlined, so that `sample` gives the same bits.
    [[gnu::noinline]] LobeValue eval(Vec3 const& wo, Vec3 const& wi) const;

    /// Calls f(lobe, value) for each lobe, with its share of `eval(wo, wi).f`.
    template <class F>
    void for_each_value(Vec3 const& wo, Vec3 const& wi, F&& f) const {
        for (int i = 0; i < count_; ++i) f(lobes_[i], eval_one(i, wo, wi).f);
    }
    /// Returns whether wi is on wo's side of the surface.
    bool reflects(Vec3 const& wi) const { return dot(wi, frames_[0].ng) > 0; }

    /// Returns what `eval` would if the list had only the lobes of one part (see kParts): that of
    /// the kind `part`.
    LobeValue eval_part(Vec3 const& wo, Vec3 const& wi, ScatteringKind part) const;

    /// Picks a lobe by u.z and samples it by u.x, u.y and what the pick leaves of u.z; u in
    /// [0, 1)^3. With `by_part`, value and density are those of `eval_part` for the picked lobe's
    /// part, as if each part were sampled by itself.
    BsdfSample sample(Vec3 const& wo, Vec3 const& u, bool by_part = false) const;

    /// Removes all lobes that are neither diffuse nor straight.
    void keep_diffuse();

    /// Returns the fraction of power that is scattered, in all directions together, per channel;
    /// see lobe.h. Microfacet lobes answer from tables.
    Color albedo(Vec3 const& wo) const;

    /// Returns the fraction of light that goes straight through.
    Color straight() const {
        Color sum;
        for (int i = 0; i < count_; ++i)
            if (flags_of(lobes_[i]).kind == ScatteringKind::Straight) sum += lobes_[i].weight;
        return sum;
    }

    int size() const { return count_; }
    Lobe const& operator[](int i) const { return lobes_[i]; }
    Sides sides() const { return sides_; } ///< the union over all lobes
    /// Returns whether `eval` can be other than black: only then does light sampling make sense.
    bool has_smooth() const { return smooth_sides_ != Sides::None; }

  private:
    /// A run of lobes that share a frame.
    struct Span {
        int begin, end;
        LobeFrame const& frame;
    };
    Span lobes_from(int first) const {
        int end = first + 1;
        while (end < count_ && lobes_[end].frame == lobes_[first].frame) ++end;
        return {first, end, frames_[lobes_[first].frame]};
    }

    template <class L>
    Lobe& append(Color const& weight, L const& kind, uint16_t layer) {
        if (count_ == capacity) [[unlikely]]
            no_room();
        frame_count_ = std::max(frame_count_, current_frame_ + 1);
        Lobe& lobe = *std::construct_at(&lobes_[count_++], Lobe{.weight = weight,
                                                                .frame = uint8_t(current_frame_),
                                                                .layer = layer,
                                                                .kind = LobeVariant(kind)});
        LobeFlags const flags = flags_of(lobe);
        add_sides(flags);
        return lobe;
    }
    [[noreturn]] static void no_room();
    void add_sides(LobeFlags const& flags) {
        sides_ |= flags.sides;
        if (!is_delta(flags.kind)) smooth_sides_ |= flags.sides;
    }

    /// Returns what the lobes of one frame send towards `wi`, as its `bent` has it.
    LobeValue eval_span(Span const& span, Vec3 const& wo, Vec3 const& wi) const;
    LobeValue eval_one(int i, Vec3 const& wo, Vec3 const& wi) const;
    /// Returns what they say in their own space; diffuse ones count by the part `fade`.
    LobeValue eval_local(Span const& span, Vec3 const& wo, Vec3 const& wi, float fade = 1) const;

    void copy(Bsdf const& o) {
        std::copy_n(o.frames_, std::max(o.frame_count_, o.current_frame_ + 1), frames_);
        frame_count_ = o.frame_count_;
        current_frame_ = o.current_frame_;
        std::uninitialized_copy_n(o.lobes_, o.count_, lobes_);
        count_ = o.count_;
        sides_ = o.sides_;
        smooth_sides_ = o.smooth_sides_;
    }

    int count_ = 0, frame_count_ = 1, current_frame_ = 0;
    Sides sides_{}, smooth_sides_{}; ///< of all lobes, and of those that `eval` adds up
    union {
        LobeFrame frames_[capacity + 2]; ///< the surface's, one per lobe, and one still unused
    };
    union {
        Lobe lobes_[capacity]; ///< the first count_ are alive
    };
};

} // namespace weft::lobes
