// The rules of scene/dialects.h about shapes and media.
#include <algorithm>

#include "scene/dialects.h"
#include "schema/text.h"

namespace weft::scene::dialects {

using namespace schema;

namespace {

Element* child_of(Element& e, std::string_view tag) {
    for (auto const& child : e.children)
        if (child->tag == tag) return child.get();
    return nullptr;
}

/// The child, or what a reference among the children leads to.
Element* part_of(Element& e, std::string_view tag, Surroundings const& around) {
    for (auto const& child : e.children)
        if (Element* part = around.resolve(*child); part && part->tag == tag) return part;
    return nullptr;
}

using Numbers = std::vector<double>; ///< one for each colour: floats would show their rounding

std::optional<Numbers> numbers_of(Element& e, std::string_view name) {
    Attribute const* a = parameter_value(e, name);
    return a ? read_components(a->value, 3) : std::nullopt;
}

/// How much of the light that meets a medium goes on, by colour; none where nothing is said.
Numbers albedo_of(Element& e) {
    for (std::string_view name : {"albedo", "color"})
        if (has_parameter(e, name)) {
            if (auto const numbers = numbers_of(e, name)) return *numbers;
            throw InputError(parameter_place(e, name), in_quotes(name) + " of " + element_title(e) +
                                                           " cannot vary: expected 1 or 3 numbers");
        }
    // What has been rewritten already has coefficients that add up to 1.
    return numbers_of(e, "scatter").value_or(Numbers(3, 0));
}

std::string text_of(Numbers const& numbers) {
    return TextForm<Color>::write(Color(float(numbers[0]), float(numbers[1]), float(numbers[2])));
}

/// Absorption and scattering of a medium of this extinction.
void set_coefficients(Element& e, double extinction, Numbers const& albedo) {
    Numbers absorption, scatter;
    for (double a : albedo) {
        absorption.push_back(extinction * (1 - a));
        scatter.push_back(extinction * a);
    }
    e.set("absorption", text_of(absorption));
    e.set("scatter", text_of(scatter));
}

/// Whether the instance is one of a volume shape that is written inside of it.
Element* volume_of(Element& instance) {
    Element* shape = instance.tag == "instance" ? child_of(instance, "shape") : nullptr;
    return shape && shape->get("type") == "volume" ? shape : nullptr;
}
Element* boundary_of(Element& volume) {
    for (auto const& child : volume.children)
        if (!is_property_tag(child->tag)) return child.get();
    return nullptr;
}

/// The extinction of a volume shape per unit of length in the world.
double density_of(Element& volume, Element& instance, Surroundings const& around) {
    auto const density = parameter_number(volume, "density");
    if (!density || !(*density >= 0))
        throw InputError(volume.where, element_title(volume) +
                                           " expects density=\"...\", how much of the medium is "
                                           "met per unit of length");
    auto const scale = around.scale_of(instance);
    if (!scale)
        throw InputError(volume.where, element_title(volume) +
                                           " expects a transform that scales all directions "
                                           "alike: its density is the same in all of them here");
    return *density / *scale;
}

/// The word that a medium of other dialects has for its extinction; "" where it is one of ours.
std::string_view extinction_word(Element& medium) {
    for (std::string_view name : {"sigmaT", "sigma_t", "density"})
        if (has_parameter(medium, name)) return name;
    return "";
}

double extinction_of(Element& medium) {
    std::string_view const word = extinction_word(medium);
    if (auto const number = parameter_number(medium, word)) return *number;
    throw InputError(parameter_place(medium, word),
                     in_quotes(word) + " of " + element_title(medium) + " expects a number");
}

} // namespace

bool volume_shape(Element& instance, Surroundings const& around) {
    Element* volume = volume_of(instance);
    if (!volume) return false;
    Element* boundary = boundary_of(*volume);
    if (!boundary) return false;
    double const density = density_of(*volume, instance, around);
    std::unique_ptr<Element> shape = volume->take(*boundary);
    shape->erase("name");
    for (auto& child : instance.children)
        if (child.get() == volume) child = std::move(shape);
    Element& filling = instance.add("volume");
    filling.set("type", "constant");
    filling.set("value", number_text(float(density)));
    return true;
}

bool volume_everywhere(Element& scene, Surroundings const& around) {
    bool found = false;
    for (size_t i = 0; i < scene.children.size(); ++i) {
        Element* const child = scene.children[i].get();
        Element* volume = volume_of(*child);
        if (!volume || boundary_of(*volume)) continue;
        double const density = density_of(*volume, *child, around);
        Element* bsdf = part_of(*child, "bsdf", around);
        if (has_parameter(scene, "medium"))
            throw InputError(volume->where, "a scene has one medium that fills it, found another");
        Element& medium = scene.add("medium");
        medium.where = child->where;
        medium.set("type", "homogeneous");
        set_coefficients(medium, density, bsdf ? albedo_of(*bsdf) : Numbers(3, 0));
        for (std::string_view name : {"g", "phase"})
            if (bsdf && has_parameter(*bsdf, name))
                medium.set("phase", parameter_text(*bsdf, name));
        scene.take(*child);
        --i;
        found = true;
    }
    return found;
}

bool albedo_into_medium(Element& instance, Surroundings const&) {
    Element* const bsdf = child_of(instance, "bsdf");
    Element* const medium = child_of(instance, "medium");
    if (!bsdf || bsdf->get("type") != "volumebsdf" || !medium || extinction_word(*medium).empty())
        return false;
    medium->set("color", text_of(albedo_of(*bsdf)));
    instance.take(*bsdf);
    return true;
}

bool scattering_by_albedo(Element& bsdf, Surroundings const&) {
    Numbers const albedo = albedo_of(bsdf);
    for (std::string_view name : {"albedo", "color"}) erase_parameter(bsdf, name);
    bsdf.set("type", "volume");
    set_coefficients(bsdf, 1, albedo);
    return true;
}

bool medium_by_albedo(Element& medium, Surroundings const&) {
    double const extinction = extinction_of(medium);
    Numbers const albedo = albedo_of(medium);
    for (std::string_view name : {"sigmaT", "sigma_t", "density", "albedo", "color"})
        erase_parameter(medium, name);
    set_coefficients(medium, extinction, albedo);
    return true;
}

bool scatter_is_one(Element& bsdf, Surroundings const&) {
    if (has_parameter(bsdf, "scatter")) return false;
    bsdf.set("scatter", "1");
    return true;
}

} // namespace weft::scene::dialects
