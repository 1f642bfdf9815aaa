// weft compare A [B...] REFERENCE: how far pictures are from a reference.
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>

#include "apps/weft/commands.h"
#include "apps/weft/compare_report.h"
#include "apps/weft/number_check.h"
#include "base/color.h"
#include "image/atomic_file.h"
#include "image/compare.h"
#include "image/write.h"
#include "post/flip.h"

namespace weft::apps {

namespace {

struct CompareArguments {
    std::vector<std::string> pictures; ///< the last is the reference
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
    image::Difference difference;
    std::optional<image::Image> flip; ///< where it is asked for
};

/// LDR-FLIP where both hold screen colours, and else HDR-FLIP.
bool is_ldr(image::Image const& a, image::Image const& b) {
    return a.is_srgb_encoded && b.is_srgb_encoded;
}

Comparison compare(image::Image const& a, image::Image const& b, bool with_flip) {
    Comparison result{image::compare(a, b), {}};
    if (!with_flip) return result;
    image::Image const test = light_of(a), reference = light_of(b);
    result.flip =
        is_ldr(a, b) ? post::ldr_flip(reference, test) : post::hdr_flip(reference, test).errors;
    return result;
}

void print(Comparison const& c, bool ldr) {
    image::Difference const& d = c.difference;
    fmt::print("MSE     {:.6e}\nrelMSE  {:.6e}\nMAE     {:.6e}\nME      {:+.6e}\nlargest {:.6e}\n",
               d.mse, d.rel_mse, d.mae, d.me, d.max);
    if (c.flip) fmt::print("FLIP    {:.6f} ({})\n", post::mean_error(*c.flip), ldr ? "LDR" : "HDR");
    if (d.non_finite) fmt::print("{} values are not finite\n", d.non_finite);
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
    ReportPicture picture{path, light_of(image), {}, {}};
    if (!c) return picture;
    image::Difference const& d = c->difference;
    picture.metrics = {
        d.mse, d.rel_mse, d.mae, d.me, d.max, post::mean_error(*c->flip), double(d.non_finite)};
    picture.flip = *c->flip;
    return picture;
}

bool passes(CompareArguments const& args, Comparison const& c) {
    auto within = [](double value, double limit) { return limit < 0 || value <= limit; };
    image::Difference const& d = c.difference;
    return within(d.mae, args.mae) && within(std::abs(d.me), args.me) && within(d.mse, args.mse) &&
           within(d.rel_mse, args.rel_mse) &&
           (args.flip < 0 || within(post::mean_error(*c.flip), args.flip)) && d.non_finite == 0;
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
    image::Image const reference = image::read_image(args.pictures.back());
    Report report;
    bool passed = true;
    for (size_t i = 0; i + 1 < args.pictures.size(); ++i) {
        image::Image const picture = image::read_image(args.pictures[i]);
        bool const ldr = is_ldr(picture, reference);
        if (picture.is_srgb_encoded != reference.is_srgb_encoded)
            fmt::print(stderr,
                       "warning: one of {} and {} holds screen colours and the other light; their "
                       "numbers are compared as they are\n",
                       args.pictures[i], args.pictures.back());
        if (args.pictures.size() > 2) fmt::print("{}{}\n", i ? "\n" : "", args.pictures[i]);
        Comparison const c = compare(picture, reference, with_flip);
        print(c, ldr);
        passed = passes(args, c) && passed;
        if (!args.difference.empty()) write_difference(args, picture, reference, c.difference.max);
        if (args.report.empty()) continue;
        if (report.pictures.empty()) report = make_report(ldr);
        report.pictures.push_back(report_picture(args.pictures[i], picture, &c));
    }
    if (!args.report.empty()) {
        report.pictures.push_back(report_picture(args.pictures.back(), reference, nullptr));
        write_report(args.report, report);
        fmt::print("{}\n", args.report);
    }
    return passed ? kDone : kFailed;
}

} // namespace

void add_compare_command(CLI::App& app, Command& chosen) {
    auto args = std::make_shared<CompareArguments>();
    CLI::App* c = app.add_subcommand(
        "compare", "Compare pictures with a reference; fails (1) beyond the limits given, or where "
                   "a value is not finite");
    c->add_option("pictures", args->pictures, "The pictures, and last the reference")
        ->required()
        ->expected(2, 64)
        ->type_name("A [B...] REFERENCE");
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
