#include "scene/mesh.h"

#include <array>

namespace weft::scene {

namespace {

/// A corner projected along an axis. Differences and products of floats are near exact here.
struct Point {
    double x, y;
};

/// Twice the signed area of abc; positive for a left turn at b.
double turn(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

bool same(Point a, Point b) { return a.x == b.x && a.y == b.y; }

/// Newell's sum: twice the vector area of a closed polygon.
Vec3d vector_area(std::span<Vec3 const> positions, std::span<uint32_t const> polygon) {
    Vec3d const origin(positions[polygon[0]]);
    Vec3d sum(0);
    for (size_t i = 1; i + 1 < polygon.size(); ++i)
        sum +=
            cross(Vec3d(positions[polygon[i]]) - origin, Vec3d(positions[polygon[i + 1]]) - origin);
    return sum;
}

/// The projection that keeps the most area, mirrored where needed to turn left.
Point project(Vec3 const& p, Vec3d const& normal) {
    double const ax = std::abs(normal.x), ay = std::abs(normal.y), az = std::abs(normal.z);
    if (ax > ay && ax > az) return normal.x > 0 ? Point{p.y, p.z} : Point{p.z, p.y};
    if (ay > az) return normal.y > 0 ? Point{p.z, p.x} : Point{p.x, p.z};
    return normal.z > 0 ? Point{p.x, p.y} : Point{p.y, p.x};
}

/// Ear clipping over a circular list. An ear's state changes only where a neighbour goes, so
/// n corners cost at most 3 n tests of n points each.
class EarClipper {
  public:
    explicit EarClipper(std::vector<Point> points)
        : points_(std::move(points)), next_(points_.size()), previous_(points_.size()),
          ear_(points_.size()), reflex_(points_.size()) {
        size_t const n = points_.size();
        for (size_t i = 0; i < n; ++i) {
            next_[i] = uint32_t((i + 1) % n);
            previous_[i] = uint32_t((i + n - 1) % n);
        }
        for (uint32_t i = 0; i < n; ++i) reflex_[i] = turn_at(i) <= 0;
        for (uint32_t i = 0; i < n; ++i) ear_[i] = is_ear(i);
    }

    /// Calls emit(a, b, c) n - 2 times.
    template <class Emit>
    void run(Emit&& emit) {
        uint32_t at = 0;
        for (size_t left = points_.size(); left > 3; --left) {
            uint32_t const start = at;
            while (!ear_[at] && (at = next_[at]) != start) {
            }
            // No ear: the polygon crosses itself or is flat, and any corner will do.
            uint32_t const before = previous_[at], after = next_[at];
            emit(before, at, after);
            next_[before] = after;
            previous_[after] = before;
            for (uint32_t i : {before, after}) reflex_[i] = turn_at(i) <= 0;
            for (uint32_t i : {before, after}) ear_[i] = is_ear(i);
            // Skipping a corner keeps the clipped ears from forming one long fan of slivers.
            at = next_[after];
        }
        emit(previous_[at], at, next_[at]);
    }

  private:
    double turn_at(uint32_t i) const {
        return turn(points_[previous_[i]], points_[i], points_[next_[i]]);
    }
    bool is_ear(uint32_t i) const {
        if (reflex_[i]) return false;
        Point const a = points_[previous_[i]], b = points_[i], c = points_[next_[i]];
        for (uint32_t j = next_[next_[i]]; j != previous_[i]; j = next_[j]) {
            if (!reflex_[j]) continue;
            Point const p = points_[j];
            // Corners repeat where a hole is bridged to the outline; they do not block.
            if (same(p, a) || same(p, b) || same(p, c)) continue;
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    }

    std::vector<Point> points_;
    std::vector<uint32_t> next_, previous_;
    std::vector<char> ear_, reflex_;
};

void cut_quad(std::span<Vec3 const> positions, std::span<uint32_t const> q,
              std::vector<Mesh::Triangle>& triangles) {
    Vec3d const normal = vector_area(positions, q);
    std::array<Point, 4> p;
    for (size_t i = 0; i < 4; ++i) p[i] = project(positions[q[i]], normal);
    size_t sharpest = 0;
    std::array<double, 4> turns;
    for (size_t i = 0; i < 4; ++i) {
        turns[i] = turn(p[(i + 3) % 4], p[i], p[(i + 1) % 4]);
        if (turns[i] < turns[sharpest]) sharpest = i;
    }
    bool odd = sharpest % 2 == 1;
    if (turns[sharpest] > 0)
        odd = length_squared(positions[q[1]] - positions[q[3]]) <
              length_squared(positions[q[0]] - positions[q[2]]);
    if (odd) {
        triangles.push_back({{q[0], q[1], q[3]}});
        triangles.push_back({{q[1], q[2], q[3]}});
    } else {
        triangles.push_back({{q[0], q[1], q[2]}});
        triangles.push_back({{q[0], q[2], q[3]}});
    }
}

/// Length 1 without overflow or underflow; (0, 0, 0) stays.
Vec3 unit(Vec3 const& n) {
    float const l2 = length_squared(n);
    if (l2 > 1e-20f && l2 < 1e20f) return n * (1 / std::sqrt(l2));
    float const scale = max_component(abs(n));
    return scale > 0 ? Vec3(normalize(Vec3d(n) / double(scale))) : Vec3(0);
}

std::string describe(Vec3 const& v) {
    return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) +
           ")";
}

[[noreturn]] void reject(SourceLocation const& where, char const* what, size_t vertex,
                         Vec3 const& found, char const* expected) {
    throw InputError(where, std::string("expected ") + expected + ", found " + describe(found) +
                                " as the " + what + " of vertex " + std::to_string(vertex));
}

void check_length(size_t found, size_t vertices, char const* what, SourceLocation const& where) {
    if (found != 0 && found != vertices)
        throw InputError(where, std::string("expected 0 or ") + std::to_string(vertices) + " " +
                                    what + ", one per vertex, found " + std::to_string(found));
}

} // namespace

void validate(Mesh const& mesh, SourceLocation const& where) {
    size_t const n = mesh.positions.size();
    check_length(mesh.normals.size(), n, "normals", where);
    check_length(mesh.uvs.size(), n, "uvs", where);
    check_length(mesh.colors.size(), n, "colours", where);
    for (VertexAttribute const& a : mesh.attributes)
        check_length(a.values.size(), n * size_t(a.components), a.name.c_str(), where);
    for (size_t i = 0; i < n; ++i)
        if (!is_finite(mesh.positions[i]))
            reject(where, "position", i, mesh.positions[i], "finite numbers");
    for (size_t i = 0; i < mesh.normals.size(); ++i) {
        Vec3 const& m = mesh.normals[i];
        if (!is_finite(m)) reject(where, "normal", i, m, "finite numbers");
        if (std::abs(length_squared(m) - 1) > 2e-3f)
            reject(where, "normal", i, m, "a vector of length 1");
    }
    for (size_t i = 0; i < mesh.uvs.size(); ++i)
        if (Vec3 const uv(mesh.uvs[i].x, mesh.uvs[i].y, 0); !is_finite(uv))
            reject(where, "uv", i, uv, "finite numbers");
    for (size_t i = 0; i < mesh.colors.size(); ++i)
        if (Color const& c = mesh.colors[i]; !is_finite(c))
            reject(where, "colour", i, {c.r, c.g, c.b}, "finite numbers");
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        for (uint32_t v : mesh.triangles[i].v)
            if (v >= n)
                throw InputError(where, "triangle " + std::to_string(i) + " uses vertex " +
                                            std::to_string(v) + ", but the mesh has " +
                                            std::to_string(n) + " vertices, counted from 0");
}

bool triangulate(std::span<Vec3 const> positions, std::span<uint32_t const> polygon,
                 std::vector<Mesh::Triangle>& triangles) {
    size_t const n = polygon.size();
    if (n == 3) {
        triangles.push_back({{polygon[0], polygon[1], polygon[2]}});
        return true;
    }
    if (n == 4) {
        cut_quad(positions, polygon, triangles);
        return true;
    }
    Vec3d const normal = vector_area(positions, polygon);
    std::vector<Point> points(n);
    for (size_t i = 0; i < n; ++i) points[i] = project(positions[polygon[i]], normal);
    bool convex = true;
    for (size_t i = 0; i < n && convex; ++i)
        convex = turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) > 0;
    if (convex) {
        for (size_t i = 1; i + 1 < n; ++i)
            triangles.push_back({{polygon[0], polygon[i], polygon[i + 1]}});
        return true;
    }
    if (n > kMaxConcaveCorners) return false;
    EarClipper(std::move(points)).run([&](uint32_t a, uint32_t b, uint32_t c) {
        triangles.push_back({{polygon[a], polygon[b], polygon[c]}});
    });
    return true;
}

void unify_normals(Mesh& mesh) {
    bool missing = false;
    for (Vec3& n : mesh.normals) {
        n = unit(n);
        missing |= n == Vec3(0);
    }
    if (!missing) return;
    for (Mesh::Triangle const& t : mesh.triangles) {
        bool const wanted = mesh.normals[t.v[0]] == Vec3(0) || mesh.normals[t.v[1]] == Vec3(0) ||
                            mesh.normals[t.v[2]] == Vec3(0);
        if (!wanted) continue;
        // In doubles, for triangles so small that their area is no float.
        Vec3d const a(mesh.positions[t.v[0]]);
        Vec3d const geometric =
            cross(Vec3d(mesh.positions[t.v[1]]) - a, Vec3d(mesh.positions[t.v[2]]) - a);
        double const l = length(geometric);
        if (!(l > 0)) continue;
        for (uint32_t v : t.v)
            if (mesh.normals[v] == Vec3(0)) mesh.normals[v] = Vec3(geometric / l);
    }
    for (Vec3& n : mesh.normals)
        if (n == Vec3(0)) n = Vec3(0, 0, 1);
}

} // namespace weft::scene
