#include "scene/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/match.h"
#include "schema/text.h"

namespace weft::scene {

namespace {

/// The name of a light group or a layer, which becomes a part of channels' names.
void check_name(std::string_view parameter, std::string const& name, Report const& report) {
    auto const fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
    };
    if (!std::all_of(name.begin(), name.end(), fits))
        report.fail(parameter, in_quotes(parameter) + " of " + report.title() +
                                   " expects letters, digits, _ and -, found " + in_quotes(name));
}

void check_direction(std::string_view parameter, Vec3 const& direction, Report const& report) {
    if (!(length_squared(Vec3d(direction)) > 0))
        report.fail(parameter, in_quotes(parameter) + " of " + report.title() +
                                   " expects a direction, found a vector of length 0");
}

constexpr Input<Color> kNoLight{Color(0)};

/// Two ways to say how bright a light is: one of them has to be black.
void check_brightness(Input<Color> const& usual, std::string const& usual_name,
                      Input<Color> const& other, std::string const& other_name,
                      Report const& report) {
    if (usual != kNoLight && other != kNoLight)
        report.fail(other_name, report.title() + " expects '" + usual_name + "' or '" + other_name +
                                    "', found both");
}

/// Throws where a part of a material is what only whole materials can be.
void check_part(MaterialId part, Facts const& facts, Report const& report) {
    Material const& material = facts.scene().materials[size_t(part.index)];
    if (can_be_part(material)) return;
    report.fail("", report.title() + " expects a surface to be made of, found <bsdf type=\"" +
                        std::string(match(material, [](auto const& m) { return m.info.type; })) +
                        "\">");
}

void check_two_parts(std::vector<MaterialId> const& parts, Facts const& facts,
                     Report const& report) {
    if (parts.size() != 2)
        report.fail("", report.title() + " expects two child tags <bsdf>, found " +
                            std::to_string(parts.size()));
    for (MaterialId part : parts) check_part(part, facts, report);
}

bool fits_floats(Affined const& m) {
    bool fits = true;
    for (Vec3d const& column : {m.x, m.y, m.z, m.origin})
        for (int row = 0; row < 3; ++row)
            fits &= std::abs(column[row]) <= double(std::numeric_limits<float>::max());
    return fits;
}

} // namespace

ValueType Facts::type_of(TextureId id) {
    size_t const index = size_t(id.index);
    if (types_.size() <= index) types_.resize(scene_.textures.size(), ValueType::none);
    if (types_[index] == ValueType::none) {
        auto const of_input = [&](TextureId input) { return type_of(input); };
        types_[index] = match(scene_.textures[index],
                              [&](auto const& node) { return output_type(node, of_input); });
    }
    return types_[index];
}

Facts::Census const& Facts::census(InstanceId id) {
    size_t const index = size_t(id.index);
    if (censuses_.size() <= index) censuses_.resize(scene_.instances.size());
    if (censuses_[index].objects >= 0) return censuses_[index];
    Instance const& instance = scene_.instances[index];
    MaterialId const bsdf = instance.traits.bsdf;
    bool const shines = bsdf && emission_of(scene_.materials[size_t(bsdf.index)]);
    Census total{1, instance.traits.emission || shines};
    if (auto const* group = std::get_if<Group>(&scene_.shapes[size_t(instance.shape.index)])) {
        total.objects = 0;
        for (InstanceId member : group->instances) {
            Census const& part = census(member);
            total.objects += part.objects;
            total.emits |= part.emits;
        }
    }
    return censuses_[index] = total;
}

void check(Instance const& instance, Facts& facts, Report const& report) {
    check_name("group", instance.traits.group, report);
    if (!instance.traits.normal) return;
    ValueType const type = facts.type_of(instance.traits.normal);
    if (type != ValueType::color && type != ValueType::vector3)
        report.fail("normal", "'normal' of <instance> expects a color or a vector3, found a " +
                                  std::string(schema::type_name(type)));
}

void check(nodes::Convert const& node, Facts& facts, Report const& report) {
    if (!node.in.texture || node.output_type() != ValueType::number) return;
    ValueType const type = facts.type_of(node.in.texture);
    if (type == ValueType::vector2 || type == ValueType::vector3)
        report.fail("in", "'in' of " + report.title() + " expects a float or a color, found a " +
                              std::string(schema::type_name(type)) +
                              "; `extract` makes a float of it");
}

void check(Layer const& layer, Facts& facts, Report const& report) {
    check_part(layer.bsdf, facts, report);
    check_name("label", layer.label, report);
}

void check(Layered const& material, Facts&, Report const& report) {
    if (material.layers.empty())
        report.fail("", report.title() + " expects a child tag <layer>, found none");
}

void check(Coat const& material, Facts& facts, Report const& report) {
    check_part(material.bsdf, facts, report);
    check_name("label", material.label, report);
}

void check(Mix const& material, Facts& facts, Report const& report) {
    check_two_parts(material.bsdfs, facts, report);
    check_name("label0", material.label0, report);
    check_name("label1", material.label1, report);
}

void check(Secondary const& material, Facts& facts, Report const& report) {
    check_two_parts(material.bsdfs, facts, report);
}

void check(PointLight const& light, Facts&, Report const& report) {
    check_brightness(light.power, "power", light.intensity, "intensity", report);
}

void check(DirectionalLight const& light, Facts&, Report const& report) {
    check_direction("direction", light.direction, report);
}

void check(SpotLight const& light, Facts&, Report const& report) {
    check_direction("direction", light.direction, report);
    check_direction("up", light.up, report);
    check_brightness(light.intensity, "intensity", light.power, "power", report);
    float const outer = light.angle + light.falloff;
    if (light.gobo.texture && !(outer < 180))
        report.fail("gobo", "'gobo' of " + report.title() +
                                " expects an angle and falloff of less than 180 together, found " +
                                schema::number_text(outer));
    if (light.power != kNoLight && !(outer > 0))
        report.fail("power", "'power' of " + report.title() +
                                 " expects an angle and falloff of more than 0 together, found 0");
}

void check(IesLight const& light, Facts&, Report const& report) {
    check_direction("direction", light.direction, report);
    check_direction("c0", light.c0, report);
}

void check(AreaLight const& light, Facts& facts, Report const& report) {
    if (!facts.census(light.instance).emits)
        report.fail("", report.title() + " expects an instance with an <emission>, found one "
                                         "without");
}

void check(SkyLight const& light, Facts&, Report const& report) {
    if (!light.date.empty() && !parse_date(light.date))
        report.fail("date", "'date' of " + report.title() +
                                " expects a day, as 2026-06-21, found " + in_quotes(light.date));
}

void check(LightControls const& controls, Facts&, Report const& report) {
    check_name("group", controls.group, report);
}

void check(Portal const& portal, Facts&, Report const& report) {
    Affined const& m = portal.transform;
    if (std::abs(dot(m.x, m.y)) > 1e-4 * length(m.x) * length(m.y))
        report.fail("transform",
                    "<portal> expects a transform that leaves it a rectangle, found one "
                    "that shears it");
}

/// Groups of groups multiply: a few lines can stand for more objects than any memory holds.
void check(SceneContents const& contents, Facts& facts, Report const& report) {
    constexpr double most = 1e8;
    double objects = 0;
    for (InstanceId id : contents.instances) objects += facts.census(id).objects;
    for (LightId id : contents.lights)
        if (auto const* area = std::get_if<AreaLight>(&facts.scene().lights[size_t(id.index)]))
            objects += facts.census(area->instance).objects;
    if (objects > most)
        report.fail("", "<scene> expects at most " + schema::number_text(most) +
                            " objects, found " + schema::number_text(objects) + " by its groups");
}

bool is_invertible(Affined const& m) {
    // Singular: the columns span no volume, relative to their lengths.
    double const volume = length(m.x) * length(m.y) * length(m.z);
    bool const spans = std::abs(m.determinant()) > 1e-12 * volume && volume > 0;
    return spans && fits_floats(m) && fits_floats(m.inverse());
}

std::string not_invertible_message(Affined const& m) {
    return "expected a transform that can be inverted, found one of determinant " +
           schema::number_text(m.determinant());
}

} // namespace weft::scene
