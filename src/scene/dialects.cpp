#include "scene/dialects.h"

#include <algorithm>
#include <cmath>

#include "schema/text.h"

namespace weft::scene::dialects {

using namespace schema;

namespace {

bool flag(Element& e, std::string_view name, bool otherwise) {
    bool value = otherwise;
    Attribute const* a = parameter_value(e, name);
    if (a && !TextForm<bool>::read(a->value, value))
        throw InputError(a->where, in_quotes(name) + " of " + element_title(e) +
                                       " expects true or false, found " + in_quotes(a->value));
    return value;
}

void erase_all(Element& e, std::initializer_list<std::string_view> names) {
    for (std::string_view name : names) erase_parameter(e, name);
}

/// The number that a rule has to calculate with.
double number_of(Element& e, std::string_view name) {
    if (auto const number = parameter_number(e, name)) return *number;
    throw InputError(parameter_place(e, name),
                     in_quotes(name) + " of " + element_title(e) +
                         " is a word of another dialect, and expects a number to convert");
}

std::string text(double v) { return number_text(float(v)); }
std::string text(Color const& c) { return TextForm<Color>::write(c); }

} // namespace

bool strategy_of_flags(Element& e, Surroundings const&) {
    // What is not said is what the type does.
    std::string_view const usual = e.get("type") == "pathtracer" ? "nee" : "mis";
    bool const mis = flag(e, "mis", usual == "mis"), nee = flag(e, "nee", true);
    std::string_view const strategy = !nee ? "bsdf" : mis ? "mis" : "nee";
    erase_all(e, {"nee", "mis"});
    if (!has_parameter(e, "strategy") && strategy != usual)
        e.set("strategy", std::string(strategy));
    return true;
}

bool strategy_of_mode(Element& e, Surroundings const&) {
    if (has_parameter(e, "strategy")) {
        erase_parameter(e, "samplingmode");
        return true;
    }
    rename_parameter(e, "samplingmode", "strategy");
    if (Attribute* mode = parameter_value(e, "strategy"))
        for (char& c : mode->value) c = char(std::tolower(static_cast<unsigned char>(c)));
    return true;
}

bool path_without_lights(Element& e, Surroundings const&) {
    e.set("type", "pathtracer");
    if (!has_parameter(e, "strategy")) e.set("strategy", "bsdf");
    return true;
}

bool normals_as_aov(Element& e, Surroundings const&) {
    bool const remap = flag(e, "remap", true);
    erase_all(e, {"remap", "variable", "nee", "mis"});
    e.set("type", remap ? "aov" : "normal");
    e.set(remap ? "variable" : "remap", remap ? "normals" : "false");
    return true;
}

bool bvh_as_aov(Element& e, Surroundings const&) {
    e.set("type", "aov");
    e.set("variable", "bvh");
    rename_parameter(e, "unit", "scale");
    return true;
}

bool albedo_as_integrator(Element& e, Surroundings const&) {
    if (parameter_text(e, "variable") != "albedo") return false;
    e.set("type", "albedo");
    erase_all(e, {"variable", "scale"});
    return true;
}

bool scene_into_integrator(Element& test, Surroundings const&) {
    Element* scene = parameter_child(test, "scene");
    Element* integrator = parameter_child(test, "integrator");
    if (!scene || !integrator || scene->tag != "scene" || scene->get("id").empty()) return false;
    for (auto& child : integrator->children) {
        if (child->tag != "ref" || child->get("id") != scene->get("id")) continue;
        child = test.take(*scene);
        return true;
    }
    return false;
}

std::optional<std::string> scale_of_fov(std::string_view fov) {
    auto const degrees = read_components(fov, 1);
    if (!degrees || !(degrees->front() > 0 && degrees->front() < 180)) return {};
    return text(std::tan(degrees->front() * M_PI / 360));
}

bool bokeh_file(Element& camera, Surroundings const& around) {
    Element* texture = parameter_child(camera, "bokeh");
    if (!texture || texture->tag != "texture" || texture->get("type") != "image") return false;
    image_file(*texture, around);
    Attribute const* file = parameter_value(*texture, "filename");
    if (!file || !texture->find("filename")) return false;
    for (Attribute const& a : texture->attributes)
        if (a.name != "name" && a.name != "type" && a.name != "id" && a.name != "filename" &&
            a.name != "linear")
            return false; // would be lost
    set_parameter(camera, "bokeh", file->value);
    return true;
}

namespace {

/// `clearcoatGloss` and the strength of the coat, which Burley 2012 scales by a quarter.
void convert_burley_coat(Element& bsdf) {
    if (has_parameter(bsdf, "clearcoatGloss")) {
        double const gloss = std::clamp(number_of(bsdf, "clearcoatGloss"), 0., 1.);
        // His alpha runs from 0.1 (satin) to 0.001 (gloss); roughness is its root.
        set_parameter(bsdf, "clearcoatRoughness", text(std::sqrt(0.1 - gloss * 0.099)));
        erase_parameter(bsdf, "clearcoatGloss");
    }
    if (!has_parameter(bsdf, "clearcoat")) return;
    if (auto const strength = parameter_number(bsdf, "clearcoat")) {
        set_parameter(bsdf, "clearcoat", text(*strength * 0.25));
        return;
    }
    Element* const given = parameter_child(bsdf, "clearcoat");
    if (!given) number_of(bsdf, "clearcoat"); // says what was expected
    std::unique_ptr<Element> pattern = bsdf.take(*given);
    pattern->set("name", "in1");
    Element& quarter = bsdf.add("texture");
    quarter.set("name", "clearcoat");
    quarter.set("type", "multiply");
    quarter.set("in2", "0.25");
    quarter.children.push_back(std::move(pattern));
}

/// Whether a number given as `name` is an amount, and not a grey: its tag says so, or the words
/// that stand beside it are Burley's.
bool is_amount(Element& bsdf, std::string_view name) {
    Attribute const* a = parameter_value(bsdf, name);
    if (!a || !read_components(a->value, 1)) return false;
    Element const* child = parameter_child(bsdf, name);
    if (child && child->tag == "float") return true;
    for (std::string_view word : {"clearcoatGloss", "specularTrans", "eta"})
        if (has_parameter(bsdf, word)) return true;
    return false;
}

bool tint_of_amount(Element& bsdf, std::string_view name) {
    if (!is_amount(bsdf, name)) return false;
    float const amount = float(std::clamp(*parameter_number(bsdf, name), 0., 1.));
    auto base = parameter_color(bsdf, "baseColor");
    if (!base && has_parameter(bsdf, "baseColor") && amount > 0)
        throw InputError(parameter_place(bsdf, name),
                         in_quotes(name) + " of " + element_title(bsdf) +
                             " is an amount of the base colour's hue, which varies here; expected "
                             "a colour");
    Color const hue = base.value_or(Color(1));
    float const most = std::max({hue.r, hue.g, hue.b});
    set_parameter(bsdf, name, text(most > 0 ? lerp(Color(1), hue / most, amount) : Color(1)));
    return true;
}

} // namespace

bool specular_tint(Element& bsdf, Surroundings const&) {
    return tint_of_amount(bsdf, "specularTint");
}
bool sheen_tint(Element& bsdf, Surroundings const&) { return tint_of_amount(bsdf, "sheenTint"); }

bool coat_by_gloss(Element& bsdf, Surroundings const&) {
    convert_burley_coat(bsdf);
    return true;
}

bool principled_as_disney(Element& bsdf, Surroundings const&) {
    bsdf.set("type", "disney");
    return true;
}

bool coat_over_principled(Element& bsdf, Surroundings const&) {
    convert_burley_coat(bsdf);
    // What is not the coat's goes to the material below.
    auto below = std::make_unique<Element>();
    below->tag = "bsdf";
    below->where = bsdf.where;
    below->folder = bsdf.folder;
    below->set("type", "principled");
    for (std::string_view name : {"baseColor", "roughness", "metallic", "specular"}) {
        if (Attribute const* a = bsdf.find(name)) {
            below->set(name, a->value);
            bsdf.erase(name);
        }
        if (Element* child = parameter_child(bsdf, name))
            below->children.push_back(bsdf.take(*child));
    }
    bsdf.set("type", "coat");
    rename_parameter(bsdf, "clearcoat", "weight");
    rename_parameter(bsdf, "clearcoatRoughness", "roughness");
    bsdf.children.push_back(std::move(below));
    return true;
}

bool image_file(Element& texture, Surroundings const& around) {
    for (auto const& child : texture.children) {
        if (!child->get("name").empty()) continue;
        Element* image = around.resolve(*child);
        if (!image || image->tag != "image") continue;
        for (Attribute const& a : image->attributes)
            if (a.name != "id") texture.set(a.name, a.value);
        for (auto const& inner : image->children)
            if (is_property_tag(inner->tag) && inner->find("name") && inner->find("value"))
                texture.set(inner->get("name"), std::string(inner->get("value")));
        texture.take(*child);
        return true;
    }
    return false;
}

bool normals_file(Element& texture, Surroundings const&) {
    texture.set("type", "image");
    if (!has_parameter(texture, "linear")) texture.set("linear", "true");
    return true;
}

bool tinted_blackbody(Element& texture, Surroundings const&) {
    auto glow = std::make_unique<Element>();
    glow->tag = "texture";
    glow->where = texture.where;
    glow->folder = texture.folder;
    glow->set("name", "in1");
    glow->set("type", "blackbody");
    if (Attribute const* a = texture.find("temperature")) glow->set("temperature", a->value);
    texture.erase("temperature");
    if (Element* child = parameter_child(texture, "temperature"))
        glow->children.push_back(texture.take(*child));
    texture.set("type", "multiply");
    rename_parameter(texture, "tint", "in2");
    texture.children.push_back(std::move(glow));
    return true;
}

bool spot_by_half_angles(Element& light, Surroundings const&) {
    double const inner = number_of(light, "falloffStart");
    double const outer = has_parameter(light, "angle") ? number_of(light, "angle") : 30;
    set_parameter(light, "angle", text(2 * std::min(inner, outer)));
    set_parameter(light, "falloff", text(2 * std::max(outer - inner, 0.)));
    erase_parameter(light, "falloffStart");
    if (auto const power = parameter_color(light, "power")) {
        set_parameter(light, "intensity", text(*power / float(4 * M_PI)));
        erase_parameter(light, "power");
    }
    return true;
}

bool sun_as_directional(Element& light, Surroundings const&) {
    light.set("type", "directional");
    if (has_parameter(light, "size")) {
        set_parameter(light, "angle", text(number_of(light, "size") * 360 / M_PI));
        erase_parameter(light, "size");
    }
    if (!has_parameter(light, "visibleToCamera")) light.set("visibleToCamera", "true");
    return true;
}

bool scale_of_constant(Element& texture, Surroundings const&) {
    Element const* child = parameter_child(texture, "scale");
    if (!child || child->tag != "texture" || child->get("type") != "constant") return false;
    std::string_view const value = child->get("value");
    auto scale = read_components(value, 3);
    if (!scale) scale = read_components(value, 2);
    if (!scale) return false;
    set_parameter(texture, "scale", text((*scale)[0]) + "," + text((*scale)[1]));
    return true;
}

bool bloom_by_boxes(Element& bloom, Surroundings const&) {
    double const half = has_parameter(bloom, "kernelSize") ? number_of(bloom, "kernelSize") : 10;
    double const times = has_parameter(bloom, "iterations") ? number_of(bloom, "iterations") : 3;
    auto const variance = [](double k) { return ((2 * k + 1) * (2 * k + 1) - 1) / 12; };
    // Three small boxes come before the large ones.
    double const all = 2 * variance(3) + variance(4) + std::max(times, 0.) * variance(half);
    erase_all(bloom, {"kernelSize", "iterations", "softThreshold", "amountSmall"});
    if (!has_parameter(bloom, "sigma")) bloom.set("sigma", text(std::sqrt(all)));
    return true;
}

bool bloom_by_gaussian(Element& bloom, Surroundings const&) {
    bloom.set("type", "bloom");
    if (has_parameter(bloom, "radius")) {
        double const width = number_of(bloom, "radius");
        // What OpenCV takes where only the width is given.
        set_parameter(bloom, "sigma", text(std::max(0.3 * ((width - 1) * 0.5 - 1) + 0.8, 0.1)));
        set_parameter(bloom, "radius", std::to_string(std::lround((width - 1) / 2)));
    }
    rename_parameter(bloom, "strength", "intensity");
    erase_parameter(bloom, "upper_brightness_bound");
    return true;
}

bool operator_by_flag(Element& tonemap, Surroundings const&) {
    tonemap.set("type", "tonemap");
    bool const logarithmic = flag(tonemap, "useLogScale", true);
    erase_parameter(tonemap, "useLogScale");
    if (!has_parameter(tonemap, "operator") && logarithmic) tonemap.set("operator", "drago");
    return true;
}

} // namespace weft::scene::dialects
