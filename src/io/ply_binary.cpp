#include "io/ply_body.h"

#include <bit>
#include <cstring>

namespace weft::io::ply {

namespace {

/// The value of type T at `p`, its bytes reversed where `swap`.
template <class T>
T load(char const* p, bool swap) {
    char raw[sizeof(T)];
    std::memcpy(raw, p, sizeof(T));
    if (swap) std::reverse(raw, raw + sizeof(T));
    return std::bit_cast<T>(raw);
}

/// Calls f with a zero of the C++ type that `s` names.
template <class F>
auto with_type(Scalar s, F&& f) {
    switch (s) {
    case Scalar::int8:
        return f(int8_t());
    case Scalar::uint8:
        return f(uint8_t());
    case Scalar::int16:
        return f(int16_t());
    case Scalar::uint16:
        return f(uint16_t());
    case Scalar::int32:
        return f(int32_t());
    case Scalar::uint32:
        return f(uint32_t());
    case Scalar::float32:
        return f(float());
    case Scalar::float64:
        break;
    }
    return f(double());
}

float load_float(Scalar s, char const* p, bool swap) {
    return with_type(s, [&](auto zero) { return float(load<decltype(zero)>(p, swap)); });
}
int64_t load_integer(Scalar s, char const* p, bool swap) {
    return with_type(s, [&](auto zero) { return int64_t(load<decltype(zero)>(p, swap)); });
}

/// Walks the bytes of a binary body.
class ByteCursor {
  public:
    ByteCursor(Source const& s, size_t at)
        : source_(s), p_(s.bytes.data() + at), end_(s.bytes.data() + s.bytes.size()),
          swap_((s.header.format == Format::big_endian) !=
                (std::endian::native == std::endian::big)) {}

    size_t offset() const { return size_t(p_ - source_.bytes.data()); }
    size_t left() const { return size_t(end_ - p_); }
    char const* position() const { return p_; }
    bool swap() const { return swap_; }

    /// The next `n` bytes of record `record`.
    char const* take(uint64_t n, Element const& e, uint64_t record) {
        if (n > left())
            fail(p_, "truncated in " + e.name + " " + std::to_string(record) + " of " +
                         std::to_string(e.count) + ": expected " + std::to_string(n) +
                         " more bytes, found " + std::to_string(left()));
        char const* const p = p_;
        p_ += n;
        return p;
    }
    void advance(size_t n) { p_ += n; }
    int64_t list_length(Element const& e, Property const& p, uint64_t record) {
        char const* const start = take(size_of(p.length_type), e, record);
        int64_t const n = load_integer(p.length_type, start, swap_);
        if (n < 0)
            fail(start, describe_value(e, p, record) + ": expected a list, found the length " +
                            std::to_string(n));
        return n;
    }
    void skip_property(Element const& e, Property const& p, uint64_t record) {
        uint64_t const n = p.is_list ? uint64_t(list_length(e, p, record)) : 1;
        take(n * size_of(p.type), e, record);
    }
    [[noreturn]] void fail(char const* p, std::string const& message) const {
        throw InputError({source_.name},
                         "byte " + std::to_string(p - source_.bytes.data()) + ": " + message);
    }
    void check_finite(Element const& e, Property const& p, uint64_t record, float value,
                      char const* where) const {
        if (!std::isfinite(value))
            fail(where, "expected a finite float as " + describe_value(e, p, record) + ", found " +
                            std::to_string(value));
    }

  private:
    Source const& source_;
    char const* p_;
    char const* end_;
    bool swap_;
};

/// One column of `n` records of `bytes` each from `p`; false where a value is not finite.
template <class T, bool Swap>
bool gather(char const* p, size_t bytes, size_t n, Column const& c, size_t first) {
    float* out = c.data + first * c.stride;
    bool finite = true;
    for (size_t i = 0; i < n; ++i, p += bytes, out += c.stride) {
        float const value = float(load<T>(p, Swap));
        finite &= std::isfinite(value);
        *out = value * c.scale;
    }
    return finite;
}

/// Records of one size, in blocks that stay in the first-level cache while every column passes.
void read_fixed_vertices(ByteCursor& in, Element const& e, std::vector<Column> const& columns) {
    constexpr size_t kBlock = 256;
    std::vector<size_t> offset(e.properties.size() + 1, 0);
    for (size_t k = 0; k < e.properties.size(); ++k)
        offset[k + 1] = offset[k] + size_of(e.properties[k].type);
    for (uint64_t first = 0; first < e.count; first += kBlock) {
        size_t const n = size_t(std::min<uint64_t>(kBlock, e.count - first));
        char const* const block = in.take(n * e.min_bytes, e, first);
        for (Column const& c : columns) {
            Property const& p = e.properties[c.property];
            char const* const start = block + offset[c.property];
            bool const finite = with_type(p.type, [&](auto zero) {
                using T = decltype(zero);
                return in.swap() ? gather<T, true>(start, e.min_bytes, n, c, first)
                                 : gather<T, false>(start, e.min_bytes, n, c, first);
            });
            for (size_t i = 0; !finite && i < n; ++i)
                in.check_finite(e, p, first + i, c.data[(first + i) * c.stride],
                                start + i * e.min_bytes);
        }
    }
}

void read_varying_vertices(ByteCursor& in, Element const& e, std::vector<Column> const& columns) {
    std::vector<Column const*> by_property(e.properties.size(), nullptr);
    for (Column const& c : columns) by_property[c.property] = &c;
    for (uint64_t i = 0; i < e.count; ++i) {
        for (size_t k = 0; k < e.properties.size(); ++k) {
            Property const& p = e.properties[k];
            Column const* const c = by_property[k];
            if (!c) {
                in.skip_property(e, p, i);
                continue;
            }
            char const* const start = in.take(size_of(p.type), e, i);
            float const value = load_float(p.type, start, in.swap());
            in.check_finite(e, p, i, value, start);
            c->data[i * c->stride] = value * c->scale;
        }
    }
}

void read_corners(ByteCursor& in, Element const& e, Property const& p, uint64_t face,
                  std::vector<uint32_t>& corners, scene::Mesh& mesh) {
    char const* const start = in.position();
    int64_t const n = in.list_length(e, p, face);
    if (n < 3) in.fail(start, describe_bad_length(face, n));
    size_t const size = size_of(p.type), vertices = mesh.positions.size();
    char const* const indices = in.take(uint64_t(n) * size, e, face);
    corners.clear();
    for (char const* q = indices; q != in.position(); q += size) {
        int64_t const index = load_integer(p.type, q, in.swap());
        if (index < 0 || index >= int64_t(vertices))
            in.fail(q, describe_bad_index(face, index, vertices));
        corners.push_back(uint32_t(index));
    }
    if (!scene::triangulate(mesh.positions, corners, mesh.triangles))
        in.fail(start, describe_bad_polygon(face, corners.size()));
}

/// What most files hold: a length of one byte and indices of four in this machine's byte order.
struct PlainTriangles {
    bool applies = false;
    size_t before = 0; ///< bytes of a record before the list
    size_t record = 0; ///< bytes of a record that holds a triangle
};

PlainTriangles find_plain_triangles(ByteCursor const& in, Element const& e, size_t list) {
    Property const& p = e.properties[list];
    PlainTriangles plain;
    plain.applies = !in.swap() && size_of(p.length_type) == 1 && size_of(p.type) == 4;
    plain.record = e.min_bytes + 3 * size_of(p.type);
    for (size_t k = 0; k < e.properties.size(); ++k) {
        if (k != list && e.properties[k].is_list) plain.applies = false;
        if (k < list) plain.before += size_of(e.properties[k].type);
    }
    return plain;
}

} // namespace

size_t read_binary_vertices(Source const& s, size_t at, scene::Mesh& mesh) {
    Element const& e = s.header.elements[s.header.vertex];
    std::vector<Column> const columns = make_columns(s.header, mesh);
    ByteCursor in(s, at);
    if (e.has_list)
        read_varying_vertices(in, e, columns);
    else
        read_fixed_vertices(in, e, columns);
    return in.offset();
}

size_t read_binary_faces(Source const& s, size_t at, scene::Mesh& mesh) {
    Element const& e = s.header.elements[s.header.face];
    size_t const vertices = mesh.positions.size();
    mesh.triangles.reserve(e.count);
    std::vector<uint32_t> corners;
    ByteCursor in(s, at);
    PlainTriangles const plain = find_plain_triangles(in, e, s.header.corners);
    for (uint64_t i = 0; i < e.count; ++i) {
        char const* const p = in.position() + plain.before;
        if (plain.applies && in.left() >= plain.record && *p == 3) {
            scene::Mesh::Triangle t;
            std::memcpy(t.v, p + 1, sizeof(t.v));
            if (std::max({t.v[0], t.v[1], t.v[2]}) < vertices) {
                mesh.triangles.push_back(t);
                in.advance(plain.record);
                continue;
            }
        }
        for (size_t k = 0; k < e.properties.size(); ++k) {
            if (k == s.header.corners)
                read_corners(in, e, e.properties[k], i, corners, mesh);
            else
                in.skip_property(e, e.properties[k], i);
        }
    }
    return in.offset();
}

size_t skip_binary(Source const& s, Element const& e, size_t at) {
    ByteCursor in(s, at);
    if (!e.has_list) {
        in.take(e.count * e.min_bytes, e, 0);
        return in.offset();
    }
    for (uint64_t i = 0; i < e.count; ++i)
        for (Property const& p : e.properties) in.skip_property(e, p, i);
    return in.offset();
}

} // namespace weft::io::ply
