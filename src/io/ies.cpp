#include "io/ies.h"

#include "base/file_bytes.h"
#include "io/mesh_text.h"
#include "schema/text.h"

#include <algorithm>
#include <cmath>

namespace weft::io {

namespace {

/// Numbers separated by blanks, commas and line ends.
class IesReader {
  public:
    IesReader(std::string_view text, std::string const& name)
        : text_(text), name_(name), p_(text.data()), end_(text.data() + text.size()) {}

    /// Goes to what TILT is set to.
    std::string_view skip_to_tilt() {
        while (p_ < end_) {
            char const* const line = p_;
            while (p_ < end_ && !is_line_end(*p_)) ++p_;
            std::string_view text(line, size_t(p_ - line));
            size_t const first = text.find_first_not_of(" \t");
            if (first != std::string_view::npos && text.substr(first, 5) == "TILT=") {
                p_ = token_ = line + first + 5;
                std::string_view const value = text.substr(first + 5);
                size_t const last = value.find_last_not_of(" \t");
                return value.substr(0, last == std::string_view::npos ? 0 : last + 1);
            }
            while (p_ < end_ && is_line_end(*p_)) ++p_;
        }
        throw InputError({name_}, "expected a line 'TILT=NONE' or 'TILT=INCLUDE', found none: it "
                                  "is no IES file");
    }
    void skip(size_t characters) { p_ += characters; }

    float number(std::string const& what) {
        next();
        float value = 0;
        char const* const after = p_ < end_ ? scan_float(p_, end_, value) : nullptr;
        if (!after || !(after == end_ || is_separator(*after)) || !std::isfinite(value))
            fail_found("a number as " + what);
        p_ = after;
        return value;
    }
    float number_of_at_least(float least, std::string const& what) {
        float const value = number(what);
        if (value < least)
            fail("expected a number of at least " + std::to_string(int(least)) + " as " + what +
                 ", found " + quoted(token()));
        return value;
    }
    /// A whole number, which some files write as "1.0".
    int count(int least, std::string const& what) {
        float const value = number(what);
        // No count is larger than what the file has bytes for.
        if (value != std::floor(value) || value < float(least) || value > float(text_.size()))
            fail("expected a whole number of at least " + std::to_string(least) +
                 ", and as many as the file can hold, as " + what + ", found " + quoted(token()));
        return int(value);
    }
    /// Ascending angles in degrees.
    std::vector<float> angles(int count, std::string const& what, float least = -360,
                              float most = 360) {
        std::vector<float> list;
        for (int i = 0; i < count; ++i) {
            float const angle = number(what + " " + std::to_string(i + 1));
            if (angle < least || angle > most)
                fail("expected a " + what + " of at least " + std::to_string(int(least)) +
                     " and at most " + std::to_string(int(most)) + ", found " + quoted(token()));
            if (!list.empty() && !(angle > list.back()))
                fail("expected a " + what + " above the one before, found " + quoted(token()));
            list.push_back(angle);
        }
        return list;
    }
    void finish() {
        next();
        bool const dos_end = end_ - p_ == 1 && *p_ == '\x1a';
        if (p_ < end_ && !dos_end) fail_found("the end of the file");
    }
    /// Fails at the number read last.
    [[noreturn]] void fail(std::string const& message) const {
        throw InputError(locate(text_, size_t(token_ - text_.data()), name_), message);
    }
    std::string_view token() const {
        char const* to = token_;
        while (to < end_ && !is_separator(*to)) ++to;
        return {token_, size_t(to - token_)};
    }

  private:
    static bool is_separator(char c) { return is_blank(c) || is_line_end(c) || c == ','; }
    void next() {
        while (p_ < end_ && is_separator(*p_)) ++p_;
        token_ = p_;
    }
    [[noreturn]] void fail_found(std::string const& expected) const {
        fail("expected " + expected + ", found " +
             (token_ == end_ ? "the end of the file" : quoted(token())));
    }

    std::string_view text_;
    std::string const& name_;
    char const *p_, *end_;
    char const* token_ = p_; ///< where the last number began
};

/// Tilt data are checked as the rest is, and not used.
void read_tilt(IesReader& in) {
    std::string_view const tilt = in.skip_to_tilt();
    if (tilt != "NONE" && tilt != "INCLUDE")
        in.fail("expected TILT=NONE or TILT=INCLUDE, found " + quoted(tilt));
    in.skip(tilt.size());
    if (tilt == "NONE") return;
    if (in.count(1, "the lamp-to-luminaire geometry") > 3)
        in.fail("expected 1, 2 or 3 as the lamp-to-luminaire geometry, found " +
                quoted(in.token()));
    int const pairs = in.count(1, "the number of tilt angles");
    in.angles(pairs, "tilt angle");
    for (int i = 0; i < pairs; ++i)
        in.number_of_at_least(0, "tilt multiplier " + std::to_string(i + 1));
}

struct Header {
    float lumens = -1, factor = 1, watts = 0;
    int vertical = 0, horizontal = 0;
};

Header read_header(IesReader& in, std::string_view bytes) {
    Header h;
    int const lamps = in.count(1, "the number of lamps");
    float const lumens = in.number("the lumens per lamp");
    if (lumens >= 0) h.lumens = float(lamps) * lumens;
    h.factor = in.number_of_at_least(0, "the candela multiplier");
    h.vertical = in.count(2, "the number of vertical angles");
    h.horizontal = in.count(1, "the number of horizontal angles");
    if (in.count(1, "the photometric type") != 1)
        in.fail("expected 1 as the photometric type (C: vertical planes), found " +
                quoted(in.token()) + "; 2 (B) and 3 (A) are not supported");
    if (in.count(1, "the type of units") > 2)
        in.fail("expected 1 (feet) or 2 (metres) as the type of units, found " +
                quoted(in.token()));
    for (char const* side : {"width", "length", "height"})
        in.number("the " + std::string(side) + " of the opening");
    h.factor *= in.number_of_at_least(0, "the ballast factor");
    float const photometric = in.number_of_at_least(0, "the ballast-lamp photometric factor");
    // Later editions keep the place for other uses.
    bool const later = bytes.starts_with("IESNA:LM-63-2002") || bytes.starts_with("IES:LM-63-2019");
    if (!later) h.factor *= photometric;
    h.watts = in.number("the input watts");
    return h;
}

enum class Symmetry { all_around, quarters, halves_at_0, halves_at_90, none };

/// What the horizontal angles, just read, stand for.
Symmetry symmetry_of(IesReader const& in, std::vector<float> const& angles) {
    float const first = angles.front(), last = angles.back();
    if (angles.size() == 1) return Symmetry::all_around;
    if (first == 0 && last == 90) return Symmetry::quarters;
    if (first == 0 && last == 180) return Symmetry::halves_at_0;
    if (first == 90 && last == 270) return Symmetry::halves_at_90;
    if (first == 0 && last > 180 && last <= 360) return Symmetry::none;
    in.fail("expected horizontal angles from 0 to 90, 180 or 360, or from 90 to 270, found some "
            "from " +
            schema::number_text(first) + " to " + schema::number_text(last));
}

/// The angle of the file at which `angle`, in [0, 360], is measured.
float folded(Symmetry symmetry, float angle) {
    switch (symmetry) {
    case Symmetry::all_around:
        return 0;
    case Symmetry::quarters: {
        float const half = angle > 180 ? 360 - angle : angle;
        return half > 90 ? 180 - half : half;
    }
    case Symmetry::halves_at_0:
        return angle > 180 ? 360 - angle : angle;
    case Symmetry::halves_at_90:
        return angle < 90 ? 180 - angle : angle > 270 ? 540 - angle : angle;
    case Symmetry::none:
        return angle;
    }
    return angle;
}

/// All angles in [0, 360] at which the completed lamp has a plane.
std::vector<float> all_angles(Symmetry symmetry, std::vector<float> const& of_file) {
    if (symmetry == Symmetry::all_around) return {0};
    std::vector<float> all(of_file);
    all.insert(all.end(), {0, 360});
    for (float angle : of_file) {
        if (symmetry == Symmetry::quarters) all.insert(all.end(), {180 - angle, 180 + angle});
        if (symmetry == Symmetry::halves_at_90) // 90 .. 180 go to 0 .. 90, the rest to 270 .. 360
            all.push_back(angle <= 180 ? 180 - angle : 540 - angle);
        else if (symmetry != Symmetry::none)
            all.push_back(360 - angle);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/// Completes the planes of the file, at `angles`, to all around.
void complete(scene::Photometry& lamp, Symmetry symmetry) {
    scene::Photometry const file = lamp;
    lamp.horizontal = all_angles(symmetry, file.horizontal);
    lamp.candela.clear();
    for (float angle : lamp.horizontal) {
        float const from = folded(symmetry, angle);
        // A file that stops short of 360 goes on with its first plane.
        auto const found = std::lower_bound(file.horizontal.begin(), file.horizontal.end(), from);
        size_t const high = size_t(found - file.horizontal.begin());
        bool const wraps = high == file.horizontal.size();
        float const above = wraps ? 360.f : file.horizontal[high];
        size_t const low = high > 0 ? high - 1 : 0, to = wraps ? 0 : high;
        float const below = file.horizontal[low];
        float const t = above > below ? (from - below) / (above - below) : 1;
        for (size_t v = 0; v < file.vertical.size(); ++v) {
            float const a = file.at(low, v), b = file.at(to, v);
            lamp.candela.push_back(t == 1 ? b : a + (b - a) * t);
        }
    }
}

} // namespace

scene::Photometry read_ies(std::string_view bytes, std::string const& name) {
    IesReader in(bytes, name);
    read_tilt(in);
    Header const header = read_header(in, bytes);
    scene::Photometry lamp;
    lamp.lamp_lumens = header.lumens;
    lamp.watts = header.watts;
    lamp.vertical = in.angles(header.vertical, "vertical angle", 0, 180);
    lamp.horizontal = in.angles(header.horizontal, "horizontal angle", 0, 360);
    Symmetry const symmetry = symmetry_of(in, lamp.horizontal);
    for (int h = 0; h < header.horizontal; ++h)
        for (int v = 0; v < header.vertical; ++v) {
            float const value = in.number_of_at_least(0, "candela " + std::to_string(v + 1) +
                                                             " of plane " + std::to_string(h + 1));
            lamp.candela.push_back(value * header.factor);
            if (!std::isfinite(lamp.candela.back()))
                in.fail("expected candela that a float can hold, found " + quoted(in.token()) +
                        " times a factor");
        }
    in.finish();
    complete(lamp, symmetry);
    return lamp;
}

scene::Photometry read_ies(std::string const& path) {
    return read_ies(read_file(path).view(), path);
}

} // namespace weft::io
