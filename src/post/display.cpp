#include "post/display.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/match.h"
#include "image/layers.h"
#include "post/tone_curves.h"
#include "schema/text.h"

namespace weft::post {

namespace {

std::vector<std::string> const& own_views() {
    static std::vector<std::string> const names{"standard", "agx", "aces"};
    return names;
}

View own_view(std::string const& name) {
    if (name == "agx") return AgxView{};
    if (name == "aces") return AcesView{};
    return StandardView{};
}

bool is_own(std::string const& view) {
    auto const& names = own_views();
    return std::find(names.begin(), names.end(), view) != names.end();
}

View find_view(scene::Display const& d) {
    char const* const variable = std::getenv("OCIO");
    std::string const environment = variable ? variable : "";
    if (!d.ocio.path.empty()) return OcioView({d.ocio.path, d.display, d.view, d.input_space});
    bool const own = d.view.empty() || is_own(d.view);
    bool const asks_for_ocio = !d.display.empty() || !d.input_space.empty();
    if (own && !asks_for_ocio) return own_view(d.view);
    if (!environment.empty()) return OcioView({environment, d.display, d.view, d.input_space});
    if (own)
        throw InputError(std::string(d.display.empty() ? "'inputSpace'" : "'display'") +
                         " expects an OpenColorIO configuration, found neither 'ocio' nor $OCIO");
    throw InputError("no view is called '" + d.view + "'" + suggestion(d.view, own_views()) +
                     "; views of an OpenColorIO configuration need 'ocio' or $OCIO");
}

std::string describe_chain(scene::Display const& d, View const& view) {
    std::string text;
    auto add = [&](std::string const& part) { text += (text.empty() ? "" : ", ") + part; };
    if (d.exposure != 0) add("exposure " + schema::number_text(d.exposure) + " stops");
    if (d.temperature != 0) add("white " + schema::number_text(d.temperature) + " K");
    if (d.tint != 0) add("tint " + schema::number_text(d.tint));
    if (d.temperature == 0 && balances_white(d))
        add("neutral " + schema::TextForm<Color>::write(d.neutral));
    if (auto const* o = std::get_if<OcioView>(&view))
        add("view " + o->view() + ", display " + o->display() + " (OpenColorIO)");
    else
        add("view " + own_views()[view.index()] + ", display sRGB");
    return text;
}

Color apply(StandardView, Color const& c) { return standard_view(c); }
Color apply(AgxView, Color const& c) { return agx_view(c); }
Color apply(AcesView, Color const& c) { return aces_view(c); }

/// Infinities become large numbers, not-a-number 0: a matrix would spread them.
Color finite(Color const& c) {
    auto bound = [](float x) { return x != x ? 0 : std::clamp(x, -1e30f, 1e30f); };
    return {bound(c.r), bound(c.g), bound(c.b)};
}

void show_colors(DisplayChain const& chain, std::vector<Color>& colors) {
    for (Color& c : colors) {
        c = chain.gain * c;
        if (chain.balance) c = *chain.balance * finite(c);
    }
    match(chain.view, [&](auto const& view) {
        if constexpr (std::is_same_v<decltype(view), OcioView const&>)
            view.apply(&colors.data()->r, colors.size());
        else
            for (Color& c : colors) c = apply(view, c);
    });
}

/// Where an image keeps its colours and its alpha; -1: nowhere.
struct Layout {
    std::array<int, 3> color{0, 0, 0};
    int alpha = -1;
    bool grey = true;
};

Layout layout_of(image::Image const& image) {
    auto find = [&](std::string const& name) {
        auto const at = std::find(image.names.begin(), image.names.end(), name);
        return at == image.names.end() ? -1 : int(at - image.names.begin());
    };
    if (auto const colors = image::find_colors(image.names)) {
        std::string const& red = image.names[size_t((*colors)[0])];
        return {*colors, find(red.substr(0, red.rfind('.') + 1) + "A"), false};
    }
    if (int const y = find("Y"); y >= 0) return {{y, y, y}, find("A"), true};
    if (image.channels > 4)
        throw InputError("expected channels R, G and B or Y, found " +
                         std::to_string(image.channels) + " others");
    bool const grey = image.channels < 3, alpha = image.channels % 2 == 0;
    return {grey ? std::array{0, 0, 0} : std::array{0, 1, 2}, alpha ? image.channels - 1 : -1,
            grey};
}

} // namespace

DisplayChain make_display_chain(scene::Display const& display, SourceLocation const& where) {
    try {
        DisplayChain chain;
        chain.gain = std::exp2(display.exposure);
        ColorMatrix const balance = white_balance(display);
        if (balances_white(display)) chain.balance = balance;
        chain.view = find_view(display);
        chain.description = describe_chain(display, chain.view);
        if (auto const* view = std::get_if<OcioView>(&chain.view)) chain.warning = view->warning();
        return chain;
    } catch (InputError const& e) {
        if (where.file.empty()) throw;
        throw InputError(where, e.what());
    }
}

image::Image show(DisplayChain const& chain, image::Image const& image, Alpha alpha) {
    Layout const from = layout_of(image);
    bool const keep_alpha = from.alpha >= 0 && alpha == Alpha::keep;
    bool const grey = from.grey && !chain.balance && !std::holds_alternative<OcioView>(chain.view);
    int const colors = grey ? 1 : 3;
    image::Image result =
        image::make_image(image.width, image.height, colors + (keep_alpha ? 1 : 0));
    result.is_srgb_encoded = true;
    tbb::parallel_for(tbb::blocked_range<int>(0, image.height), [&](auto const& rows) {
        std::vector<Color> row(size_t(image.width));
        for (int y = rows.begin(); y != rows.end(); ++y) {
            for (int x = 0; x < image.width; ++x) {
                float const a = keep_alpha ? image.at(x, y, from.alpha) : 1;
                auto channel = [&](size_t c) {
                    float const v = image.at(x, y, from.color[c]);
                    return keep_alpha && a > 0 ? v / a : v;
                };
                row[size_t(x)] = {channel(0), channel(1), channel(2)};
            }
            show_colors(chain, row);
            for (int x = 0; x < image.width; ++x) {
                for (int c = 0; c < colors; ++c) result.at(x, y, c) = row[size_t(x)][c];
                if (keep_alpha) result.at(x, y, colors) = image.at(x, y, from.alpha);
            }
        }
    });
    return result;
}

void write_picture(std::string const& path, image::Image const& image, DisplayChain const& chain,
                   image::Metadata metadata) {
    if (!image::is_for_screens(path)) {
        image::write_image(path, image, metadata);
        return;
    }
    metadata["ImageDescription"] = chain.description;
    // Only of an sRGB screen may the file claim that its numbers are sRGB.
    if (auto const* view = std::get_if<OcioView>(&chain.view);
        view && view->display().find("sRGB") == std::string::npos)
        metadata["oiio:ColorSpace"] = "";
    Alpha const alpha = image::holds_alpha(path) ? Alpha::keep : Alpha::drop;
    image::write_image(path, show(chain, image, alpha), metadata);
}

} // namespace weft::post
