#include "apps/weft/checkpoint.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>

#include "image/atomic_file.h"
#include "schema/text.h"

namespace weft::apps {

namespace {

namespace fs = std::filesystem;

/// Makes sure of the room for the file that the next checkpoint needs beside the last one. File
/// systems that cannot reserve any are taken at their word.
void check_room(std::string const& path) {
    auto const size = off_t(fs::file_size(path));
    image::replace_file(path + ".probe", [&](int descriptor, std::string const&) {
        int const error = ::posix_fallocate(descriptor, 0, size);
        if (error == ENOSPC || error == EFBIG || error == EDQUOT)
            throw image::IoError(fmt::format("{}: no room for a second file of {} MiB: {}", path,
                                             size >> 20, std::strerror(error)));
    });
    fs::remove(path + ".probe");
}

std::string part_difference(session::RenderState const& here, session::RenderState const& there) {
    if (!(here.part == there.part))
        return fmt::format("it is {} here and {} there", to_string(here.part),
                           to_string(there.part));
    if (here.part.shards > 1 && here.tile_size != there.tile_size)
        return fmt::format("tiles are of {} here and of {} there", here.tile_size, there.tile_size);
    return "";
}

} // namespace

void add_checkpoint_options(CLI::App& c, CheckpointArguments& a) {
    c.add_option("--checkpoint", a.interval,
                 "Keep what is done in OUT.checkpoint, this often (60s, 5m), and go on from there "
                 "where it is found")
        ->type_name("TIME");
    c.add_option("--checkpoint-file", a.file, "The same in this file; every 60s if not said")
        ->type_name("FILE");
    auto* const resume =
        c.add_flag("--resume", a.resume, "Go on from the checkpoint, which must be there");
    c.add_flag("--restart", a.restart, "Start again, whatever checkpoint is there")
        ->excludes(resume);
}

double parse_duration(std::string const& text, std::string const& option) {
    std::string number = text;
    double unit = 1;
    if (!number.empty())
        for (auto const& [letter, seconds] : {std::pair('s', 1.0), {'m', 60.0}, {'h', 3600.0}})
            if (number.back() == letter) {
                unit = seconds;
                number.pop_back();
                break;
            }
    auto const v = schema::read_components(number, 1);
    if (!v || !(v->front() > 0) || !(v->front() * unit < 1e9))
        throw InputError(option + " expects a time such as 90s, 10m or 2h, found '" + text + "'");
    return v->front() * unit;
}

Checkpoint::Checkpoint(CheckpointArguments const& a, std::string const& output,
                       session::RenderState const& start)
    : path_(a.file.empty() ? output + ".checkpoint" : a.file),
      interval_(a.interval.empty() ? 60 : parse_duration(a.interval, "--checkpoint")) {
    if (!a.restart && fs::exists(path_)) {
        session::RenderState state = session::load_state(path_);
        std::string different = session::difference(start.identity, state.identity);
        if (different.empty()) different = part_difference(start, state);
        if (!different.empty())
            throw InputError(path_ + ": the checkpoint is of another render: " + different +
                             "; --restart starts again and replaces it");
        fmt::print(stderr, "going on from {}, {:.0f} s of rendering\n", path_, state.seconds);
        found_ = std::move(state);
    } else if (a.resume) {
        throw InputError(path_ + ": expected a checkpoint to resume, found none");
    } else {
        session::save_state(path_, start);
    }
    check_room(path_);
}

session::Watcher Checkpoint::watcher() const {
    return {interval_, [this](session::RenderState const& state) { save(state); }};
}

void Checkpoint::save(session::RenderState const& state) const {
    try {
        session::save_state(path_, state);
    } catch (std::exception const& e) {
        fmt::print(stderr, "\nwarning: no checkpoint was written, the one before is kept: {}\n",
                   e.what());
    }
}

void Checkpoint::remove() const {
    std::error_code ignored; // it may be gone already
    fs::remove(path_, ignored);
}

} // namespace weft::apps
