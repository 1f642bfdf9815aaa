// weft compare A B: how far picture A is from the reference B.
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "image/compare.h"
#include "image/write.h"

namespace weft::apps {

namespace {

struct Arguments {
    std::string a, b, difference;
    double mae = -1, me = -1, mse = -1, rel_mse = -1;
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

int run(Arguments const& args) {
    image::Image const a = image::read_image(args.a), b = image::read_image(args.b);
    image::Difference const d = image::compare(a, b);
    fmt::print("MSE     {:.6e}\nrelMSE  {:.6e}\nMAE     {:.6e}\nME      {:+.6e}\nlargest {:.6e}\n",
               d.mse, d.rel_mse, d.mae, d.me, d.max);
    if (d.non_finite) fmt::print("{} values are not finite\n", d.non_finite);
    if (!args.difference.empty()) {
        image::Image const difference = image::difference_image(a, b);
        bool const exr = args.difference.ends_with(".exr");
        image::write_image(args.difference, exr ? difference : signed_colors(difference, d.max));
        fmt::print(
            "{}{}\n", args.difference,
            exr ? ""
                : fmt::format(
                      ": red where the first is brighter, blue where darker; full colour is {:.3g}",
                      d.max));
    }
    auto within = [](double value, double limit) { return limit < 0 || value <= limit; };
    bool const passed = within(d.mae, args.mae) && within(std::abs(d.me), args.me) &&
                        within(d.mse, args.mse) && within(d.rel_mse, args.rel_mse);
    return passed && d.non_finite == 0 ? kDone : kFailed;
}

} // namespace

void add_compare_command(CLI::App& app, Command& chosen) {
    auto args = std::make_shared<Arguments>();
    CLI::App* c =
        app.add_subcommand("compare", "Compare a picture with a reference; fails (1) beyond the "
                                      "limits given, or where a value is not finite");
    c->add_option("a", args->a, "The picture")->required()->type_name("A");
    c->add_option("b", args->b, "The reference")->required()->type_name("B");
    c->add_option("--diff", args->difference,
                  "Write the difference as a picture: signed numbers as .exr, red and blue as .png")
        ->type_name("OUT");
    c->add_option("--mae", args->mae, "Largest mean absolute error allowed");
    c->add_option("--me", args->me, "Largest magnitude of the mean error allowed");
    c->add_option("--mse", args->mse, "Largest mean squared error allowed");
    c->add_option("--relmse", args->rel_mse, "Largest relative mean squared error allowed");
    c->callback([args, &chosen] { chosen = [args] { return run(*args); }; });
}

} // namespace weft::apps
