// A film as bytes: a magic number with a version, the layout, the region, then every array as it
// lies in memory (little-endian).
#include <bit>
#include <cstring>
#include <type_traits>

#include "base/error.h"
#include "film/film.h"
#include "schema/text.h"

namespace weft::film {

namespace {

static_assert(std::endian::native == std::endian::little, "states are little-endian");

constexpr std::string_view kMagic = "weft film state 2\n";

class Writer {
  public:
    template <class T>
    void value(T const& v) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<char const*>(&v), sizeof v);
    }
    template <class T>
    void array(std::vector<T> const& v) {
        static_assert(std::is_trivially_copyable_v<T>);
        value(uint64_t(v.size()));
        if (!v.empty())
            bytes_.append(reinterpret_cast<char const*>(v.data()), v.size() * sizeof(T));
    }
    void text(std::string_view v) {
        value(uint64_t(v.size()));
        bytes_ += v;
    }
    void raw(std::string_view v) { bytes_ += v; }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

[[noreturn]] void fail() {
    throw InputError(
        "expected a film's state of this version of Weft, found other bytes or a part");
}

class Reader {
  public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}
    std::string_view raw(size_t size) {
        if (size > rest_.size()) fail();
        std::string_view const v = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return v;
    }
    template <class T>
    T value() {
        T v;
        std::memcpy(&v, raw(sizeof v).data(), sizeof v);
        return v;
    }
    /// Of a size that is known.
    template <class T>
    void array(std::vector<T>& to, size_t size) {
        if (value<uint64_t>() != size || size > rest_.size() / sizeof(T)) fail();
        to.resize(size);
        std::string_view const v = raw(size * sizeof(T));
        if (size > 0) std::memcpy(to.data(), v.data(), v.size());
    }
    template <class T>
    void array(std::vector<T>& to) {
        uint64_t size;
        if (sizeof size > rest_.size()) fail();
        std::memcpy(&size, rest_.data(), sizeof size);
        array(to, size_t(size));
    }
    std::string text() { return std::string(raw(value<uint64_t>())); }
    size_t left() const { return rest_.size(); }

  private:
    std::string_view rest_;
};

void write_layout(Writer& w, Layout const& layout) {
    std::vector<Aov> const aovs = layout.aovs();
    w.value(uint32_t(aovs.size()));
    for (Aov aov : aovs) w.text(info_of(aov).name);
    LayoutOptions const& o = layout.options();
    w.value(uint8_t(o.half_sums));
    w.value(uint8_t(o.squares));
    w.value(int32_t(o.cryptomatte_levels));
    for (auto const* names : {&o.light_groups, &o.layers}) {
        w.value(uint32_t(names->size()));
        for (std::string const& name : *names) w.text(name);
    }
}

Layout read_layout(Reader& r) {
    std::vector<Aov> aovs;
    for (uint32_t i = r.value<uint32_t>(); i > 0; --i) {
        std::string const name = r.text();
        if (!schema::TextForm<Aov>::read(name, aovs.emplace_back())) fail();
    }
    LayoutOptions o;
    o.half_sums = r.value<uint8_t>() != 0;
    o.squares = r.value<uint8_t>() != 0;
    o.cryptomatte_levels = r.value<int32_t>();
    for (auto* names : {&o.light_groups, &o.layers}) {
        names->clear();
        for (uint32_t i = r.value<uint32_t>(); i > 0; --i) names->push_back(r.text());
    }
    if (o.cryptomatte_levels < 1 || o.cryptomatte_levels > 1000) fail();
    return Layout(aovs, std::move(o));
}

} // namespace

std::string Film::write_state() const {
    Writer w;
    w.raw(kMagic);
    write_layout(w, layout_);
    for (int v : {region_.from.x, region_.from.y, region_.to.x, region_.to.y}) w.value(v);
    w.array(counts_);
    w.array(sums_);
    w.array(nearest_);
    for (auto const& pixels : ids_)
        for (IdCounts const& counts : pixels) w.array(counts);
    return w.take();
}

Film Film::read_state(std::string_view bytes) {
    Reader r(bytes);
    if (r.raw(std::min(kMagic.size(), bytes.size())) != kMagic) fail();
    Layout const layout = read_layout(r);
    Region region;
    for (int* v : {&region.from.x, &region.from.y, &region.to.x, &region.to.y})
        *v = r.value<int32_t>();
    bool const sane = region.from.x >= 0 && region.from.y >= 0 && region.to.x >= region.from.x &&
                      region.to.y >= region.from.y;
    // Before memory is taken: every pixel has its counts and sums.
    if (!sane || region.pixels() > r.left() / (size_t(layout.sums()) * sizeof(double))) fail();
    Film film(region, layout);
    size_t const pixels = region.pixels();
    r.array(film.counts_, pixels);
    r.array(film.sums_, film.sums_.size());
    r.array(film.nearest_, film.nearest_.size());
    for (auto& kind : film.ids_)
        for (IdCounts& counts : kind) r.array(counts);
    if (r.left() != 0) fail();
    return film;
}

} // namespace weft::film
