#include "io/ply_header.h"

#include "io/mesh_text.h"

#include <algorithm>
#include <limits>
#include <span>

namespace weft::io::ply {

namespace {

struct Word {
    std::string_view text;
    size_t offset;
};

/// Walks the header line by line, each split into words.
class HeaderReader {
  public:
    HeaderReader(std::string_view bytes, std::string const& name) : bytes_(bytes), name_(name) {}

    /// False at the end of the file. A file whose first line ends in a lone CR (old Mac) ends all
    /// its lines so; in any other, LF ends the line and a CR before it is a blank. The byte after
    /// a binary file's header is thereby never taken for a part of it.
    bool next() {
        line_start_ = at_;
        if (at_ >= bytes_.size()) return false;
        size_t end = bytes_.find(end_mark_, at_);
        if (end == std::string_view::npos) end = bytes_.size();
        split(bytes_.substr(at_, end - at_));
        at_ = std::min(end + 1, bytes_.size());
        return true;
    }
    void detect_line_end() {
        size_t const first = bytes_.find_first_of("\r\n");
        if (first == std::string_view::npos || bytes_[first] == '\n') return;
        if (first + 1 == bytes_.size() || bytes_[first + 1] != '\n') end_mark_ = '\r';
    }
    std::string_view word(size_t i) const {
        return i < words_.size() ? words_[i].text : std::string_view();
    }
    size_t size() const { return words_.size(); }
    size_t offset() const { return at_; }
    SourceLocation where(size_t word) const {
        size_t offset = line_start_;
        if (word < words_.size())
            offset = words_[word].offset;
        else if (!words_.empty())
            offset = words_.back().offset + words_.back().text.size();
        return locate(bytes_, offset, name_);
    }
    /// "expected X, found Y", where Y is the i-th word of the line.
    [[noreturn]] void fail(size_t i, std::string const& expected) const {
        throw InputError(where(i), "expected " + expected + ", found " +
                                       (i < size() ? quoted(word(i)) : "the end of the line"));
    }

  private:
    void split(std::string_view line) {
        words_.clear();
        for (size_t i = 0; i < line.size();) {
            if (is_blank(line[i]) || line[i] == '\r') {
                ++i;
                continue;
            }
            size_t j = i;
            while (j < line.size() && !is_blank(line[j]) && line[j] != '\r') ++j;
            words_.push_back({line.substr(i, j - i), at_ + i});
            i = j;
        }
    }

    std::string_view bytes_;
    std::string const& name_;
    size_t at_ = 0, line_start_ = 0;
    char end_mark_ = '\n';
    std::vector<Word> words_;
};

Scalar parse_scalar(HeaderReader const& in, size_t word) {
    struct Spelling {
        std::string_view name;
        Scalar type;
    };
    constexpr Spelling kSpellings[] = {
        {"char", Scalar::int8},      {"uchar", Scalar::uint8},    {"short", Scalar::int16},
        {"ushort", Scalar::uint16},  {"int", Scalar::int32},      {"uint", Scalar::uint32},
        {"float", Scalar::float32},  {"double", Scalar::float64}, {"int8", Scalar::int8},
        {"uint8", Scalar::uint8},    {"int16", Scalar::int16},    {"uint16", Scalar::uint16},
        {"int32", Scalar::int32},    {"uint32", Scalar::uint32},  {"float32", Scalar::float32},
        {"float64", Scalar::float64}};
    for (Spelling const& s : kSpellings)
        if (s.name == in.word(word)) return s.type;
    in.fail(word, "a type (char, uchar, short, ushort, int, uint, float, double, or int8 ... "
                  "float64)");
}

Format parse_format(HeaderReader const& in) {
    std::string_view const f = in.word(1);
    if (f != "ascii" && f != "binary_little_endian" && f != "binary_big_endian")
        in.fail(1, "the format 'ascii', 'binary_little_endian' or 'binary_big_endian'");
    if (in.word(2) != "1.0") in.fail(2, "version '1.0'");
    return f == "ascii"                  ? Format::ascii
           : f == "binary_little_endian" ? Format::little_endian
                                         : Format::big_endian;
}

Element parse_element(HeaderReader const& in, std::span<Element const> earlier) {
    Element e;
    e.name = in.word(1);
    e.where = in.where(1);
    if (e.name.empty()) in.fail(1, "the name of an element");
    std::string_view const number = in.word(2);
    int64_t count = 0;
    char const* const end = number.data() + number.size();
    if (number.empty() || scan_integer(number.data(), end, count) != end || count < 0)
        in.fail(2, "the number of elements");
    if (in.size() > 3) in.fail(3, "the end of the line");
    e.count = uint64_t(count);
    for (Element const& other : earlier)
        if (other.name == e.name)
            throw InputError(e.where, "element " + quoted(e.name) + " is declared twice");
    return e;
}

void parse_property(HeaderReader const& in, std::vector<Element>& elements) {
    if (elements.empty()) in.fail(0, "an element before its first property");
    Property p;
    p.is_list = in.word(1) == "list";
    size_t const type = p.is_list ? 3 : 1;
    if (p.is_list) {
        p.length_type = parse_scalar(in, 2);
        if (!is_integer(p.length_type)) in.fail(2, "an integer type for the length of a list");
    }
    p.type = parse_scalar(in, type);
    p.name = in.word(type + 1);
    p.where = in.where(type + 1);
    if (p.name.empty()) in.fail(type + 1, "the name of a property");
    if (in.size() > type + 2) in.fail(type + 2, "the end of the line");
    Element& e = elements.back();
    e.has_list |= p.is_list;
    e.min_bytes += size_of(p.is_list ? p.length_type : p.type);
    e.properties.push_back(std::move(p));
}

/// The first of `names` that the element has as a whole; an error where a set is incomplete.
void find_columns(Header& h, int first, std::span<std::string_view const> names) {
    Element const& e = h.elements[h.vertex];
    for (size_t k = 0; k < names.size(); ++k) {
        for (size_t i = 0; i < e.properties.size(); ++i) {
            Property const& p = e.properties[i];
            if (p.name != names[k]) continue;
            if (h.column[size_t(first) + k] >= 0)
                throw InputError(p.where, "property " + quoted(p.name) + " is declared twice");
            if (p.is_list)
                throw InputError(p.where, "expected a scalar as vertex property " + quoted(p.name) +
                                              ", found a list");
            h.column[size_t(first) + k] = int(i);
        }
    }
    size_t present = 0, missing = 0;
    for (size_t k = 0; k < names.size(); ++k) {
        bool const found = h.column[size_t(first) + k] >= 0;
        present += found;
        if (!found) missing = k;
    }
    if (present == 0 || present == names.size()) return;
    std::string all;
    for (std::string_view n : names) all += (all.empty() ? "" : ", ") + quoted(n);
    throw InputError(e.where, "expected the vertex properties " + all + ", found no " +
                                  quoted(names[missing]));
}

void find_vertex_columns(Header& h) {
    using Names = std::vector<std::string_view>;
    h.column.fill(-1);
    find_columns(h, kPosition, Names{"x", "y", "z"});
    if (h.column[kPosition] < 0)
        throw InputError(h.elements[h.vertex].where,
                         "expected the vertex properties 'x', 'y', 'z', found none of them");
    find_columns(h, kNormal, Names{"nx", "ny", "nz"});
    for (Names const& names : {Names{"s", "t"}, Names{"u", "v"}, Names{"texture_u", "texture_v"},
                               Names{"texture_s", "texture_t"}})
        if (h.column[kUv] < 0) find_columns(h, kUv, names);
    for (Names const& names :
         {Names{"red", "green", "blue"}, Names{"diffuse_red", "diffuse_green", "diffuse_blue"}})
        if (h.column[kColor] < 0) find_columns(h, kColor, names);
}

void find_extra(Header& h) {
    Element const& e = h.elements[h.vertex];
    for (size_t i = 0; i < e.properties.size(); ++i) {
        Property const& p = e.properties[i];
        bool const used = std::find(h.column.begin(), h.column.end(), int(i)) != h.column.end();
        if (used || p.is_list || (is_integer(p.type) && p.name != "alpha")) continue;
        auto same = [&](size_t other) { return e.properties[other].name == p.name; };
        if (std::find_if(h.extra.begin(), h.extra.end(), same) != h.extra.end())
            throw InputError(p.where, "property " + quoted(p.name) + " is declared twice");
        h.extra.push_back(i);
    }
}

void find_corners(Header& h) {
    Element const& e = h.elements[h.face];
    bool found = false;
    for (size_t i = 0; i < e.properties.size(); ++i) {
        Property const& p = e.properties[i];
        if (p.name != "vertex_indices" && p.name != "vertex_index") continue;
        if (found) throw InputError(p.where, "a second list of vertices, " + quoted(p.name));
        if (!p.is_list || !is_integer(p.type))
            throw InputError(p.where, "expected a list of integers as face property " +
                                          quoted(p.name) + ", found " +
                                          (p.is_list ? "a list of reals" : "a scalar"));
        h.corners = i;
        found = true;
    }
    if (!found)
        throw InputError(e.where, "expected the face property 'vertex_indices' or "
                                  "'vertex_index', found neither");
}

/// Refuses counts that the file cannot hold, before anybody allocates for them.
void check_sizes(Header const& h, size_t file_size) {
    bool const ascii = h.format == Format::ascii;
    // In text a value takes a digit and a separator, which the last one can lack.
    uint64_t left = file_size - h.body + (ascii ? 1 : 0);
    for (Element const& e : h.elements) {
        if (e.count == 0) continue;
        if (e.properties.empty())
            throw InputError(e.where, "element " + quoted(e.name) + " has no properties");
        uint64_t const record = ascii ? 2 * e.properties.size() : e.min_bytes;
        if (e.count > left / record)
            throw InputError(e.where, "truncated: expected " + std::to_string(e.count) +
                                          " of element " + quoted(e.name) + ", at least " +
                                          std::to_string(record) + " bytes each, found " +
                                          std::to_string(left - (ascii ? 1 : 0)) + " bytes");
        left -= e.count * record;
    }
}

size_t find_element(Header const& h, std::string_view name) {
    size_t i = 0;
    while (i < h.elements.size() && h.elements[i].name != name) ++i;
    return i;
}

void check_mesh(Header& h, std::string_view bytes, std::string const& name) {
    h.vertex = find_element(h, "vertex");
    if (h.vertex == h.elements.size())
        throw InputError({name}, "expected an element 'vertex', found none");
    find_vertex_columns(h);
    find_extra(h);
    if (h.elements[h.vertex].count > std::numeric_limits<uint32_t>::max())
        throw InputError(h.elements[h.vertex].where, "more than 2^32 - 1 vertices");
    h.face = find_element(h, "face");
    bool const strips = find_element(h, "tristrips") < h.elements.size();
    if (h.face == h.elements.size() || h.elements[h.face].count == 0)
        throw InputError({name}, strips ? "triangle strips are not supported: expected an element "
                                          "'face', found 'tristrips'"
                                        : "a point cloud: expected faces, found " +
                                              std::to_string(h.elements[h.vertex].count) +
                                              " vertices without any");
    find_corners(h);
    check_sizes(h, bytes.size());
}

} // namespace

Header parse_header(std::string_view bytes, std::string const& name) {
    HeaderReader in(bytes, name);
    in.detect_line_end();
    if (!in.next() || in.size() != 1 || in.word(0) != "ply")
        throw InputError({name, 1, 1}, "not a PLY file: expected the line 'ply', found " +
                                           (in.size() > 0 ? quoted(in.word(0)) : "none"));
    Header h;
    bool has_format = false;
    while (in.next()) {
        std::string_view const keyword = in.word(0);
        if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
        if (keyword == "format" && !has_format) {
            h.format = parse_format(in);
            has_format = true;
        } else if (!has_format) {
            in.fail(0, "the line 'format ...'");
        } else if (keyword == "element") {
            h.elements.push_back(parse_element(in, h.elements));
        } else if (keyword == "property") {
            parse_property(in, h.elements);
        } else if (keyword == "end_header") {
            h.body = in.offset();
            check_mesh(h, bytes, name);
            return h;
        } else {
            in.fail(0, "'element', 'property', 'comment', 'obj_info' or 'end_header'");
        }
    }
    throw InputError(locate(bytes, bytes.size(), name),
                     "truncated: expected 'end_header', found the end of the file");
}

} // namespace weft::io::ply
