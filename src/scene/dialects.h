// What files of lightwave's students mean by their spellings: the rules that the declarations of
// the types name (schema/alias.h), and the words that several of them share.
//
// Sources are lightwave's scenes and exporter, and the parsers of teams whose renderers are public.
// Where two teams mean different things by one word, the more common one holds and the note says
// so.
#pragma once

#include "schema/alias.h"

namespace weft::scene::dialects {

using schema::Element;
using schema::Spelling;
using schema::Surroundings;

// Integrators.

/// `nee` and `mis` say which of three strategies finds light.
bool strategy_of_flags(Element& integrator, Surroundings const&);
/// `samplingmode` is the strategy in capitals.
bool strategy_of_mode(Element& integrator, Surroundings const&);
bool path_without_lights(Element& integrator, Surroundings const&);
/// `normals` is black where nothing is hit before it is remapped to grey, as `aov` has it.
bool normals_as_aov(Element& integrator, Surroundings const&);
bool bvh_as_aov(Element& integrator, Surroundings const&);
/// <integrator type="aov" variable="albedo">
bool albedo_as_integrator(Element& integrator, Surroundings const&);
/// A <scene> beside the integrator of a test that refers to it goes into the integrator.
bool scene_into_integrator(Element& test, Surroundings const&);

// Cameras.

/// The scale of an orthographic camera whose `fov` (degrees) says how wide it is at a distance
/// of 1.
std::optional<std::string> scale_of_fov(std::string_view text);
/// <texture name="bokeh" type="image" filename="..."/>
bool bokeh_file(Element& camera, Surroundings const&);

// Shapes and media. A density is per unit of the shape's own space: transforms change it.

/// <shape type="volume" density="..."> around another shape: that shape with a <volume>.
bool volume_shape(Element& instance, Surroundings const&);
/// The same around none: a medium that fills the scene.
bool volume_everywhere(Element& scene, Surroundings const&);
/// <bsdf type="volumebsdf"> beside a <medium>: no surface, but the colour of the medium.
bool albedo_into_medium(Element& instance, Surroundings const&);
/// <bsdf type="hg" g albedo>, and whatever scatters a fraction `albedo` or `color` at density 1.
bool scattering_by_albedo(Element& bsdf, Surroundings const&);
/// <medium sigmaT color>: how much light meets the medium, and which part of that it scatters.
bool medium_by_albedo(Element& medium, Surroundings const&);
bool scatter_is_one(Element& bsdf, Surroundings const&);

// Materials.

/// `clearcoatGloss` (Burley 2012) as a roughness, and the coat's strength as Burley has it.
bool coat_by_gloss(Element& bsdf, Surroundings const&);
/// A tint that says how much of the base colour's hue there is (Burley 2012), as a colour.
bool specular_tint(Element& bsdf, Surroundings const&);
bool sheen_tint(Element& bsdf, Surroundings const&);
/// `principled` with parameters that only `disney` has.
bool principled_as_disney(Element& bsdf, Surroundings const&);
bool coat_over_principled(Element& bsdf, Surroundings const&);

// Textures.

/// <texture type="image"><image filename="..." linear="..."/></texture>
bool image_file(Element& texture, Surroundings const&);
bool normals_file(Element& texture, Surroundings const&);
bool tinted_blackbody(Element& texture, Surroundings const&);
/// <texture name="scale" type="constant" value="16,8,0"/>
bool scale_of_constant(Element& texture, Surroundings const&);

// Lights.

/// A spot whose angles are halves, counted from the axis, and whose power is that of a point light.
bool spot_by_half_angles(Element& light, Surroundings const&);
/// A disk of half angle `size` (radians) that the camera sees.
bool sun_as_directional(Element& light, Surroundings const&);

// Postprocesses.

/// Bloom by a box blur of half width `kernelSize` that is repeated `iterations` times.
bool bloom_by_boxes(Element& bloom, Surroundings const&);
/// Bloom by a Gaussian `radius` pixels wide in all, times `strength`.
bool bloom_by_gaussian(Element& bloom, Surroundings const&);
bool operator_by_flag(Element& tonemap, Surroundings const&);

inline constexpr std::string_view kStrategyToday =
    "says how light is found, which is `strategy` today: mis, nee or bsdf. All have the same mean";
/// For integrators that follow paths.
inline constexpr std::array kStrategies{
    Spelling{.parameter = "nee", .today = kStrategyToday, .rewrite = strategy_of_flags},
    Spelling{.parameter = "mis", .today = kStrategyToday, .rewrite = strategy_of_flags},
    Spelling{.parameter = "samplingmode", .today = kStrategyToday, .rewrite = strategy_of_mode},
};

inline constexpr std::string_view kOneStrategy =
    "has no effect: this integrator has one way to find light";
inline constexpr std::string_view kFirstHit =
    "has no effect: this integrator draws the first hit, and no light";

} // namespace weft::scene::dialects
