#include "session/render_state.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

#include "base/file_bytes.h"
#include "base/hash.h"
#include "image/atomic_file.h"
#include "session/adaptive.h"

namespace weft::session {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kMagic = "weft render state 1\n";

/// Eight bytes at a time: states are as large as pictures.
uint64_t checksum(std::string_view bytes) {
    uint64_t hash = bytes.size();
    for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
        uint64_t v;
        std::memcpy(&v, bytes.data(), 8);
        hash = hash64(hash ^ v);
    }
    return hash_bytes(bytes, hash);
}

void append(std::string& to, uint64_t v) { to.append(reinterpret_cast<char const*>(&v), sizeof v); }

uint64_t number_at(std::string_view bytes, size_t at) {
    uint64_t v;
    std::memcpy(&v, bytes.data() + at, sizeof v);
    return v;
}

Json to_json(RenderState const& s) {
    Json bad = Json::array();
    // The bits of a value that is not finite are no JSON number.
    for (BadSample const& b : s.first_bad_samples) {
        uint32_t bits[3];
        std::memcpy(bits, &b.value, sizeof bits);
        bad.push_back({b.pixel.x, b.pixel.y, b.sample, bits[0], bits[1], bits[2]});
    }
    return {{"identity", s.identity},
            {"part", {s.part.shard, s.part.shards, s.part.first, s.part.last}},
            {"tileSize", s.tile_size},
            {"samples", s.samples},
            {"passEnd", s.pass.to},
            {"activeBlocks", s.pass.active},
            {"seconds", s.seconds},
            {"badSamples", s.bad_samples},
            {"firstBadSamples", bad},
            {"note", s.note}};
}

RenderState from_json(Json const& j) {
    RenderState s;
    j.at("identity").get_to(s.identity);
    Json const& part = j.at("part");
    s.part = {part.at(0), part.at(1), part.at(2), part.at(3)};
    j.at("tileSize").get_to(s.tile_size);
    j.at("samples").get_to(s.samples);
    j.at("passEnd").get_to(s.pass.to);
    j.at("activeBlocks").get_to(s.pass.active);
    j.at("seconds").get_to(s.seconds);
    j.at("badSamples").get_to(s.bad_samples);
    for (Json const& b : j.at("firstBadSamples")) {
        BadSample sample{{b.at(0), b.at(1)}, b.at(2), {}};
        uint32_t const bits[3]{b.at(3), b.at(4), b.at(5)};
        std::memcpy(&sample.value, bits, sizeof bits);
        s.first_bad_samples.push_back(sample);
    }
    j.at("note").get_to(s.note);
    return s;
}

/// Returns whether the film has all samples of the state's part.
bool is_finished(RenderState const& s) {
    uint32_t const last = s.part.last == 0 ? s.samples : s.part.last;
    for (film::Region const& tile : make_tiles(s.film.region(), s.tile_size, s.part))
        for (int y = tile.from.y; y < tile.to.y; ++y)
            for (int x = tile.from.x; x < tile.to.x; ++x)
                if (s.film.counts(x, y).all != last - s.part.first) return false;
    return true;
}

} // namespace

RenderState make_state(RenderResult const& result, Plan const& plan, RenderOptions const& options) {
    RenderState s;
    s.identity = options.identity;
    s.part = options.picture.part;
    s.tile_size = options.tile_size;
    s.samples = plan.samples;
    s.pass = result.pass;
    s.seconds = result.seconds;
    s.bad_samples = result.bad_samples;
    s.first_bad_samples = result.first_bad_samples;
    return s;
}

RenderState starting_state(Plan const& plan, RenderOptions const& options) {
    RenderState state = make_state({}, plan, options);
    state.film = film::Film(plan.region, plan.layout);
    return state;
}

RenderState to_state(RenderResult&& result, Plan const& plan, RenderOptions const& options) {
    RenderState state = make_state(result, plan, options);
    state.film = std::move(result.film);
    return state;
}

std::string write_state(RenderState const& state) {
    std::string bytes(kMagic);
    std::string const head = to_json(state).dump();
    append(bytes, head.size());
    bytes += head;
    bytes += state.film.write_state();
    append(bytes, checksum(bytes));
    return bytes;
}

RenderState read_state(std::string_view bytes, std::string const& name) {
    auto const fail = [&](char const* what) { return InputError(name + ": " + what); };
    if (bytes.substr(0, kMagic.size()) != kMagic)
        throw fail("expected the state of a render as this version of Weft writes it");
    size_t const start = kMagic.size() + 8;
    if (bytes.size() < start + 8 ||
        checksum(bytes.substr(0, bytes.size() - 8)) != number_at(bytes, bytes.size() - 8))
        throw fail("the file is damaged or cut off");
    uint64_t const head = number_at(bytes, kMagic.size());
    if (head > bytes.size() - 8 - start) throw fail("the file is damaged");
    try {
        RenderState state = from_json(Json::parse(bytes.substr(start, head)));
        state.film =
            film::Film::read_state(bytes.substr(start + head, bytes.size() - 8 - start - head));
        bool const sane = state.tile_size >= 1 && state.part.shard >= 1 &&
                          state.part.shard <= state.part.shards &&
                          state.part.first <= state.part.last &&
                          (state.pass.active.empty() ||
                           state.pass.active.size() == BlockGrid(state.film.region()).size());
        if (!sane) throw fail("the file is damaged");
        return state;
    } catch (nlohmann::json::exception const&) {
        throw fail("the file is damaged");
    }
}

void save_state(std::string const& path, RenderState const& state) {
    image::replace_file(path, write_state(state));
}

RenderState load_state(std::string const& path) { return read_state(read_file(path).view(), path); }

namespace {

[[noreturn]] void fail(std::string const& message) { throw InputError("cannot merge: " + message); }

void check_same_render(std::vector<RenderState> const& parts,
                       std::vector<std::string> const& names) {
    for (size_t i = 1; i < parts.size(); ++i)
        if (std::string const d = difference(parts[0].identity, parts[i].identity); !d.empty())
            fail(
                fmt::format("{} is of another render than {} ('here'): {}", names[i], names[0], d));
    for (size_t i = 0; i < parts.size(); ++i)
        if (!is_finished(parts[i]))
            fail(fmt::format("{} ({}) was stopped before it was done", names[i],
                             to_string(parts[i].part)));
}

/// The shards of one range of samples: each is there, once.
void check_shards(std::vector<size_t> const& which, std::vector<RenderState> const& parts,
                  std::vector<std::string> const& names) {
    RenderState const& first = parts[which[0]];
    std::vector<std::string> holder(size_t(first.part.shards));
    for (size_t i : which) {
        Part const& p = parts[i].part;
        if (p.shards != first.part.shards || parts[i].tile_size != first.tile_size)
            fail(fmt::format("{} is {} with tiles of {}, but {} is {} with tiles of {}", names[i],
                             to_string(p), parts[i].tile_size, names[which[0]],
                             to_string(first.part), first.tile_size));
        std::string& held = holder[size_t(p.shard - 1)];
        if (!held.empty())
            fail(fmt::format("{} is there twice: {} and {}", to_string(p), held, names[i]));
        held = names[i];
    }
    std::string missing;
    for (int k = 1; k <= first.part.shards; ++k) {
        Part p = first.part;
        p.shard = k;
        if (holder[size_t(k - 1)].empty()) missing += (missing.empty() ? "" : ", ") + to_string(p);
    }
    if (!missing.empty()) fail("missing: " + missing);
}

} // namespace

RenderState merge(std::vector<RenderState> parts, std::vector<std::string> const& names) {
    if (parts.empty()) fail("no parts are given");
    check_same_render(parts, names);
    std::map<std::pair<uint32_t, uint32_t>, std::vector<size_t>> ranges;
    uint32_t const all = parts[0].samples;
    for (size_t i = 0; i < parts.size(); ++i) {
        Part const& p = parts[i].part;
        ranges[{p.first, p.last == 0 ? all : p.last}].push_back(i);
    }
    uint32_t next = 0;
    for (auto const& [range, which] : ranges) {
        if (range.first > next) fail(fmt::format("missing: samples {}:{}", next, range.first));
        if (range.first < next)
            fail(fmt::format("samples {}:{} are there twice, in {} too", range.first,
                             std::min(next, range.second), names[which[0]]));
        check_shards(which, parts, names);
        next = range.second;
    }
    if (next != all) fail(fmt::format("missing: samples {}:{}", next, all));

    RenderState whole;
    whole.film = film::Film(parts[0].film.region(), parts[0].film.layout());
    for (auto const& [range, which] : ranges)
        for (size_t i : which) {
            whole.film.merge(parts[i].film);
            whole.seconds += parts[i].seconds;
            whole.bad_samples += parts[i].bad_samples;
        }
    whole.identity = std::move(parts[0].identity);
    whole.note = std::move(parts[0].note);
    whole.samples = whole.pass.to = all;
    whole.tile_size = parts[0].tile_size;
    return whole;
}

} // namespace weft::session
