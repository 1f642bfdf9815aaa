#include "film/cryptomatte.h"

#include <bit>
#include <cstdio>

namespace weft::film {

namespace {

std::string hex(uint32_t v) {
    char text[9];
    std::snprintf(text, sizeof text, "%08x", v);
    return text;
}

/// As a JSON string. Bytes beyond ASCII stay: scene files are UTF-8.
std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (static_cast<unsigned char>(c) < 32) {
            result += "\\u" + hex(uint32_t(c)).substr(4);
        } else {
            result += c;
        }
    }
    return result + '"';
}

} // namespace

uint32_t murmur_hash3(std::string_view text, uint32_t seed) {
    auto const mixed = [](uint32_t k) { return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u; };
    auto const byte = [&](size_t i) { return uint32_t(static_cast<unsigned char>(text[i])); };
    uint32_t h = seed;
    size_t const blocks = text.size() / 4 * 4;
    for (size_t i = 0; i < blocks; i += 4) {
        h ^= mixed(byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16 | byte(i + 3) << 24);
        h = std::rotl(h, 13) * 5 + 0xe6546b64u;
    }
    uint32_t tail = 0;
    for (size_t i = text.size(); i-- > blocks;) tail = tail << 8 | byte(i);
    h ^= mixed(tail);
    h ^= uint32_t(text.size());
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

uint32_t cryptomatte_id(std::string_view name) {
    uint32_t const hash = murmur_hash3(name), exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

image::Metadata cryptomatte_metadata(std::string const& layer,
                                     std::map<std::string, uint32_t> const& manifest) {
    std::string json = "{";
    for (auto const& [name, id] : manifest)
        json += (json.size() > 1 ? "," : "") + quoted(name) + ":\"" + hex(id) + '"';
    std::string const key = "cryptomatte/" + hex(murmur_hash3(layer)).substr(0, 7) + "/";
    return {{key + "name", layer},
            {key + "hash", "MurmurHash3_32"},
            {key + "conversion", "uint32_to_float32"},
            {key + "manifest", json + "}"}};
}

} // namespace weft::film
