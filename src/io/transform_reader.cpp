#include "io/transform_reader.h"

#include <array>
#include <cmath>
#include <span>

#include "schema/text.h"

namespace weft::io {

namespace {

void check_attributes(XmlElement const& e, std::span<std::string const> known) {
    for (XmlAttribute const& a : e.attributes)
        if (std::find(known.begin(), known.end(), a.name) == known.end())
            throw InputError(a.where, "unknown parameter '" + a.name + "' of <" + e.tag + ">" +
                                          suggestion(a.name, known));
    if (!e.children.empty())
        throw InputError(e.children.front()->where,
                         "<" + e.tag + "> has no child tags, found <" + e.children.front()->tag + ">");
}

double read_number(XmlAttribute const& a) {
    auto const v = schema::read_components(a.value, 1);
    if (!v) throw InputError(a.where, "'" + a.name + "' expects a number, found '" + a.value + "'");
    return v->front();
}

Vec3d read_vector(XmlElement const& e, std::string const& name, bool grey_allowed) {
    XmlAttribute const* a = e.find(name);
    if (!a) throw InputError(e.where, "<" + e.tag + "> expects " + name + "=\"x,y,z\"");
    auto const v = schema::read_components(a->value, 3);
    auto const single = schema::read_components(a->value, 1);
    if (!v || (single && !grey_allowed))
        throw InputError(a->where, "'" + name + "' expects 3 numbers (x, y, z), found '" + a->value + "'");
    return {(*v)[0], (*v)[1], (*v)[2]};
}

/// `value`, or x, y and z with `rest` for those left out.
Vec3d read_value_or_xyz(XmlElement const& e, double rest) {
    check_attributes(e, std::array<std::string, 4>{"value", "x", "y", "z"});
    if (e.find("value")) {
        for (char const* axis : {"x", "y", "z"})
            if (XmlAttribute const* a = e.find(axis))
                throw InputError(a->where, "<" + e.tag + "> takes 'value' or x, y, z, found both");
        return read_vector(e, "value", true);
    }
    Vec3d v(rest);
    for (int axis = 0; axis < 3; ++axis)
        if (XmlAttribute const* a = e.find(std::string(1, char('x' + axis)))) v[axis] = read_number(*a);
    return v;
}

Vec3d read_direction(XmlElement const& e, std::string const& name) {
    Vec3d const v = read_vector(e, name, false);
    if (length_squared(v) == 0)
        throw InputError(e.find(name)->where, "'" + name + "' expects a direction, found 0,0,0");
    return normalize(v);
}

/// Rodrigues' rotation formula, column by column.
Affined rotation(Vec3d const& axis, double angle_degrees) {
    double const a = angle_degrees * (M_PI / 180), c = std::cos(a), s = std::sin(a);
    auto turn = [&](Vec3d const& v) {
        return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
    };
    return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1}), Vec3d(0)};
}

Affined read_rotate(XmlElement const& e) {
    check_attributes(e, std::array<std::string, 2>{"axis", "angle"});
    XmlAttribute const* angle = e.find("angle");
    if (!angle) throw InputError(e.where, "<rotate> expects angle=\"degrees\"");
    return rotation(read_direction(e, "axis"), read_number(*angle));
}

Affined read_lookat(XmlElement const& e) {
    check_attributes(e, std::array<std::string, 3>{"origin", "target", "up"});
    Vec3d const origin = read_vector(e, "origin", false), target = read_vector(e, "target", false);
    Vec3d const up = e.find("up") ? read_direction(e, "up") : Vec3d(0, 1, 0);
    if (origin == target) throw InputError(e.where, "<lookat> expects origin and target to differ");
    Vec3d const z = normalize(target - origin);
    Vec3d const x = cross(up, z);
    if (length(x) < 1e-9) throw InputError(e.where, "<lookat> expects 'up' not to lie along the view direction");
    return {normalize(x), cross(z, normalize(x)), z, origin};
}

Affined read_matrix(XmlElement const& e) {
    check_attributes(e, std::array<std::string, 1>{"value"});
    XmlAttribute const* value = e.find("value");
    if (!value) throw InputError(e.where, "<matrix> expects value=\"16 numbers, row by row\"");
    Affined m;
    if (!schema::TextForm<Affined>::read(value->value, m))
        throw InputError(value->where, "<matrix> expects 16 numbers, row by row, the last row 0,0,0,1; found '" + value->value + "'");
    return m;
}

} // namespace

Affined read_transform(XmlElement const& element) {
    static std::array<std::string, 5> const known{"translate", "scale", "rotate", "matrix", "lookat"};
    for (XmlAttribute const& a : element.attributes)
        if (a.name != "id" && a.name != "name")
            throw InputError(a.where, "unknown parameter '" + a.name + "' of <transform>; its operations are child tags");
    Affined m;
    for (auto const& child : element.children) {
        Affined step;
        if (child->tag == "translate") {
            step.origin = read_value_or_xyz(*child, 0);
        } else if (child->tag == "scale") {
            Vec3d const s = read_value_or_xyz(*child, 1);
            step = {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, Vec3d(0)};
        } else if (child->tag == "rotate") {
            step = read_rotate(*child);
        } else if (child->tag == "matrix") {
            step = read_matrix(*child);
        } else if (child->tag == "lookat") {
            step = read_lookat(*child);
        } else {
            throw InputError(child->where, "unknown tag <" + child->tag + "> in <transform>" + suggestion(child->tag, known));
        }
        m = step * m;
    }
    // Singular: the columns span no volume, relative to their lengths.
    double const volume = length(m.x) * length(m.y) * length(m.z);
    if (!(std::abs(m.determinant()) > 1e-12 * volume) || volume == 0)
        throw InputError(element.where, "expected an invertible transform, found a singular one (determinant " +
                                            schema::number_text(m.determinant()) + ")");
    return m;
}

} // namespace weft::io
