// weft convert OLD NEW: a scene file of another dialect in today's words.
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "image/atomic_file.h"
#include "io/convert.h"
#include "io/gltf.h"

namespace weft::apps {

namespace {

struct ConvertArguments {
    std::string from, to;
};

int run(ConvertArguments const& a) {
    if (io::is_gltf(a.from))
        throw InputError({a.from},
                         "expected an XML scene, found a glTF file, which has no dialects");
    io::Converted converted;
    {
        FileBytes const bytes = read_file(a.from);
        converted = io::convert_scene(bytes.view(), a.from, a.to);
    }
    for (std::string const& note : converted.notes) fmt::print(stderr, "note: {}\n", note);
    image::replace_file(a.to, converted.text);
    fmt::print("{}\n", a.to);
    return kDone;
}

} // namespace

void add_convert_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<ConvertArguments>();
    CLI::App* c = app.add_subcommand(
        "convert", "Write a scene file of another dialect in today's words: all that it says, its "
                   "comments and its layout stay");
    c->add_option("old", a->from, "The scene file")->required()->type_name("OLD");
    c->add_option("new", a->to, "The file to write; it may be the old one")
        ->required()
        ->type_name("NEW");
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
