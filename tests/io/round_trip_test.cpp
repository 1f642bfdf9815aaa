// Every type of every category: written with all parameters changed, and read back, it is equal;
// so it is with its defaults.
#include "base/match.h"
#include "io/scene_file.h"

#include <gtest/gtest.h>

#include <set>

using namespace weft;

namespace {

/// Changes every parameter that an attribute can hold, within its range.
struct Changer {
    int count = 0;

    void operator()(std::string_view, bool& v, schema::Attr const&) { v = !v, ++count; }
    void operator()(std::string_view, int& v, schema::Attr const& a) { v = int(other(v, a)); }
    void operator()(std::string_view, float& v, schema::Attr const& a) { v = float(other(v, a)); }
    void operator()(std::string_view, Color& v, schema::Attr const& a) {
        v = {float(other(v.r, a)), v.g, float(other(v.b, a))};
        --count; // one attribute
    }
    void operator()(std::string_view, Vec2& v, schema::Attr const&) {
        v = {v.x + 0.1f, v.y - 7}, ++count;
    }
    void operator()(std::string_view, Vec3& v, schema::Attr const&) {
        v = {v.x + 0.1f, v.y - 7, v.z + 1e-20f}, ++count;
    }
    void operator()(std::string_view, schema::AnyValue& v, schema::Attr const&) {
        v = schema::AnyValue(v.v.x + 0.1f, v.v.y - 7, 3), ++count;
    }
    void operator()(std::string_view, schema::ColorStops& v, schema::Attr const&) {
        v.stops = {{-1, Color(0.1f, 2, 3)}, {1e-7f, Color(5)}}, ++count;
    }
    void operator()(std::string_view, Affined& v, schema::Attr const&) {
        v = Affined({0.1, 0, 0.5}, {0, -3, 1e-9}, {1, 1 / 3., 2}, {4, 5, 1e10}), ++count;
    }
    template <schema::Choice E>
    void operator()(std::string_view, E& v, schema::Attr const&) {
        v = E(choices(v).size() - 1), ++count;
    }
    template <class T>
    void operator()(std::string_view name, schema::Input<T>& v, schema::Attr const& a) {
        (*this)(name, v.value, a);
    }
    template <class T>
    void operator()(std::string_view, T&, schema::Attr const&) {} // objects, files
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }

    double other(double v, schema::Attr const& a) {
        ++count;
        for (double candidate : {v + 1, v - 1, (v + a.min) / 2, (v + a.max) / 2})
            if (candidate != v && candidate >= a.min && candidate <= a.max) return candidate;
        ADD_FAILURE() << "no other value";
        return v;
    }
};

std::string const kCamera = "<camera type='perspective'/>";

std::string element(schema::TypeInfo const& info, std::string const& attributes,
                    std::string const& children) {
    std::string const type = info.type.empty() ? "" : " type=\"" + std::string(info.type) + "\"";
    std::string const tag(info.category);
    return "<" + tag + type + attributes + ">" + children + "</" + tag + ">";
}

scene::Scene parse(std::string const& text) {
    return *io::parse_scene(text, "s.xml", "").jobs.at(0).scene;
}

scene::Scene parse_in_instance(std::string const& text) {
    return parse("<scene>" + kCamera + "<instance><shape type='sphere'/>" + text +
                 "</instance></scene>");
}

template <class T>
std::vector<std::pair<std::string, std::string>> texts(T object) {
    std::vector<std::pair<std::string, std::string>> result;
    object.describe(schema::detail::TextCollector{result});
    return result;
}

/// Takes back what may not be given beside another parameter; how many that are.
template <class T>
int take_back(T&) {
    return 0;
}
template <>
int take_back(scene::PointLight& light) {
    light.intensity = scene::PointLight().intensity;
    return 1;
}
template <>
int take_back(scene::SpotLight& light) {
    light.power = scene::SpotLight().power;
    return 1;
}

/// `read(text)` gives the T that the element `text` stands for.
template <class T, class Read>
void round_trip(std::string const& children, Read const& read) {
    SCOPED_TRACE(std::string(T::info.category) + " " + std::string(T::info.type));
    T const fresh{};
    EXPECT_EQ(schema::write_attributes(fresh), "");
    EXPECT_EQ(texts(T(read(element(T::info, "", children)))), texts(fresh));
    T changed{};
    Changer changer;
    changed.describe(changer);
    changer.count -= take_back(changed);
    std::string const attributes = schema::write_attributes(changed);
    EXPECT_EQ(std::count(attributes.begin(), attributes.end(), '='), changer.count);
    EXPECT_EQ(texts(T(read(element(T::info, attributes, children)))), texts(changed));
}

std::set<std::string> tested; ///< of "category type"

template <class Variant, class Read>
void round_trips(std::string const& children, Read const& read) {
    for_each_type<Variant>([&]<class T>() {
        tested.insert(std::string(T::info.category) + " " + std::string(T::info.type));
        constexpr bool required =
            std::is_same_v<T, scene::ImageTexture> || std::is_same_v<T, scene::MeshShape> ||
            std::is_same_v<T, scene::IesLight> || std::is_same_v<T, scene::nodes::GeomPropValue>;
        // Of its parameters, those of one kind exclude those of the other.
        constexpr bool exclusive = std::is_same_v<T, scene::Bloom>;
        if constexpr (!required && !exclusive && !std::is_same_v<T, scene::ConstantTexture>)
            round_trip<T>(children,
                          [&](std::string const& text) { return std::get<T>(read(text)); });
    });
}

TEST(RoundTrip, EveryTypeOfEveryCategory) {
    tested.clear();
    std::string const scene = "<scene>" + kCamera + "</scene>";
    round_trips<scene::Camera>(
        "", [](std::string const& t) { return parse("<scene>" + t + "</scene>").cameras.at(0); });
    // What a material is made of comes before it.
    auto material = [](std::string const& t) { return parse_in_instance(t).materials.back(); };
    round_trips<
        std::variant<scene::Diffuse, scene::Conductor, scene::RoughConductor, scene::Dielectric,
                     scene::RoughDielectric, scene::Principled, scene::Disney, scene::Microfacet,
                     scene::Translucent, scene::Transparent, scene::Hair, scene::VolumeBoundary>>(
        "", material);
    std::string const part = "<bsdf type='diffuse'/>", layer = "<layer>" + part + "</layer>";
    round_trips<std::variant<scene::Coat>>(part, material);
    round_trips<std::variant<scene::Mix, scene::Secondary>>(part + part, material);
    round_trips<std::variant<scene::Layered>>(layer, material);
    round_trips<std::variant<scene::Layer>>(part, [](std::string const& t) {
        return std::variant<scene::Layer>(
            parse_in_instance("<bsdf type='layered'>" + t + "</bsdf>").layers.at(0));
    });
    round_trips<scene::Shape>("", [](std::string const& t) {
        return parse("<scene>" + kCamera + "<instance>" + t + "</instance></scene>").shapes.at(0);
    });
    round_trips<scene::Texture>("", [](std::string const& t) {
        // Any type goes into a `convert`, which is added after it.
        std::string named = t;
        named.replace(0, 8, "<texture name='in'");
        return parse_in_instance("<texture name='normal' type='convert' output='vector3'>" + named +
                                 "</texture>")
            .textures.at(0);
    });
    round_trips<std::variant<scene::PointLight, scene::DirectionalLight, scene::SpotLight,
                             scene::IesLight, scene::EnvironmentLight, scene::SkyLight>>(
        "", [](std::string const& t) {
            return parse("<scene>" + kCamera + t + "</scene>").lights.at(0);
        });
    round_trips<std::variant<scene::AreaLight>>(
        "<instance><shape type='sphere'/><emission type='lambertian'/></instance>",
        [](std::string const& t) {
            return parse("<scene>" + kCamera + t + "</scene>").lights.at(0);
        });
    round_trips<std::variant<scene::Portal>>("", [](std::string const& t) {
        return std::variant<scene::Portal>(
            parse("<scene>" + kCamera + "<light type='envmap'>" + t + "</light></scene>")
                .portals.at(0));
    });
    round_trips<std::variant<scene::LambertianEmission>>("", [](std::string const& t) {
        return std::variant<scene::LambertianEmission>(parse_in_instance(t).emissions.at(0));
    });
    round_trips<std::variant<scene::ConstantVolume>>("", [](std::string const& t) {
        return std::variant<scene::ConstantVolume>(parse_in_instance(t).volumes.at(0));
    });
    round_trips<std::variant<scene::HomogeneousMedium>>("", [](std::string const& t) {
        return std::variant<scene::HomogeneousMedium>(parse_in_instance(t).media.at(0));
    });
    round_trips<std::variant<scene::Instance>>("<shape type='sphere'/>", [](std::string const& t) {
        return std::variant<scene::Instance>(
            parse("<scene>" + kCamera + t + "</scene>").instances.at(0));
    });
    round_trips<std::variant<scene::SceneContents>>(kCamera, [](std::string const& t) {
        return std::variant<scene::SceneContents>(parse(t).contents);
    });
    round_trips<scene::Sampler>("", [&](std::string const& t) {
        return io::parse_scene("<integrator type='path'>" + scene + t + "</integrator>", "s.xml",
                               "")
            .jobs.at(0)
            .sampler;
    });
    round_trips<scene::Integrator>(scene, [](std::string const& t) {
        return io::parse_scene(t, "s.xml", "").jobs.at(0).integrator;
    });
    round_trips<std::variant<scene::ImageOutput>>("", [&](std::string const& t) {
        std::string named = t;
        named.replace(0, 6,
                      "<image name='input' filename='" WEFT_SOURCE_DIR "/tests/io/bad/tiny.png'");
        auto const file = io::parse_scene(
            "<postprocess type='tonemap'>" + named + "<image id='x'/></postprocess>", "s.xml", "");
        scene::ImageOutput output;
        for (scene::PictureName const& picture : file.pictures) output.linear |= picture.linear;
        return std::variant<scene::ImageOutput>(output);
    });
    round_trips<std::variant<scene::Display>>("", [&](std::string const& t) {
        return std::variant<scene::Display>(io::parse_scene("<integrator type='path'>" + scene +
                                                                "<image id='x'>" + t +
                                                                "</image></integrator>",
                                                            "s.xml", "")
                                                .pictures.at(0)
                                                .display);
    });
    round_trips<std::variant<scene::ImageTest>>(
        "<integrator type='path'>" + scene + "</integrator>", [](std::string const& t) {
            std::string named = t;
            named.replace(0, 5, "<test id='x'");
            return std::variant<scene::ImageTest>(
                *io::parse_scene(named, "s.xml", "").jobs.at(0).test);
        });
    round_trips<scene::Postprocess>(
        "<ref name='input' id='noisy'/><image id='clean'/>", [&](std::string const& t) {
            return io::parse_scene("<integrator type='path'>" + scene +
                                       "<image id='noisy'/></integrator>" + t,
                                   "s.xml", "")
                .postprocesses.at(0)
                .postprocess;
        });
    for (schema::Schema const& s : io::all_schemas())
        EXPECT_TRUE(tested.contains(std::string(s.info.category) + " " + std::string(s.info.type)))
            << "no round trip for " << s.info.category << " " << s.info.type;
}

TEST(RoundTrip, TypesWithRequiredParameters) {
    auto texture = [](scene::Texture const& t, std::string attributes) {
        return match(t, [&](auto const& v) {
            return parse_in_instance("<texture name='normal' type='" + std::string(v.info.type) +
                                     "'" + attributes + schema::write_attributes(v) + "/>");
        });
    };
    scene::ConstantTexture constant;
    constant.value = Color(0.1f, 2, 1e-7f);
    EXPECT_EQ(std::get<scene::ConstantTexture>(texture(constant, "").textures.at(0)).value,
              constant.value);

    scene::nodes::GeomPropValue property;
    property.geomprop = "heat";
    property.output = scene::nodes::AnyType::vector3;
    property.fallback = schema::AnyValue(1, 2, 3);
    EXPECT_EQ(texts(std::get<scene::nodes::GeomPropValue>(texture(property, "").textures.at(0))),
              texts(property));

    scene::ImageTexture image;
    image.filename.path = std::string(WEFT_SOURCE_DIR) + "/tests/io/bad/tiny.png";
    Changer changer;
    image.describe(changer);
    scene::Scene const read = texture(image, "");
    EXPECT_EQ(texts(std::get<scene::ImageTexture>(read.textures.at(0))), texts(image));
    EXPECT_EQ(read.images.at(0)->width, 1);
}

TEST(AllSchemas, NamesAreUniqueAndExplained) {
    std::set<std::pair<std::string_view, std::string_view>> types;
    for (schema::Schema const& s : io::all_schemas()) {
        SCOPED_TRACE(std::string(s.info.category) + " " + std::string(s.info.type));
        EXPECT_TRUE(types.emplace(s.info.category, s.info.type).second);
        EXPECT_FALSE(s.info.help.empty());
        std::set<std::string> names{"type", "id", "name"};
        for (schema::Field const& f : s.fields) {
            EXPECT_TRUE(names.insert(f.name).second) << f.name << " is described twice or reserved";
            EXPECT_FALSE(f.attr.help.empty()) << f.name;
            EXPECT_LE(f.attr.min, f.attr.max) << f.name;
            if (f.kind == "integer" || f.kind == "float") {
                double const value = std::stod(f.default_value);
                EXPECT_GE(value, f.attr.min) << f.name;
                EXPECT_LE(value, f.attr.max) << f.name;
            }
        }
    }
    EXPECT_GT(types.size(), 30u);
}

} // namespace
