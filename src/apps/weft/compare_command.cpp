// weft compare A [B...] REFERENCE: how far pictures are from a reference.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>

#include "apps/weft/commands.h"
#include "apps/weft/compare_report.h"
#include "apps/weft/number_check.h"
#include "apps/weft/picture_file.h"
#include "base/color.h"
#include "image/atomic_file.h"
#include "image/compare.h"
#include "image/layers.h"
#include "image/write.h"
#include "post/flip.h"

namespace weft::apps {

namespace {

struct CompareArguments {
    std::vector<std::string> pictures; ///< the last is the reference
    std::vector<std::string> channels; ///< none: all
    std::string difference, report;
    double mae = -1, me = -1, mse = -1, rel_mse = -1, flip = -1;
};

/// Red where A is brighter than B, blue where it is darker, on a scale that shows the largest.
image::Image signed_colors(image::Image const& difference, double largest) {
    image::Image picture = image::make_image(difference.width, difference.height, 3);
    float const scale = largest > 0 ? float(1 / largest) : 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            float sum = 0;
            for (int c = 0; c < difference.channels; ++c)
                sum += difference.at(x, y, c) * scale / float(difference.channels);
            picture.at(x, y, 0) = std::max(sum, 0.f);
            picture.at(x, y, 2) = std::max(-sum, 0.f);
        }
    return picture;
}

/// Linear light, as a screen shows the numbers that the file holds.
image::Image light_of(image::Image image) {
    if (image.is_srgb_encoded)
        for (float& x : image.pixels) x = srgb_to_linear(x);
    image.is_srgb_encoded = false;
    return image;
}

struct Comparison {
    image::Difference difference; ///< of the colours
    std::vector<image::ChannelDifference> others;
    std::optional<image::Image> flip; ///< where it is asked for
};

/// LDR-FLIP where both hold screen colours, and else HDR-FLIP.
bool is_ldr(image::Image const& a, image::Image const& b) {
    return a.is_srgb_encoded && b.is_srgb_encoded;
}

/// A picture, and where it comes from.
struct Compared {
    std::string path;
    image::Image image;
};

/// Adds the parts that are not in the images, whose channels are called PART.CHANNEL.
void compare_apart(Compared const& a, Compared const& b,
                   std::vector<image::ChannelDifference>& to) {
    auto const has = [](Compared const& c, std::string const& part) {
        return std::find(c.image.apart.begin(), c.image.apart.end(), part) != c.image.apart.end();
    };
    for (std::string const& part : b.image.apart) {
        if (!has(a, part)) {
            to.push_back({part, false, true, {}});
            continue;
        }
        for (auto& c : image::compare_channels(image::read_part(a.path, part),
                                               image::read_part(b.path, part), true)) {
            c.name = part + "." + c.name;
            to.push_back(std::move(c));
        }
    }
    for (std::string const& part : a.image.apart)
        if (!has(b, part)) to.push_back({part, true, false, {}});
}

/// Compares the colours of two pictures, and all other channels.
Comparison compare(Compared const& a, Compared const& b, bool with_flip) {
    Comparison result{
        image::compare(a.image, b.image), image::compare_channels(a.image, b.image), {}};
    compare_apart(a, b, result.others);
    if (!with_flip) return result;
    image::Image const test = light_of(image::colors_of(a.image)),
                       reference = light_of(image::colors_of(b.image));
    result.flip = is_ldr(a.image, b.image) ? post::ldr_flip(reference, test)
                                           : post::hdr_flip(reference, test).errors;
    return result;
}

void print(Comparison const& c, bool ldr) {
    image::Difference const& d = c.difference;
    fmt::print("MSE     {:.6e}\nrelMSE  {:.6e}\nMAE     {:.6e}\nME      {:+.6e}\nlargest {:.6e}\n",
               d.mse, d.rel_mse, d.mae, d.me, d.max);
    if (c.flip) fmt::print("FLIP    {:.6f} ({})\n", post::mean_error(*c.flip), ldr ? "LDR" : "HDR");
    if (d.non_finite) fmt::print("{} values are not finite\n", d.non_finite);
    std::vector<std::string> equal;
    for (auto const& [name, in_image, in_reference, other] : c.others) {
        if (!in_image || !in_reference)
            fmt::print("{}: {}\n", name,
                       in_image ? "the reference lacks it" : "the picture lacks it");
        else if (other.max == 0 && other.non_finite == 0)
            equal.push_back(name);
        else
            fmt::print("{}: MSE {:.6e}, relMSE {:.6e}, MAE {:.6e}, ME {:+.6e}, largest {:.6e}{}\n",
                       name, other.mse, other.rel_mse, other.mae, other.me, other.max,
                       other.non_finite ? fmt::format(", {} values not finite", other.non_finite)
                                        : "");
    }
    if (!equal.empty()) fmt::print("the same: {}\n", fmt::join(equal, ", "));
}

/// Keeps the channels that the user names: themselves, or all of a layer or part.
void keep_wanted(std::vector<std::string> const& wanted, Comparison& c) {
    if (wanted.empty()) return;
    std::erase_if(c.others, [&](image::ChannelDifference const& d) {
        return std::none_of(wanted.begin(), wanted.end(), [&](std::string const& name) {
            return d.name == name || d.name.starts_with(name + ".");
        });
    });
}

void write_difference(CompareArguments const& args, image::Image const& a, image::Image const& b,
                      double largest) {
    image::Image const difference = image::difference_image(a, b);
    bool const exr = image::is_exr(args.difference);
    image::write_image(args.difference, exr ? difference : signed_colors(difference, largest));
    fmt::print(
        "{}{}\n", args.difference,
        exr ? ""
            : fmt::format(
                  ": red where the first is brighter, blue where darker; full colour is {:.3g}",
                  largest));
}

Report make_report(bool ldr) {
    Report report;
    report.metrics = {{"MSE", "mean of (a - b)\u00b2", 0, false},
                      {"relMSE", "mean of (a - b)\u00b2 / (b\u00b2 + 0.01)", 0, false},
                      {"MAE", "mean of |a - b|", 0, false},
                      {"ME", "mean of a - b: the bias that noise does not explain", 0, false},
                      {"largest", "largest |a - b|", 0, false},
                      {ldr ? "LDR-FLIP" : "HDR-FLIP", "mean of FLIP's errors", 4, false},
                      {"not finite", "values that are not a number or infinite", 0, true}};
    report.flip_kind = ldr ? "LDR-FLIP" : "HDR-FLIP";
    report.note = "With a the picture and b the reference, over all colour values as the files "
                  "hold them. FLIP is what a viewer who flips between the two sees change, from 0 "
                  "to 1, on a screen of 67 pixels per degree.";
    return report;
}

ReportPicture report_picture(std::string const& path, image::Image const& image,
                             Comparison const* c) {
    ReportPicture picture{path, light_of(image::colors_of(image)), {}, {}};
    if (!c) return picture;
    image::Difference const& d = c->difference;
    picture.metrics = {
        d.mse, d.rel_mse, d.mae, d.me, d.max, post::mean_error(*c->flip), double(d.non_finite)};
    picture.flip = *c->flip;
    return picture;
}

bool passes(CompareArguments const& args, Comparison const& c) {
    auto within = [](double value, double limit) { return limit < 0 || value <= limit; };
    auto all_within = [&](image::Difference const& d) {
        return within(d.mae, args.mae) && within(std::abs(d.me), args.me) &&
               within(d.mse, args.mse) && within(d.rel_mse, args.rel_mse) && d.non_finite == 0;
    };
    return all_within(c.difference) &&
           (args.flip < 0 || within(post::mean_error(*c.flip), args.flip)) &&
           std::all_of(c.others.begin(), c.others.end(), [&](auto const& other) {
               return other.in_image && other.in_reference && all_within(other.difference);
           });
}

void check(CompareArguments const& args) {
    if (args.pictures.size() > 2 && !args.difference.empty())
        throw InputError("--diff expects one picture and a reference, found " +
                         std::to_string(args.pictures.size() - 1) +
                         " pictures; --report shows all");
    if (args.report.empty()) return;
    if (!args.report.ends_with(".html") && !args.report.ends_with(".htm"))
        throw InputError("--report expects a file name that ends in .html, found '" + args.report +
                         "'");
    try {
        image::probe_folder(args.report);
    } catch (image::IoError const& e) {
        throw InputError(e.what());
    }
}

int run(CompareArguments const& args) {
    check(args);
    bool const with_flip = !args.report.empty() || args.flip >= 0;
    Compared const reference{args.pictures.back(), image::read_image(args.pictures.back())};
    Report report;
    bool passed = true;
    for (size_t i = 0; i + 1 < args.pictures.size(); ++i) {
        Compared const picture{args.pictures[i], image::read_image(args.pictures[i])};
        warn_of_words(picture.path, picture.image);
        bool const ldr = is_ldr(picture.image, reference.image);
        if (picture.image.is_srgb_encoded != reference.image.is_srgb_encoded)
            fmt::print(stderr,
                       "warning: one of {} and {} holds screen colours and the other light; their "
                       "numbers are compared as they are\n",
                       picture.path, reference.path);
        if (args.pictures.size() > 2) fmt::print("{}{}\n", i ? "\n" : "", picture.path);
        Comparison c = compare(picture, reference, with_flip);
        keep_wanted(args.channels, c);
        print(c, ldr);
        passed = passes(args, c) && passed;
        if (!args.difference.empty())
            write_difference(args, picture.image, reference.image, c.difference.max);
        if (args.report.empty()) continue;
        if (report.pictures.empty()) report = make_report(ldr);
        report.pictures.push_back(report_picture(picture.path, picture.image, &c));
    }
    if (!args.report.empty()) {
        report.pictures.push_back(report_picture(reference.path, reference.image, nullptr));
        write_report(args.report, report);
        fmt::print("{}\n", args.report);
    }
    return passed ? kDone : kFailed;
}

} // namespace

void add_compare_command(CLI::App& app, Command& chosen) {
    auto args = std::make_shared<CompareArguments>();
    CLI::App* c = app.add_subcommand(
        "compare", "Compare pictures with a reference: their colours, and one by one all other "
                   "channels and parts; fails (1) beyond the limits given, where a value is not "
                   "finite, and where one of them lacks a channel");
    c->add_option("pictures", args->pictures, "The pictures, and last the reference")
        ->required()
        ->expected(2, 64)
        ->type_name("A [B...] REFERENCE");
    c->add_option("--channels", args->channels,
                  "Beside the colours, compare only these channels, layers or parts; RGB is none")
        ->delimiter(',')
        ->type_name("NAMES");
    c->add_option("--diff", args->difference,
                  "Write the difference as a picture: signed numbers as .exr, red and blue as .png")
        ->type_name("OUT");
    c->add_option("--report", args->report,
                  "Write a page for a browser that shows the pictures against each other: a line "
                  "to drag, exposure, zoom, difference, FLIP, and these numbers")
        ->type_name("OUT.html");
    c->add_option("--mae", args->mae, "Largest mean absolute error allowed")
        ->check(number_within(0));
    c->add_option("--me", args->me, "Largest magnitude of the mean error allowed")
        ->check(number_within(0));
    c->add_option("--mse", args->mse, "Largest mean squared error allowed")
        ->check(number_within(0));
    c->add_option("--relmse", args->rel_mse, "Largest relative mean squared error allowed")
        ->check(number_within(0));
    c->add_option("--flip", args->flip,
                  "Print mean FLIP (LDR-FLIP of screen colours, else HDR-FLIP); the largest "
                  "allowed, 1 for any")
        ->check(number_within(0));
    c->callback([args, &chosen] { chosen = [args] { return run(*args); }; });
}

} // namespace weft::apps
