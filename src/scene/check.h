// What makes a scene valid, whoever made it: a reader of files, an edit, a program.
//
// Rules stand in three places. A parameter's range and whether it is required stand beside it, in
// `describe`. What a type asks beyond that is an overload of `check` below. What the parts of a
// scene ask of each other (indices that lead somewhere, no object inside of itself) is
// `check(Scene)`, which applies the others, too; `World::commit` calls it, and relies on nothing
// else.
//
// A reader calls `check_object` for each object as it reads it, with a Report that knows the place
// of every parameter. For scenes without places a message names the object by its kind and index.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/bloom.h"
#include "scene/node_types.h"
#include "scene/scene.h"
#include "schema/text.h"

namespace weft::scene {

/// The object that a rule looks at, as messages speak of it.
class Report {
  public:
    virtual ~Report() = default;
    /// "<light type="point">"
    virtual std::string title() const = 0;
    /// Where the parameter stands; "" stands for the object itself.
    virtual SourceLocation where(std::string_view parameter) const = 0;

    [[noreturn]] void fail(std::string_view parameter, std::string const& message) const {
        throw InputError(where(parameter), message);
    }
};

/// Answers what rules ask about the objects that an object refers to. Each fact is found once;
/// objects may be added to the scene meanwhile. All ids must lead to objects, and none may contain
/// itself.
class Facts {
  public:
    explicit Facts(Scene const& scene) : scene_(scene) {}
    Scene const& scene() const { return scene_; }

    /// Returns the type of what a node gives.
    ValueType type_of(TextureId id);

    /// Returns what an instance amounts to, the members of groups included.
    struct Census {
        double objects = -1; ///< may exceed any integer
        bool emits = false;
    };
    Census const& census(InstanceId id);

  private:
    Scene const& scene_;
    std::vector<ValueType> types_; ///< one per node, `none` where it is not known yet
    std::vector<Census> censuses_; ///< one per instance, less than 0 objects where not known yet
};

// The rules of types that have any beyond their parameters. All throw InputError through the
// report.
template <class T>
void check(T const&, Facts&, Report const&) {}
void check(Instance const& instance, Facts& facts, Report const& report);
void check(nodes::Convert const& node, Facts& facts, Report const& report);
void check(Layer const& layer, Facts& facts, Report const& report);
void check(Layered const& material, Facts& facts, Report const& report);
void check(Coat const& material, Facts& facts, Report const& report);
void check(Mix const& material, Facts& facts, Report const& report);
void check(Secondary const& material, Facts& facts, Report const& report);
void check(PointLight const& light, Facts& facts, Report const& report);
void check(DirectionalLight const& light, Facts& facts, Report const& report);
void check(SpotLight const& light, Facts& facts, Report const& report);
void check(IesLight const& light, Facts& facts, Report const& report);
void check(AreaLight const& light, Facts& facts, Report const& report);
void check(SkyLight const& light, Facts& facts, Report const& report);
void check(LightControls const& controls, Facts& facts, Report const& report);
void check(Portal const& portal, Facts& facts, Report const& report);
void check(SceneContents const& contents, Facts& facts, Report const& report);

/// Throws where the inputs of a node that takes any type do not go together.
template <class Node>
void check_input_types(Node const& node, Facts& facts, Report const& report) {
    auto const type_of = [&](TextureId id) { return facts.type_of(id); };
    InputTypes types{type_of};
    schema::read_members(node, types);
    if (types.clash.empty()) return;
    report.fail(types.clash, in_quotes(types.clash) + " of " + report.title() + " expects a " +
                                 std::string(schema::type_name(types.type)) +
                                 " as the inputs before it, found a " +
                                 std::string(schema::type_name(types.clashing)) +
                                 "; `convert` and `extract` make one of the other");
}

template <class T>
void check_object(T const& object, Facts& facts, Report const& report);

namespace detail {

/// Applies the rules of the groups of parameters that an object has.
struct GroupCheck {
    Facts& facts;
    Report const& report;

    template <class T>
    void operator()(std::string_view, T const&, schema::Attr const&) {}
    template <class T>
    void group(T const& member) {
        check_object(member, facts, report);
    }
};

} // namespace detail

/// Applies the rules of an object and of the groups of parameters in it.
template <class T>
void check_object(T const& object, Facts& facts, Report const& report) {
    if constexpr (requires { T::info; })
        if constexpr (T::info.output == ValueType::inputs) check_input_types(object, facts, report);
    check(object, facts, report);
    schema::read_members(object, detail::GroupCheck{facts, report});
}

/// The longest chain of references in a scene: an instance in a group in a group, a node behind
/// nodes.
inline constexpr int kMaxDepth = 1000;

/// Throws InputError where the scene is not valid. Takes time in proportion to its objects, and to
/// the vertices and triangles of its meshes.
void check(Scene const& scene);

/// Returns whether a transform can be inverted, and both ways fit into floats.
bool is_invertible(Affined const& transform);
/// "expected a transform that can be inverted, ..."
std::string not_invertible_message(Affined const& transform);

// Parameters that say one thing in two ways: the default of one gives way where the other is given.
// Readers call these, since only they know what is given: `given(name)` tells.

/// Makes the default of `usual` give way to `other`.
template <class Given>
void settle_brightness(Input<Color>& usual, std::string_view usual_name,
                       std::string_view other_name, Given const& given) {
    if (given(other_name) && !given(usual_name)) usual = {Color(0)};
}
template <class T, class Given>
void settle(T&, Given const&, Report const&) {}
template <class Given>
void settle(PointLight& light, Given const& given, Report const&) {
    settle_brightness(light.power, "power", "intensity", given);
}
template <class Given>
void settle(SpotLight& light, Given const& given, Report const&) {
    settle_brightness(light.intensity, "intensity", "power", given);
}
template <class Given>
void settle(Bloom& bloom, Given const& given, Report const& report) {
    std::string_view const useless = settle_kind(bloom, given);
    if (useless.empty()) return;
    report.fail(useless, in_quotes(useless) + " of " + report.title() +
                             " is a parameter of another kind than '" +
                             schema::TextForm<BloomKind>::write(bloom.kind) + "'");
}

} // namespace weft::scene
