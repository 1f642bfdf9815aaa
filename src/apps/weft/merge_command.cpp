// weft merge PART...: joins the parts of a render to its picture.
#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/display_options.h"
#include "apps/weft/picture_file.h"
#include "apps/weft/progress_line.h"
#include "image/write.h"
#include "session/render_state.h"

namespace weft::apps {

namespace {

struct MergeArguments {
    std::vector<std::string> parts, outputs;
    OptionTexts display;
};

/// Says so where no file can hold the AOVs of the parts.
void warn_of_aovs(MergeArguments const& a, film::Layout const& layout) {
    auto const aovs = layout.aovs();
    bool const more = std::any_of(aovs.begin(), aovs.end(), [](film::Aov aov) {
        return aov != film::Aov::beauty && aov != film::Aov::alpha;
    });
    if (more && std::none_of(a.outputs.begin(), a.outputs.end(), image::is_exr))
        fmt::print(stderr, "warning: the AOVs of the parts are not written: only .exr files hold "
                           "them\n");
}

int run(MergeArguments const& a) {
    for (std::string const& output : a.outputs) image::check_writable(output);
    post::DisplayChain const chain = display_chain(a.display);
    print_warning(chain);
    std::vector<session::RenderState> parts;
    for (std::string const& part : a.parts) parts.push_back(session::load_state(part));
    size_t const count = parts.size();
    session::RenderState const whole = session::merge(std::move(parts), a.parts);
    image::ExrHeader header = parse_header(whole.note, a.parts[0]);
    header.texts["weft:samplesPerPixel"] = std::to_string(whole.samples);
    if (header.texts.contains("weft:renderSeconds"))
        header.texts["weft:renderSeconds"] = fmt::format("{:.3f}", whole.seconds);
    report_bad_samples(whole.bad_samples, whole.first_bad_samples, header.texts["weft:seed"]);
    warn_of_aovs(a, whole.film.layout());
    write_pictures(a.outputs, {whole.film.image(), header, {}}, chain);
    fmt::print(stderr, "{} x {} pixels, {} samples each, of {} parts\n",
               whole.film.region().width(), whole.film.region().height(), whole.samples, count);
    return kDone;
}

} // namespace

void add_merge_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<MergeArguments>();
    CLI::App* c =
        app.add_subcommand("merge", "Join parts that `render --shard` or `--samples` made");
    c->add_option("parts", a->parts, "Every part of one render (.weft)")
        ->required()
        ->type_name("PART");
    c->add_option("-o,--output", a->outputs, "Picture to write; may be given several times")
        ->required()
        ->type_name("OUT")
        ->take_all();
    add_display_options(*c, a->display);
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
