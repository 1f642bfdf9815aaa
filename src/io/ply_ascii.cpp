#include "io/ply_body.h"

#include "io/mesh_text.h"

namespace weft::io::ply {

namespace {

/// Walks the values of a text body. One record is one line; blank lines are skipped.
class TextCursor {
  public:
    TextCursor(Source const& s, size_t at)
        : source_(s), p_(s.bytes.data() + at), end_(s.bytes.data() + s.bytes.size()) {}

    size_t offset() const { return size_t(p_ - source_.bytes.data()); }
    /// Where the last value read begins.
    char const* last() const { return last_; }

    void begin_record(Element const& e, uint64_t record) {
        while (p_ < end_ && (is_blank(*p_) || is_line_end(*p_))) ++p_;
        if (p_ == end_)
            fail("truncated: expected " + std::to_string(e.count) + " of element " +
                 quoted(e.name) + ", found " + std::to_string(record));
    }
    void end_record(Element const& e, uint64_t record) {
        skip_blanks();
        if (p_ < end_ && !is_line_end(*p_))
            fail_found("the end of the line after " + e.name + " " + std::to_string(record));
    }
    void skip_value(Element const& e, Property const& p, uint64_t record) {
        skip_blanks();
        std::string_view const token = token_at(p_, end_);
        if (token.empty()) fail_found(describe_value(e, p, record));
        p_ += token.size();
    }
    float real(Element const& e, Property const& p, uint64_t record) {
        skip_blanks();
        float value = 0;
        char const* const after = scan_float(p_, end_, value);
        if (!ends_value(after)) fail_found("a number as " + describe_value(e, p, record));
        if (!std::isfinite(value)) fail_found("a finite float as " + describe_value(e, p, record));
        p_ = after;
        return value;
    }
    int64_t integer(Element const& e, Property const& p, uint64_t record) {
        skip_blanks();
        last_ = p_;
        int64_t value = 0;
        char const* const after = scan_integer(p_, end_, value);
        if (!ends_value(after)) fail_found("an integer in " + describe_value(e, p, record));
        p_ = after;
        return value;
    }
    /// The length of a list, refused where the rest of the file is too short to hold it.
    int64_t list_length(Element const& e, Property const& p, uint64_t record) {
        int64_t const length = integer(e, p, record);
        if (length < 0 || length > end_ - p_)
            fail_at(last_, describe_value(e, p, record) + ": expected a list, found the length " +
                               std::to_string(length));
        return length;
    }
    void skip_record(Element const& e, uint64_t record) {
        for (Property const& p : e.properties) skip_property(e, p, record);
    }
    void skip_property(Element const& e, Property const& p, uint64_t record) {
        int64_t const n = p.is_list ? list_length(e, p, record) : 1;
        for (int64_t i = 0; i < n; ++i) skip_value(e, p, record);
    }
    [[noreturn]] void fail(std::string const& message) const { fail_at(p_, message); }
    [[noreturn]] void fail_at(char const* p, std::string const& message) const {
        throw InputError(locate(source_.bytes, size_t(p - source_.bytes.data()), source_.name),
                         message);
    }

  private:
    void skip_blanks() {
        while (p_ < end_ && is_blank(*p_)) ++p_;
    }
    bool ends_value(char const* after) const {
        return after && (after == end_ || is_blank(*after) || is_line_end(*after));
    }
    [[noreturn]] void fail_found(std::string const& expected) const {
        std::string_view const token = token_at(p_, end_);
        fail("expected " + expected + ", found " +
             (!token.empty() ? quoted(token)
              : p_ == end_   ? "the end of the file"
                             : "the end of the line"));
    }

    Source const& source_;
    char const* p_;
    char const* end_;
    char const* last_ = p_;
};

} // namespace

size_t read_ascii_vertices(Source const& s, size_t at, scene::Mesh& mesh) {
    Element const& e = s.header.elements[s.header.vertex];
    std::vector<Column> const columns = make_columns(s.header, mesh);
    std::vector<Column const*> by_property(e.properties.size(), nullptr);
    for (Column const& c : columns) by_property[c.property] = &c;
    TextCursor in(s, at);
    for (uint64_t i = 0; i < e.count; ++i) {
        in.begin_record(e, i);
        for (size_t k = 0; k < e.properties.size(); ++k) {
            if (Column const* const c = by_property[k])
                c->data[i * c->stride] = in.real(e, e.properties[k], i) * c->scale;
            else
                in.skip_property(e, e.properties[k], i);
        }
        in.end_record(e, i);
    }
    return in.offset();
}

size_t read_ascii_faces(Source const& s, size_t at, scene::Mesh& mesh) {
    Element const& e = s.header.elements[s.header.face];
    size_t const vertices = mesh.positions.size();
    mesh.triangles.reserve(e.count);
    std::vector<uint32_t> corners;
    TextCursor in(s, at);
    for (uint64_t i = 0; i < e.count; ++i) {
        in.begin_record(e, i);
        for (size_t k = 0; k < e.properties.size(); ++k) {
            Property const& p = e.properties[k];
            if (k != s.header.corners) {
                in.skip_property(e, p, i);
                continue;
            }
            int64_t const n = in.list_length(e, p, i);
            char const* const start = in.last();
            if (n < 3) in.fail_at(start, describe_bad_length(i, n));
            corners.clear();
            for (int64_t j = 0; j < n; ++j) {
                int64_t const index = in.integer(e, p, i);
                if (index < 0 || index >= int64_t(vertices))
                    in.fail_at(in.last(), describe_bad_index(i, index, vertices));
                corners.push_back(uint32_t(index));
            }
            if (!scene::triangulate(mesh.positions, corners, mesh.triangles))
                in.fail_at(start, describe_bad_polygon(i, corners.size()));
        }
        in.end_record(e, i);
    }
    return in.offset();
}

size_t skip_ascii(Source const& s, Element const& e, size_t at) {
    TextCursor in(s, at);
    for (uint64_t i = 0; i < e.count; ++i) {
        in.begin_record(e, i);
        in.skip_record(e, i);
        in.end_record(e, i);
    }
    return in.offset();
}

} // namespace weft::io::ply
