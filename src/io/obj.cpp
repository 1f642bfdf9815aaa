#include "io/obj.h"

#include "base/file_bytes.h"
#include "io/mesh_text.h"

#include <array>
#include <limits>

namespace weft::io {

namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

/// The indices of a corner, from 0; kNone where the file gives none.
struct Corner {
    uint32_t position = kNone, uv = kNone, normal = kNone;
};

struct Face {
    size_t offset; ///< of its line in the file
    size_t first;  ///< of its corners
    size_t count;
};

/// The file's own lists, before corners are unified into vertices.
struct Lists {
    std::vector<Vec3> positions;
    std::vector<Color> colors; ///< empty, or white where a position has none
    std::vector<Vec2> uvs;
    std::vector<Vec3> normals;
    std::vector<Corner> corners;
    std::vector<Face> faces;
    size_t lines = 0, points = 0; ///< ignored, but told where there is nothing else
};

template <size_t N>
constexpr bool contains(std::array<std::string_view, N> const& words, std::string_view word) {
    for (std::string_view w : words)
        if (w == word) return true;
    return false;
}

/// Followed by names, in which a final backslash can be part of a path.
constexpr std::array<std::string_view, 9> kNames{
    "o", "g", "usemtl", "mtllib", "usemap", "maplib", "texmap", "shadow_obj", "trace_obj"};
constexpr std::array<std::string_view, 8> kDisplay{"s",        "mg",  "bevel", "c_interp",
                                                   "d_interp", "lod", "ctech", "stech"};
constexpr std::array<std::string_view, 22> kCurved{
    "vp",   "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole",
    "scrv", "sp",     "end", "con",  "bzp",  "bsp",  "cdc",   "cdp",  "res",  "call", "csh"};

class ObjReader {
  public:
    ObjReader(std::string_view text, std::string const& name)
        : text_(text), name_(name), p_(text.data()), end_(text.data() + text.size()) {}

    Lists run() {
        if (text_.substr(0, 3) == "\xef\xbb\xbf") p_ += 3;
        while (p_ < end_) {
            skip_blanks();
            line_ = p_;
            std::string_view const keyword = token_at(p_, end_);
            p_ += keyword.size();
            if (!keyword.empty() && keyword[0] != '#') read_line(keyword);
            skip_line();
        }
        return std::move(lists_);
    }

  private:
    void read_line(std::string_view keyword) {
        if (keyword == "v") {
            read_position();
        } else if (keyword == "vt") {
            read_uv();
        } else if (keyword == "vn") {
            lists_.normals.push_back({real("x"), real("y"), real("z")});
            expect_line_end();
        } else if (keyword == "f" || keyword == "fo") {
            read_face();
        } else if (keyword == "l" || keyword == "p") {
            (keyword == "l" ? lists_.lines : lists_.points) += 1;
            skip_continued();
        } else if (contains(kDisplay, keyword)) {
            skip_continued();
        } else if (contains(kCurved, keyword)) {
            fail(line_, quoted(keyword) + " is not supported: expected polygons, not curves, "
                                          "surfaces or other files");
        } else if (!contains(kNames, keyword)) {
            fail(line_, "expected 'v', 'vt', 'vn', 'f' or another word of an OBJ file, found " +
                            quoted(keyword));
        }
    }

    /// x y z, then nothing, a weight, a colour, a colour and its alpha.
    void read_position() {
        std::array<float, 7> values{};
        constexpr std::array<char const*, 3> kAxes{"x", "y", "z"};
        size_t n = 0;
        for (; n < 3; ++n) values[n] = real(kAxes[n]);
        for (; n < values.size() && at_value(); ++n) values[n] = real("a colour");
        if (n == 5) fail_found("the third component of a colour");
        expect_line_end();
        lists_.positions.push_back({values[0], values[1], values[2]});
        if (n >= 6) {
            lists_.colors.resize(lists_.positions.size() - 1, Color(1));
            lists_.colors.push_back({values[3], values[4], values[5]});
        } else if (!lists_.colors.empty()) {
            lists_.colors.push_back(Color(1));
        }
    }
    /// u, v and a depth that only solid textures know; v and depth can be left out.
    void read_uv() {
        float const u = real("u"), v = at_value() ? real("v") : 0;
        if (at_value()) real("w");
        expect_line_end();
        lists_.uvs.push_back({u, v});
    }
    void read_face() {
        Face const face{size_t(line_ - text_.data()), lists_.corners.size(), 0};
        char const* const start = p_;
        while (at_value()) read_corner();
        size_t const n = lists_.corners.size() - face.first;
        if (n < 3) {
            p_ = start;
            skip_blanks();
            fail(p_, "face " + std::to_string(lists_.faces.size() + 1) +
                         ": expected at least 3 vertices, found " + std::to_string(n));
        }
        lists_.faces.push_back({face.offset, face.first, n});
    }
    /// v, v/vt, v//vn or v/vt/vn.
    void read_corner() {
        Corner c;
        c.position = index("vertex", lists_.positions.size());
        if (p_ < end_ && *p_ == '/') {
            ++p_;
            bool const has_uv = p_ < end_ && *p_ != '/' && !is_blank(*p_) && !is_line_end(*p_);
            if (has_uv) c.uv = index("uv", lists_.uvs.size());
            if (p_ < end_ && *p_ == '/') {
                ++p_;
                bool const has_normal = p_ < end_ && !is_blank(*p_) && !is_line_end(*p_);
                if (has_normal) c.normal = index("normal", lists_.normals.size());
            }
        }
        if (p_ < end_ && !is_blank(*p_) && !is_line_end(*p_) && *p_ != '\\')
            fail_found("the form v, v/vt, v//vn or v/vt/vn");
        lists_.corners.push_back(c);
    }
    /// A positive index can point ahead, so only its final count can refuse it.
    uint32_t index(char const* what, size_t count) {
        int64_t i = 0;
        char const* const after = scan_integer(p_, end_, i);
        if (!after) fail_found(std::string("the index of a ") + what);
        if (i == 0 || i < -int64_t(count) || i > int64_t(kNone) - 1)
            fail(p_, std::string("expected the index of a ") + what + ", found " +
                         std::to_string(i) + " after " + std::to_string(count) + " of them" +
                         (i == 0 ? "; indices count from 1" : ""));
        p_ = after;
        return uint32_t(i > 0 ? i - 1 : int64_t(count) + i);
    }
    float real(char const* what) {
        skip_blanks();
        float value = 0;
        char const* const after = scan_float(p_, end_, value);
        bool const whole =
            after && (after == end_ || is_blank(*after) || is_line_end(*after) || *after == '\\');
        if (!whole) fail_found(std::string("a number as ") + what);
        if (!std::isfinite(value)) fail_found(std::string("a finite float as ") + what);
        p_ = after;
        return value;
    }

    /// Blanks, and ends of lines after a backslash.
    void skip_blanks() {
        while (p_ < end_) {
            if (is_blank(*p_)) {
                ++p_;
            } else if (*p_ == '\\' && p_ + 1 < end_ && is_line_end(p_[1])) {
                p_ += p_[1] == '\r' && p_ + 2 < end_ && p_[2] == '\n' ? 3 : 2;
            } else {
                return;
            }
        }
    }
    bool at_value() {
        skip_blanks();
        return p_ < end_ && !is_line_end(*p_) && *p_ != '#';
    }
    void expect_line_end() {
        if (at_value()) fail_found("the end of the line");
    }
    void skip_line() {
        while (p_ < end_ && !is_line_end(*p_)) ++p_;
        while (p_ < end_ && is_line_end(*p_)) ++p_;
    }
    void skip_continued() {
        while (at_value()) p_ += std::max<size_t>(1, token_at(p_, end_).size());
    }
    [[noreturn]] void fail(char const* p, std::string const& message) const {
        throw InputError(locate(text_, size_t(p - text_.data()), name_), message);
    }
    [[noreturn]] void fail_found(std::string const& expected) const {
        std::string_view const token = token_at(p_, end_);
        fail(p_, "expected " + expected + ", found " +
                     (!token.empty() ? quoted(token)
                      : p_ == end_   ? "the end of the file"
                                     : "the end of the line"));
    }

    std::string_view text_;
    std::string const& name_;
    char const* p_;
    char const* end_;
    char const* line_ = p_; ///< the keyword of the current line
    Lists lists_;
};

void check_range(uint32_t index, size_t count, char const* what, size_t corner, Face const& face,
                 size_t number, std::string_view text, std::string const& name) {
    if (index == kNone || index < count) return;
    throw InputError(locate(text, face.offset, name),
                     "face " + std::to_string(number) + ", corner " + std::to_string(corner) +
                         ": expected " +
                         (count == 0 ? std::string("no index of a ")
                                     : "an index from 1 to " + std::to_string(count) + " of a ") +
                         what + ", found " + std::to_string(uint64_t(index) + 1) +
                         "; the file has " + std::to_string(count) + " of them");
}

void check_ranges(Lists const& lists, std::string_view text, std::string const& name) {
    for (size_t f = 0; f < lists.faces.size(); ++f) {
        Face const& face = lists.faces[f];
        for (size_t k = 0; k < face.count; ++k) {
            Corner const& c = lists.corners[face.first + k];
            check_range(c.position, lists.positions.size(), "vertex", k + 1, face, f + 1, text,
                        name);
            check_range(c.uv, lists.uvs.size(), "uv", k + 1, face, f + 1, text, name);
            check_range(c.normal, lists.normals.size(), "normal", k + 1, face, f + 1, text, name);
        }
    }
}

/// Gives each distinct triple of indices one vertex. The vertices of a position form a list.
class Unifier {
  public:
    explicit Unifier(Lists const& lists)
        : lists_(lists), first_(lists.positions.size(), kNone), colored_(!lists.colors.empty()) {
        for (Corner const& c : lists.corners) {
            has_uvs_ |= c.uv != kNone;
            has_normals_ |= c.normal != kNone;
        }
    }
    uint32_t vertex(Corner const& c, size_t face, scene::Mesh& mesh) {
        // A flat corner is shared within its own face at most.
        uint32_t const owner = has_normals_ && c.normal == kNone ? uint32_t(face) : kNone;
        for (uint32_t i = first_[c.position]; i != kNone; i = keys_[i].next)
            if (keys_[i].uv == c.uv && keys_[i].normal == c.normal && keys_[i].owner == owner)
                return i;
        auto const i = uint32_t(keys_.size());
        keys_.push_back({c.uv, c.normal, owner, first_[c.position]});
        first_[c.position] = i;
        mesh.positions.push_back(lists_.positions[c.position]);
        if (has_uvs_) mesh.uvs.push_back(c.uv == kNone ? Vec2(0) : lists_.uvs[c.uv]);
        if (has_normals_)
            mesh.normals.push_back(c.normal == kNone ? Vec3(0) : lists_.normals[c.normal]);
        if (colored_) mesh.colors.push_back(lists_.colors[c.position]);
        return i;
    }

  private:
    struct Key {
        uint32_t uv, normal, owner, next;
    };
    Lists const& lists_;
    std::vector<uint32_t> first_;
    std::vector<Key> keys_;
    bool has_uvs_ = false, has_normals_ = false, colored_;
};

void refuse_utf16(std::string_view text, std::string const& name) {
    std::string_view const mark = text.substr(0, 2);
    if (mark == "\xfe\xff" || mark == "\xff\xfe")
        throw InputError({name, 1, 1}, "expected ASCII or UTF-8 text, found UTF-16");
}

} // namespace

scene::Mesh read_obj(std::string_view bytes, std::string const& name) {
    refuse_utf16(bytes, name);
    Lists const lists = ObjReader(bytes, name).run();
    if (lists.faces.empty())
        throw InputError({name}, "expected faces, found none; it has " +
                                     std::to_string(lists.positions.size()) + " vertices, " +
                                     std::to_string(lists.lines) + " lines and " +
                                     std::to_string(lists.points) + " points");
    check_ranges(lists, bytes, name);
    scene::Mesh mesh;
    mesh.triangles.reserve(lists.corners.size() - 2 * lists.faces.size());
    Unifier unifier(lists);
    std::vector<uint32_t> polygon;
    for (size_t f = 0; f < lists.faces.size(); ++f) {
        Face const& face = lists.faces[f];
        polygon.clear();
        for (size_t k = 0; k < face.count; ++k)
            polygon.push_back(unifier.vertex(lists.corners[face.first + k], f, mesh));
        if (!scene::triangulate(mesh.positions, polygon, mesh.triangles))
            throw InputError(locate(bytes, face.offset, name),
                             "face " + std::to_string(f + 1) + ": expected at most " +
                                 std::to_string(scene::kMaxConcaveCorners) +
                                 " corners in a concave polygon, found " +
                                 std::to_string(face.count));
    }
    scene::unify_normals(mesh);
    return mesh;
}

scene::Mesh read_obj(std::string const& path) { return read_obj(read_file(path).view(), path); }

} // namespace weft::io
