#include "bench/mesh_file.h"

#include <cstring>
#include <fstream>
#include <stdexcept>

namespace weft::bench {

namespace {

class Bytes {
  public:
    void text(std::string const& s) { bytes_ += s; }
    template <class T>
    void add(T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        bytes_.append(raw, sizeof(T));
    }
    void add(Vec3 const& v) {
        for (int axis = 0; axis < 3; ++axis) add(v[axis]);
    }
    void add_face(std::initializer_list<uint32_t> corners) {
        add(uint8_t(corners.size()));
        for (uint32_t c : corners) add(c);
    }
    void write(std::string const& path) const {
        std::ofstream file(path, std::ios::binary);
        file.write(bytes_.data(), std::streamsize(bytes_.size()));
        if (!file.flush()) throw std::runtime_error("cannot write " + path);
    }

  private:
    std::string bytes_;
};

std::string header(size_t vertices, std::string const& properties, size_t faces) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) + "\n";
    for (char const* p : {"x", "y", "z"}) text += "property float " + std::string(p) + "\n";
    return text + properties + "element face " + std::to_string(faces) +
           "\nproperty list uchar uint vertex_indices\nend_header\n";
}

/// The unit normal by central differences, taken a little inside of the square: at its edge a
/// pole may be, where one derivative vanishes.
Vec3 normal_at(Vec2 uv, Vec3 (*p)(Vec2)) {
    constexpr float step = 1e-4f;
    uv.y = std::clamp(uv.y, 2 * step, 1 - 2 * step);
    Vec3 const du = p({uv.x + step, uv.y}) - p({uv.x - step, uv.y});
    Vec3 const dv = p({uv.x, uv.y + step}) - p({uv.x, uv.y - step});
    return normalize(cross(du, dv));
}

} // namespace

void write_grid(std::string const& path, uint32_t columns, uint32_t rows, Vec3 (*p)(Vec2)) {
    Bytes out;
    std::string properties;
    for (char const* name : {"nx", "ny", "nz", "s", "t"})
        properties += "property float " + std::string(name) + "\n";
    out.text(header(size_t(columns + 1) * (rows + 1), properties, size_t(columns) * rows * 2));
    for (uint32_t j = 0; j <= rows; ++j)
        for (uint32_t i = 0; i <= columns; ++i) {
            Vec2 const uv(float(i) / float(columns), float(j) / float(rows));
            out.add(p(uv));
            out.add(normal_at(uv, p));
            out.add(uv.x);
            out.add(uv.y);
        }
    for (uint32_t j = 0; j < rows; ++j)
        for (uint32_t i = 0; i < columns; ++i) {
            uint32_t const a = j * (columns + 1) + i, b = a + columns + 1;
            out.add_face({a, a + 1, b + 1});
            out.add_face({a, b + 1, b});
        }
    out.write(path);
}

void write_quads(std::string const& path, std::vector<std::array<Vec3, 4>> const& quads) {
    Bytes out;
    out.text(header(quads.size() * 4, "", quads.size()));
    for (auto const& quad : quads)
        for (Vec3 const& corner : quad) out.add(corner);
    for (uint32_t i = 0; i < quads.size(); ++i)
        out.add_face({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
    out.write(path);
}

} // namespace weft::bench
