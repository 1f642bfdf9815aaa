// check(Scene): ids that lead somewhere, numbers in their ranges, files that are there, and no
// object inside of itself; then the rules of every object.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/match.h"
#include "scene/check.h"
#include "scene/scene_vectors.h"
#include "schema/messages.h"

namespace weft::scene {

namespace {

/// An object without a reader: its title says the type, and its place which one it is.
class ObjectReport final : public Report {
  public:
    ObjectReport(schema::TypeInfo const& info, SourceLocation (*place)(Scene const&, int32_t),
                 Scene const& scene, int32_t index)
        : info_(info), place_(place), scene_(scene), index_(index) {}
    std::string title() const override {
        std::string const tag = "<" + std::string(info_.category);
        return info_.type.empty() ? tag + ">" : tag + " type=\"" + std::string(info_.type) + "\">";
    }
    SourceLocation where(std::string_view) const override { return place_(scene_, index_); }

  private:
    schema::TypeInfo const& info_;
    SourceLocation (*place_)(Scene const&, int32_t);
    Scene const& scene_;
    int32_t index_;
};

/// Calls f(object, report) for an object or for what a variant holds.
template <class F>
void with_report(SceneContents const& contents, Scene const& scene, F const& f) {
    auto const place = [](Scene const&, int32_t) { return SourceLocation{"scene"}; };
    f(contents, ObjectReport(SceneContents::info, place, scene, 0));
}
template <class Kind, class T, class F>
void with_report(T const& object, Scene const& scene, int32_t index, F const& f) {
    auto const place = [](Scene const& s, int32_t i) {
        return location_of(s, schema::Id<Kind>{i});
    };
    if constexpr (requires { T::info; })
        f(object, ObjectReport(T::info, place, scene, index));
    else
        match(object, [&](auto const& o) { f(o, ObjectReport(o.info, place, scene, index)); });
}

/// Calls f(object, report) for all that a scene describes.
template <class F>
void for_each_object(Scene const& scene, F const& f) {
    for_each_vector(kObjectVectors, [&]<class Kind, class T>(ObjectVector<Kind, T> const& v) {
        std::vector<T> const& list = scene.*v.member;
        for (size_t i = 0; i < list.size(); ++i) with_report<Kind>(list[i], scene, int32_t(i), f);
    });
    with_report(scene.contents, scene, f);
}

/// Passed to `describe`: looks at each parameter by itself.
struct ParameterCheck {
    Scene const& scene;
    Report const& report;

    template <class Kind>
    void operator()(std::string_view name, schema::Id<Kind> id, schema::Attr const& attr) {
        if (id || id.index != -1) return expect_index(name, id);
        if (attr.required) missing(name, attr, "object", Kind::category);
    }
    template <class Kind>
    void operator()(std::string_view name, std::vector<schema::Id<Kind>> const& ids,
                    schema::Attr const& attr) {
        for (schema::Id<Kind> id : ids) expect_index(name, id);
        if (attr.required && ids.empty()) missing(name, attr, "list", Kind::category);
    }
    template <class T>
    void operator()(std::string_view name, Input<T> const& in, schema::Attr const& attr) {
        if (in.texture)
            expect_index(name, in.texture);
        else if constexpr (!schema::SurfaceDefault<T>)
            expect_in_range(name, in.value, attr);
    }
    void operator()(std::string_view name, FileName const& file, schema::Attr const& attr) {
        if (attr.required && file.path.empty() && file.resource < 0)
            missing(name, attr, schema::TextForm<FileName>::kind, "");
    }
    void operator()(std::string_view name, Affined const& transform, schema::Attr const&) {
        if (!is_invertible(transform)) report.fail(name, not_invertible_message(transform));
    }
    template <schema::Choice E>
    void operator()(std::string_view name, E const& value, schema::Attr const&) {
        if (size_t(value) >= choices(value).size())
            report.fail(name, title_of(name) + " expects one of " +
                                  std::to_string(choices(value).size()) +
                                  " choices, found number " + std::to_string(int(value)));
    }
    void operator()(std::string_view name, schema::ColorStops const& value, schema::Attr const&) {
        bool ascending = !value.stops.empty();
        for (size_t i = 1; i < value.stops.size(); ++i)
            ascending &= value.stops[i].position > value.stops[i - 1].position;
        if (!ascending)
            report.fail(name, title_of(name) + " expects " +
                                  std::string(schema::TextForm<schema::ColorStops>::expected) +
                                  ", found '" + schema::TextForm<schema::ColorStops>::write(value) +
                                  "'");
    }
    void operator()(std::string_view, bool, schema::Attr const&) {}
    void operator()(std::string_view, std::string const&, schema::Attr const&) {}
    void operator()(std::string_view, SharedText const&, schema::Attr const&) {}
    template <class T>
    void operator()(std::string_view name, T const& value, schema::Attr const& attr) {
        expect_in_range(name, value, attr);
    }
    template <class T>
    void group(T const& member) {
        schema::read_members(member, *this);
    }

  private:
    std::string title_of(std::string_view name) const {
        return "'" + std::string(name) + "' of " + report.title();
    }
    [[noreturn]] void missing(std::string_view name, schema::Attr const& attr,
                              std::string_view kind, std::string_view category) const {
        report.fail("", report.title() + " expects " +
                            schema::missing_phrase(name, kind, category) +
                            ", found none: " + std::string(attr.help));
    }
    template <class Kind>
    void expect_index(std::string_view name, schema::Id<Kind> id) const {
        size_t const size = objects<Kind>(scene).size();
        if (id.index < 0 || size_t(id.index) >= size)
            report.fail(name, title_of(name) + " expects one of the scene's " +
                                  std::to_string(size) + " objects <" + Kind::category +
                                  ">, found index " + std::to_string(id.index));
    }
    template <class T>
    void expect_in_range(std::string_view name, T const& value, schema::Attr const& attr) const {
        // NaN is in no range, and infinity in none of those that are open.
        constexpr double most = std::numeric_limits<double>::max();
        schema::Attr finite = attr;
        finite.min = std::max(attr.min, -most);
        finite.max = std::min(attr.max, most);
        if (schema::in_range(value, finite)) return;
        std::string const text = schema::TextForm<T>::write(value);
        bool const open = !std::isfinite(attr.min) && !std::isfinite(attr.max);
        report.fail(name, title_of(name) + " expects a " +
                              (open ? "finite value" : "value of " + schema::range_phrase(attr)) +
                              ", found '" + text + "'");
    }
};

/// Passed to `describe`: what nodes give has to fit what the inputs take.
struct ConnectionCheck {
    Facts& facts;
    Report const& report;

    template <class T>
    void operator()(std::string_view name, Input<T> const& in, schema::Attr const&) {
        if (!in.texture) return;
        ValueType const wanted = schema::input_type<T>, given = facts.type_of(in.texture);
        if (accepts(wanted, given)) return;
        report.fail(name, "'" + std::string(name) + "' of " + report.title() + " expects a " +
                              std::string(schema::type_name(wanted)) + ", found a " +
                              std::string(schema::type_name(given)) +
                              "; `convert` and `extract` make one of the other");
    }
    template <class T>
    void operator()(std::string_view, T const&, schema::Attr const&) {}
    template <class T>
    void group(T const& member) {
        schema::read_members(member, *this);
    }
};

// Files: what a FileName refers to must be loaded.

void expect_resource(std::string_view name, FileName const& file, size_t count,
                     Report const& report) {
    if (file.resource < 0 || size_t(file.resource) >= count)
        report.fail(name, "'" + std::string(name) + "' of " + report.title() +
                              " expects one of the scene's " + std::to_string(count) +
                              " files of its sort, found index " + std::to_string(file.resource));
}

template <class T>
void check_files(T const&, Scene const&, Report const&) {}
void check_files(MeshShape const& shape, Scene const& scene, Report const& report) {
    expect_resource("filename", shape.filename, scene.meshes.size(), report);
}
void check_files(IesLight const& light, Scene const& scene, Report const& report) {
    expect_resource("filename", light.filename, scene.photometries.size(), report);
}
void check_files(ThinLens const& camera, Scene const& scene, Report const& report) {
    if (camera.bokeh != FileName{})
        expect_resource("bokeh", camera.bokeh, scene.images.size(), report);
}
void check_files(ImageTexture const& texture, Scene const& scene, Report const& report) {
    bool const set = texture.filename.path.find(kUdim) != std::string::npos;
    expect_resource("filename", texture.filename, set ? scene.udims.size() : scene.images.size(),
                    report);
}

SourceLocation nth(char const* what, size_t index) { return {what + std::to_string(index)}; }

/// What the files hold, by itself.
void check_resources(Scene const& scene) {
    auto const expect_there = [](auto const& list, char const* what) {
        for (size_t i = 0; i < list.size(); ++i)
            if (!list[i]) throw InputError(nth(what, i), "expected a loaded file, found none");
    };
    expect_there(scene.meshes, "mesh ");
    expect_there(scene.images, "image ");
    expect_there(scene.photometries, "photometry ");
    for (size_t i = 0; i < scene.meshes.size(); ++i) validate(*scene.meshes[i], nth("mesh ", i));
    for (size_t i = 0; i < scene.photometries.size(); ++i)
        validate(*scene.photometries[i], nth("photometry ", i));
    for (size_t i = 0; i < scene.udims.size(); ++i)
        for (UdimTile const& tile : scene.udims[i])
            if (tile.image < 0 || size_t(tile.image) >= scene.images.size())
                throw InputError(nth("set of images ", i), "expected one of the scene's " +
                                                               std::to_string(scene.images.size()) +
                                                               " images, found index " +
                                                               std::to_string(tile.image));
}

/// Looks for objects that contain themselves, and for chains of references that are too long: what
/// walks over a scene may recurse.
class NestingCheck {
  public:
    explicit NestingCheck(Scene const& scene) : scene_(scene) {
        for_each_object(scene, [&](auto const& object, Report const& report) {
            schema::read_members(object, Visitor{*this, report, 0});
        });
    }

  private:
    /// Passed to `describe`: goes to what an object refers to. `height` is the longest chain below.
    struct Visitor {
        NestingCheck& check;
        Report const& report;
        int depth;
        int height = 0;

        template <class Kind>
        void operator()(std::string_view, schema::Id<Kind> id, schema::Attr const&) {
            if (id) height = std::max(height, 1 + check.visit(id, depth + 1, report));
        }
        template <class Kind>
        void operator()(std::string_view, std::vector<schema::Id<Kind>> const& ids,
                        schema::Attr const&) {
            for (schema::Id<Kind> id : ids)
                height = std::max(height, 1 + check.visit(id, depth + 1, report));
        }
        template <class T>
        void operator()(std::string_view, Input<T> const& in, schema::Attr const&) {
            if (in.texture)
                height = std::max(height, 1 + check.visit(in.texture, depth + 1, report));
        }
        template <class T>
        void operator()(std::string_view, T const&, schema::Attr const&) {}
        template <class T>
        void group(T const& member) {
            schema::read_members(member, *this);
        }
    };

    static constexpr int kUnknown = -1, kOpen = -2;

    template <class Kind>
    int visit(schema::Id<Kind> id, int depth, Report const& from) {
        constexpr size_t list = detail::position_of<Kind>();
        std::vector<int16_t>& heights = heights_[list];
        heights.resize(objects<Kind>(scene_).size(), int16_t(kUnknown));
        int16_t const known = heights[size_t(id.index)];
        if (known == kOpen) from.fail("", from.title() + " contains itself");
        if (depth + std::max(int(known), 0) > kMaxDepth)
            from.fail("", "expected objects nested at most " + std::to_string(kMaxDepth) +
                              " deep, found more by following references");
        if (known >= 0) return known;
        heights[size_t(id.index)] = int16_t(kOpen);
        int height = 0;
        with_report<Kind>(objects<Kind>(scene_)[size_t(id.index)], scene_, id.index,
                          [&](auto const& object, Report const& report) {
                              Visitor visitor{*this, report, depth};
                              schema::read_members(object, visitor);
                              height = visitor.height;
                          });
        heights[size_t(id.index)] = int16_t(height);
        return height;
    }

    Scene const& scene_;
    std::array<std::vector<int16_t>, std::tuple_size_v<decltype(kObjectVectors)>> heights_;
};

} // namespace

void check(Scene const& scene) {
    for_each_object(scene, [&](auto const& object, Report const& report) {
        schema::read_members(object, ParameterCheck{scene, report});
        check_files(object, scene, report);
    });
    check_resources(scene);
    NestingCheck{scene};
    Facts facts(scene);
    for_each_object(scene, [&](auto const& object, Report const& report) {
        schema::read_members(object, ConnectionCheck{facts, report});
        check_object(object, facts, report);
    });
}

} // namespace weft::scene
