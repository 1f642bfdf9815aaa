#include "io/transform_reader.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "scene/check.h"
#include "schema/text.h"

namespace weft::io {

namespace {

void check_names(XmlElement const& e, std::span<std::string const> known) {
    for (XmlAttribute const& a : e.attributes)
        if (std::find(known.begin(), known.end(), a.name) == known.end())
            throw InputError(a.where, "unknown parameter " + in_quotes(a.name) + " of <" + e.tag +
                                          ">" + suggestion(a.name, known));
    if (!e.children.empty())
        throw InputError(e.children.front()->where, "<" + e.tag + "> has no child tags, found <" +
                                                        e.children.front()->tag + ">");
}

XmlAttribute const& required(XmlElement const& e, std::string const& name, char const* form) {
    XmlAttribute const* a = e.find(name);
    if (!a) throw InputError(e.where, "<" + e.tag + "> expects " + name + "=\"" + form + "\"");
    return *a;
}

InputError unexpected(XmlElement const& e, XmlAttribute const& a, char const* expected) {
    return {a.where, "'" + a.name + "' of <" + e.tag + "> expects " + expected + ", found " +
                         in_quotes(a.value)};
}

double read_number(XmlElement const& e, XmlAttribute const& a) {
    auto const v = schema::read_components(a.value, 1);
    if (!v) throw unexpected(e, a, "a number");
    return v->front();
}

Vec3d read_vector(XmlElement const& e, std::string const& name) {
    XmlAttribute const& a = required(e, name, "x,y,z");
    auto const v = schema::read_components(a.value, 3);
    if (!v || schema::read_components(a.value, 1)) throw unexpected(e, a, "3 numbers (x, y, z)");
    return {(*v)[0], (*v)[1], (*v)[2]};
}

Vec3d read_direction(XmlElement const& e, std::string const& name) {
    Vec3d const v = read_vector(e, name);
    if (!(length_squared(v) > 0))
        throw unexpected(e, *e.find(name), "a direction, not a vector of length 0");
    return normalize(v);
}

/// `value` (one number stands for all three), or x, y and z with `rest` for those left out.
Vec3d read_value_or_xyz(XmlElement const& e, double rest) {
    check_names(e, std::array<std::string, 4>{"value", "x", "y", "z"});
    if (e.attributes.empty())
        throw InputError(e.where, "<" + e.tag + "> expects value=\"x,y,z\", or x, y and z");
    if (XmlAttribute const* value = e.find("value")) {
        for (XmlAttribute const& a : e.attributes)
            if (&a != value)
                throw InputError(a.where,
                                 "<" + e.tag + "> expects 'value' or x, y and z, found both");
        auto const v = schema::read_components(value->value, 3);
        if (!v) throw unexpected(e, *value, schema::TextForm<Vec3>::expected.data());
        return {(*v)[0], (*v)[1], (*v)[2]};
    }
    Vec3d v(rest);
    for (int axis = 0; axis < 3; ++axis)
        if (XmlAttribute const* a = e.find(std::string(1, char('x' + axis))))
            v[axis] = read_number(e, *a);
    return v;
}

/// Rodrigues' rotation formula, column by column.
Affined rotation(Vec3d const& axis, double degrees) {
    double const angle = degrees * (M_PI / 180), c = std::cos(angle), s = std::sin(angle);
    auto turn = [&](Vec3d const& v) {
        return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
    };
    return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1}), Vec3d(0)};
}

Affined read_rotate(XmlElement const& e) {
    check_names(e, std::array<std::string, 2>{"axis", "angle"});
    return rotation(read_direction(e, "axis"), read_number(e, required(e, "angle", "degrees")));
}

Affined read_lookat(XmlElement const& e) {
    check_names(e, std::array<std::string, 3>{"origin", "target", "up"});
    Vec3d const origin = read_vector(e, "origin"), target = read_vector(e, "target");
    Vec3d const up = e.find("up") ? read_direction(e, "up") : Vec3d(0, 1, 0);
    Vec3d const view = target - origin;
    if (!(length_squared(view) > 0))
        throw InputError(e.where, "<lookat> expects origin and target to differ");
    Vec3d const z = normalize(view), x = cross(up, z);
    if (length(x) < 1e-9)
        throw InputError(e.where, "<lookat> expects 'up' not to lie along the view direction");
    return {normalize(x), cross(z, normalize(x)), z, origin};
}

Affined read_matrix(XmlElement const& e) {
    check_names(e, std::array<std::string, 1>{"value"});
    XmlAttribute const& value = required(e, "value", "16 numbers, row by row");
    Affined m;
    if (!schema::TextForm<Affined>::read(value.value, m))
        throw unexpected(e, value, schema::TextForm<Affined>::expected.data());
    return m;
}

Affined read_step(XmlElement const& e) {
    Affined step;
    if (e.tag == "translate") {
        step.origin = read_value_or_xyz(e, 0);
    } else if (e.tag == "scale") {
        Vec3d const s = read_value_or_xyz(e, 1);
        step = {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, Vec3d(0)};
    } else if (e.tag == "rotate") {
        step = read_rotate(e);
    } else if (e.tag == "matrix") {
        step = read_matrix(e);
    } else if (e.tag == "lookat") {
        step = read_lookat(e);
    } else {
        static std::array<std::string, 5> const known{"translate", "scale", "rotate", "matrix",
                                                      "lookat"};
        throw InputError(e.where,
                         "unknown tag <" + e.tag + "> in <transform>" + suggestion(e.tag, known));
    }
    return step;
}

} // namespace

void check_invertible(Affined const& m, SourceLocation const& where) {
    if (!scene::is_invertible(m)) throw InputError(where, scene::not_invertible_message(m));
}

Affined read_transform(XmlElement const& element) {
    for (XmlAttribute const& a : element.attributes)
        if (a.name != "id" && a.name != "name")
            throw InputError(a.where, "unknown parameter " + in_quotes(a.name) +
                                          " of <transform>; its operations are child tags");
    Affined m;
    for (auto const& child : element.children) m = read_step(*child) * m;
    check_invertible(m, element.where);
    return m;
}

} // namespace weft::io
