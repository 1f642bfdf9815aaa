#include "world/solidity.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace weft::world {

namespace {

/// Returns for each vertex of a mesh the first one at the same position: meshes double vertices
/// where their normals or uvs differ.
std::vector<uint32_t> merged_vertices(MeshData const& mesh) {
    std::vector<uint32_t> order(mesh.vertices.size()), merged(mesh.vertices.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    auto const key = [&](uint32_t i) {
        Vec3 const& p = mesh.vertices[i].p;
        return std::tuple(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return std::tuple(key(a), a) < std::tuple(key(b), b);
    });
    for (size_t i = 0; i < order.size(); ++i) {
        bool const same = i > 0 && key(order[i]) == key(order[i - 1]);
        merged[order[i]] = same ? merged[order[i - 1]] : order[i];
    }
    return merged;
}

using Edge = std::pair<uint32_t, uint32_t>;

/// Returns for each of some vertices the first one that lies where it does but for rounding, as at
/// the seam of what was turned on a lathe.
std::map<uint32_t, uint32_t> welded(MeshData const& mesh, std::set<uint32_t> const& vertices) {
    auto const place = [&](uint32_t v) -> Vec3 const& { return mesh.vertices[v].p; };
    float largest = 0;
    for (auto const& v : mesh.vertices) largest = std::max(largest, max_component(abs(v.p)));
    float const rounding = 1e-6f * largest;
    std::vector<uint32_t> order(vertices.begin(), vertices.end());
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return place(a).x < place(b).x; });
    std::map<uint32_t, uint32_t> weld;
    for (size_t i = 0; i < order.size(); ++i) {
        weld[order[i]] = order[i];
        for (size_t k = i; k-- > 0 && place(order[i]).x - place(order[k]).x <= rounding;)
            if (max_component(abs(place(order[i]) - place(order[k]))) <= rounding) {
                weld[order[i]] = weld[order[k]];
                break;
            }
    }
    return weld;
}

/// Returns how many of these edges, which an odd number of faces has each, are open when vertices
/// that rounding has parted are one.
size_t count_open(MeshData const& mesh, std::vector<Edge> edges) {
    std::set<uint32_t> ends;
    for (auto const& [a, b] : edges) ends.insert({a, b});
    auto const weld = welded(mesh, ends);
    for (auto& [a, b] : edges) std::tie(a, b) = std::minmax(weld.at(a), weld.at(b));
    std::sort(edges.begin(), edges.end());
    size_t open = 0;
    for (size_t first = 0, last; first < edges.size(); first = last) {
        for (last = first; last < edges.size() && edges[last] == edges[first];) ++last;
        open += edges[first].first != edges[first].second && (last - first) % 2;
    }
    return open;
}

/// Returns the first vertex of the shell that a vertex belongs to, and shortens the way there.
uint32_t shell_of(std::vector<uint32_t>& shells, uint32_t v) {
    while (shells[v] != v) v = shells[v] = shells[shells[v]];
    return v;
}

/// Returns six times the volume that the triangle adds, positive where its front looks outwards.
double volume_of(MeshData const& mesh, scene::Mesh::Triangle const& t, Vec3d const& origin) {
    Vertex const &a = mesh.vertices[t.v[0]], &b = mesh.vertices[t.v[1]], &c = mesh.vertices[t.v[2]];
    Vec3d const p(a.p), area = cross(Vec3d(b.p) - p, Vec3d(c.p) - p);
    double const volume = dot(p - origin, area);
    // Which side is the front: as `point_on` has it.
    if (mesh.smooth) return dot(area, Vec3d(a.n + b.n + c.n)) < 0 ? -volume : volume;
    return mesh.mirrored ? -volume : volume;
}

} // namespace

Solidity solidity(TriangleMesh const& geometry) {
    MeshData const& mesh = *geometry.data;
    std::vector<uint32_t> const merged = merged_vertices(mesh);
    std::vector<uint32_t> shells(merged.size()); // of each vertex, another one of its shell
    std::iota(shells.begin(), shells.end(), 0u);
    std::vector<Edge> edges, odd;
    double volume = 0;
    for (auto const& t : mesh.source->triangles) {
        uint32_t const v[3]{merged[t.v[0]], merged[t.v[1]], merged[t.v[2]]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue; // no area, no edge
        for (int k = 0; k < 3; ++k) {
            edges.push_back(std::minmax(v[k], v[(k + 1) % 3]));
            shells[shell_of(shells, v[k])] = shell_of(shells, v[0]);
        }
        volume += volume_of(mesh, t, Vec3d(mesh.vertices[0].p));
    }
    std::sort(edges.begin(), edges.end());
    Solidity s;
    for (size_t first = 0, last; first < edges.size(); first = last) {
        for (last = first; last < edges.size() && edges[last] == edges[first];) ++last;
        ++s.edges;
        if ((last - first) % 2) odd.push_back(edges[first]);
        s.has_parts |= last - first > 2;
        s.has_parts |= shell_of(shells, edges[first].first) != shell_of(shells, edges[0].first);
    }
    s.open_edges = count_open(mesh, std::move(odd));
    s.inwards = s.open_edges == 0 && volume < 0;
    return s;
}

} // namespace weft::world
