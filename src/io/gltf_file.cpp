#include "io/gltf_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/xml_document.h"

namespace weft::io::gltf {

namespace {

uint32_t little_endian(std::string_view bytes, size_t at) {
    uint32_t n = 0;
    for (size_t i = 4; i-- > 0;) n = n << 8 | static_cast<unsigned char>(bytes[at + i]);
    return n;
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

/// RFC 4648; nothing where a character is no digit.
std::optional<std::string> decode_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int held = 0;
    for (char c : text) {
        int const digit = base64_digit(c);
        if (digit < 0) return {};
        bits = bits << 6 | uint32_t(digit);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes += char(bits >> held & 0xff);
    }
    return bytes;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// RFC 3986: %41 is 'A'.
std::string decode_percent(std::string_view text) {
    std::string decoded;
    for (size_t i = 0; i < text.size(); ++i) {
        bool const escape = text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 &&
                            hex_digit(text[i + 2]) >= 0;
        if (escape) {
            decoded += char(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

size_t components_of(std::string const& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    if (type == "MAT3") return 9;
    if (type == "MAT4") return 16;
    return 0;
}

enum ComponentType { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };

size_t size_of(int component_type) {
    switch (component_type) {
    case int8:
    case uint8:
        return 1;
    case int16:
    case uint16:
        return 2;
    case uint32:
    case float32:
        return 4;
    default:
        return 0;
    }
}

template <class T>
T load(char const* p) {
    T value;
    std::memcpy(&value, p, sizeof value);
    return value;
}

uint32_t load_integer(char const* p, int type) {
    if (type == uint8) return load<uint8_t>(p);
    return type == uint16 ? load<uint16_t>(p) : load<uint32_t>(p);
}

float load_float(char const* p, int type, bool normalized) {
    switch (type) {
    case int8: {
        float const v = load<int8_t>(p);
        return normalized ? std::max(v / 127, -1.f) : v;
    }
    case uint8:
        return float(load<uint8_t>(p)) / (normalized ? 255.f : 1.f);
    case int16: {
        float const v = load<int16_t>(p);
        return normalized ? std::max(v / 32767, -1.f) : v;
    }
    case uint16:
        return float(load<uint16_t>(p)) / (normalized ? 65535.f : 1.f);
    case uint32:
        return float(load<uint32_t>(p));
    default:
        return load<float>(p);
    }
}

} // namespace

File::File(std::string_view bytes, std::string const& name, std::string folder)
    : report_(name), folder_(std::move(folder)), file_size_(bytes.size()) {
    open_container(bytes);
    root_.emplace(report_, json_, "");
    std::optional<Object> asset = root_->object("asset");
    if (!asset) report_.fail("asset", "expected an object with a version, found none");
    std::string const version = asset->text("minVersion", asset->text("version"));
    if (!version.starts_with("2."))
        report_.fail("asset.version", "expected glTF 2.x, found " + in_quotes(version));
    for (char const* list : {"accessors", "buffers", "bufferViews", "cameras", "images",
                             "materials", "meshes", "nodes", "samplers", "scenes", "textures"})
        root_->objects(list); // each is an array of objects, or this throws
    buffers_.resize(count("buffers"));
}

void File::open_container(std::string_view bytes) {
    if (!bytes.starts_with("glTF")) {
        if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
        json_ = parse_json(bytes, report_.file());
        return;
    }
    constexpr size_t kHeader = 12, kChunkHeader = 8;
    constexpr uint32_t kJson = 0x4e4f534a, kBin = 0x004e4942;
    auto truncated = [&](size_t wanted) {
        report_.fail("", "truncated: expected " + std::to_string(wanted) + " bytes, found " +
                             std::to_string(bytes.size()));
    };
    if (bytes.size() < kHeader) truncated(kHeader);
    if (uint32_t const version = little_endian(bytes, 4); version != 2)
        report_.fail("", "expected a binary glTF container of version 2, found version " +
                             std::to_string(version));
    size_t const length = little_endian(bytes, 8);
    if (length > bytes.size()) truncated(length);
    bytes = bytes.substr(0, length);
    std::optional<std::string_view> text;
    for (size_t at = kHeader; at < bytes.size();) {
        if (bytes.size() - at < kChunkHeader) truncated(at + kChunkHeader);
        size_t const size = little_endian(bytes, at);
        uint32_t const kind = little_endian(bytes, at + 4);
        at += kChunkHeader;
        if (size > bytes.size() - at) truncated(at + size);
        if (!text && kind != kJson)
            report_.fail("", "expected the JSON chunk of a binary glTF container first, found "
                             "another");
        if (!text) {
            text = bytes.substr(at, size);
        } else if (kind == kBin && !has_binary_) {
            binary_ = bytes.substr(at, size);
            has_binary_ = true;
        }
        at += size;
    }
    if (!text) report_.fail("", "expected the JSON chunk of a binary glTF container, found none");
    json_ = parse_json(*text, report_.file());
}

size_t File::count(char const* list) const {
    auto const it = json_.find(list);
    return it == json_.end() || !it->is_array() ? 0 : it->size();
}

Object File::element(char const* list, size_t index) {
    return Object(report_, json_.at(list).at(index),
                  std::string(list) + "[" + std::to_string(index) + "]");
}

File::Resource File::resolve(std::string const& uri, std::string const& where) const {
    if (uri.starts_with("data:")) {
        size_t const comma = uri.find(',');
        if (comma == std::string::npos)
            report_.fail(where, "expected ',' after the media type of a data: URI, found none");
        std::string_view const data = std::string_view(uri).substr(comma + 1);
        if (!std::string_view(uri).substr(0, comma).ends_with(";base64"))
            return {decode_percent(data), ""};
        auto bytes = decode_base64(data);
        if (!bytes) report_.fail(where, "expected base64 in a data: URI, found something else");
        return {std::move(*bytes), ""};
    }
    size_t const colon = uri.find(':');
    if (colon != std::string::npos && colon > 1 && uri.find('/') > colon)
        report_.fail(where, "expected a data: URI or a file relative to this one, found " +
                                in_quotes(uri));
    return {"", existing_file(folder_, decode_percent(uri), report_.at(where))};
}

std::string_view File::buffer(size_t index) {
    Buffer& b = buffers_[index];
    if (b.loaded) return b.bytes;
    Object o = element("buffers", index);
    auto const length = o.whole("byteLength");
    if (!length)
        report_.fail(o.path_of("byteLength"), "expected the size of the buffer, found none");
    std::string const uri = o.text("uri");
    std::string where = o.path_of("uri");
    if (!uri.empty()) {
        Resource r = resolve(uri, where);
        b.owned = std::move(r.data);
        b.bytes = b.owned;
        if (!r.path.empty()) b.bytes = b.file.emplace(read_file(r.path)).view();
    } else {
        if (index != 0 || !has_binary_)
            report_.fail(where, "expected a file or data: URI, found none");
        b.bytes = binary_;
        where = o.path();
    }
    if (b.bytes.size() < *length)
        report_.fail(where, "truncated: expected " + std::to_string(*length) + " bytes, found " +
                                std::to_string(b.bytes.size()));
    b.bytes = b.bytes.substr(0, size_t(*length));
    o.finish();
    b.loaded = true;
    return b.bytes;
}

File::View File::view(size_t index) {
    Object o = element("bufferViews", index);
    auto const from = o.index("buffer", buffers_.size(), "buffers");
    if (!from) report_.fail(o.path_of("buffer"), "expected an index into 'buffers', found none");
    std::string_view const bytes = buffer(*from);
    uint64_t const offset = o.whole("byteOffset").value_or(0);
    uint64_t const length = o.whole("byteLength").value_or(0);
    if (offset > bytes.size() || length > bytes.size() - offset)
        report_.fail(o.path(), "expected bytes within the " + std::to_string(bytes.size()) +
                                   " of buffers[" + std::to_string(*from) + "], found " +
                                   std::to_string(length) + " from byte " + std::to_string(offset));
    auto const stride = o.whole("byteStride");
    if (stride && (*stride < 4 || *stride > 252))
        report_.fail(o.path_of("byteStride"),
                     "expected 4 to 252 bytes, found " + std::to_string(*stride));
    o.ignore("target");
    o.finish();
    return {bytes.substr(size_t(offset), size_t(length)), size_t(stride.value_or(0))};
}

std::string_view File::view_bytes(size_t index) { return view(index).bytes; }

File::Accessor File::shape_of(Object& o) {
    Accessor a;
    a.path = o.path();
    a.component_type = int(std::min<uint64_t>(o.whole("componentType").value_or(0), 1 << 20));
    a.component_size = size_of(a.component_type);
    if (a.component_size == 0)
        report_.fail(o.path_of("componentType"),
                     "expected 5120, 5121, 5122, 5123, 5125 or 5126, found " +
                         std::to_string(a.component_type));
    std::string const type = o.text("type");
    a.components = components_of(type);
    if (a.components == 0)
        report_.fail(o.path_of("type"), "expected SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4, "
                                        "found " +
                                            in_quotes(type));
    a.normalized = o.boolean("normalized", false);
    auto const elements = o.whole("count");
    if (!elements) report_.fail(o.path_of("count"), "expected the number of elements, found none");
    // Only an accessor of zeros, without bytes of its own, can promise more than the files hold.
    uint64_t const most = o.has("bufferView") ? ~uint64_t(0) : 65536 + 16 * uint64_t(file_size_);
    if (*elements > most)
        report_.fail(o.path_of("count"), "expected at most " + std::to_string(most) +
                                             " elements without a buffer view, found " +
                                             std::to_string(*elements));
    a.count = size_t(*elements);
    for (char const* key : {"min", "max"}) o.ignore(key);
    return a;
}

template <class Read>
void File::scan(Accessor const& a, View const& view, size_t offset, std::string const& path,
                Read&& read) {
    size_t const element = a.element_size(), stride = view.stride ? view.stride : element;
    bool fits =
        a.count == 0 || (offset <= view.bytes.size() && element <= view.bytes.size() - offset);
    if (a.count > 1 && fits) fits = (view.bytes.size() - offset - element) / stride >= a.count - 1;
    if (!fits)
        report_.fail(path,
                     "expected bytes for " + std::to_string(a.count) + " elements of " +
                         std::to_string(element) + " bytes, " + std::to_string(stride) +
                         " apart, found " +
                         std::to_string(view.bytes.size() - std::min(offset, view.bytes.size())));
    for (size_t i = 0; i < a.count; ++i) read(i, view.bytes.data() + offset + i * stride);
}

template <class Read>
void File::for_each(Accessor const& a, Object& o, Read&& read) {
    auto const from = o.index("bufferView", count("bufferViews"), "bufferViews");
    uint64_t const offset = o.whole("byteOffset").value_or(0);
    if (from) scan(a, view(*from), size_t(offset), o.path(), read);
    if (o.has("sparse")) for_each_sparse(a, o, read);
    o.finish();
}

template <class Read>
void File::for_each_sparse(Accessor const& a, Object& o, Read&& read) {
    Object sparse = *o.object("sparse");
    auto part = [&](char const* name) {
        auto child = sparse.object(name);
        if (!child) report_.fail(sparse.path_of(name), "expected an object, found none");
        return std::move(*child);
    };
    auto view_of = [&](Object& child) {
        auto const index = child.index("bufferView", count("bufferViews"), "bufferViews");
        if (!index)
            report_.fail(child.path_of("bufferView"),
                         "expected an index into 'bufferViews', found none");
        return view(*index);
    };
    size_t const n = size_t(sparse.whole("count").value_or(0));
    Object indices = part("indices"), values = part("values");
    int const type = int(std::min<uint64_t>(indices.whole("componentType").value_or(0), 1 << 20));
    if (type != uint8 && type != uint16 && type != uint32)
        report_.fail(indices.path_of("componentType"),
                     "expected 5121, 5123 or 5125, found " + std::to_string(type));
    std::vector<size_t> places;
    Accessor const index{indices.path(), n, 1, size_of(type), type, false};
    scan(index, view_of(indices), size_t(indices.whole("byteOffset").value_or(0)), indices.path(),
         [&](size_t i, char const* p) {
             places.push_back(load_integer(p, type));
             if (places.back() >= a.count)
                 report_.fail(indices.path(), "element " + std::to_string(i) +
                                                  ": expected an index below " +
                                                  std::to_string(a.count) + ", found " +
                                                  std::to_string(places.back()));
         });
    Accessor value = a;
    value.count = n;
    scan(value, view_of(values), size_t(values.whole("byteOffset").value_or(0)), values.path(),
         [&](size_t i, char const* p) { read(places[i], p); });
    for (Object* part_read : {&indices, &values, &sparse}) part_read->finish();
}

Floats const& File::floats(size_t accessor, std::vector<std::string> const& types) {
    Object o = element("accessors", accessor);
    std::string const type = o.text("type");
    if (std::find(types.begin(), types.end(), type) == types.end()) {
        std::string expected = types.front();
        for (size_t i = 1; i < types.size(); ++i) expected += " or " + types[i];
        report_.fail(o.path_of("type"), "expected " + expected + ", found " + in_quotes(type));
    }
    if (auto const it = floats_.find(accessor); it != floats_.end()) return it->second;
    Accessor const a = shape_of(o);
    Floats result{a.count, a.components, {}};
    // Before the numbers are stored, for_each finds out whether they are there.
    bool const sized = !o.has("bufferView");
    if (sized) result.data.resize(a.count * a.components);
    for_each(a, o, [&](size_t i, char const* p) {
        if (result.data.empty()) result.data.resize(a.count * a.components);
        for (size_t c = 0; c < a.components; ++c)
            result.data[i * a.components + c] =
                load_float(p + c * a.component_size, a.component_type, a.normalized);
    });
    return floats_.emplace(accessor, std::move(result)).first->second;
}

std::vector<uint32_t> File::integers(size_t accessor) {
    Object o = element("accessors", accessor);
    Accessor const a = shape_of(o);
    if (a.components != 1)
        report_.fail(o.path_of("type"), "expected SCALAR, found " + in_quotes(o.text("type")));
    if (a.component_type != uint8 && a.component_type != uint16 && a.component_type != uint32)
        report_.fail(o.path_of("componentType"),
                     "expected 5121, 5123 or 5125, found " + std::to_string(a.component_type));
    std::vector<uint32_t> result;
    if (!o.has("bufferView")) result.resize(a.count);
    for_each(a, o, [&](size_t i, char const* p) {
        if (result.empty()) result.resize(a.count);
        result[i] = load_integer(p, a.component_type);
    });
    return result;
}

} // namespace weft::io::gltf
