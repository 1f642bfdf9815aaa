// The command line: `weft render`, `merge`, `replay`, `test`, `convert`, `info`, `compare`,
// `display`, `bloom`, `maketx`, `denoise`, `help`, `schema`, `docs`, `completion`.
#include <cstdio>
#include <filesystem>

#include "apps/weft/commands.h"
#include "apps/weft/interrupt.h"
#include "base/error.h"
#include "image/image.h"

int main(int argc, char** argv) {
    using namespace weft::apps;
    handle_interrupts();
    CLI::App app{"Weft, a path tracer", "weft"};
    app.set_version_flag("--version", "weft " WEFT_VERSION);
    app.require_subcommand(1);
    app.footer("Start with:  weft render SCENE.xml    weft help");
    Command chosen;
    add_render_command(app, chosen);
    add_replay_command(app, chosen);
    add_merge_command(app, chosen);
    add_test_command(app, chosen);
    add_convert_command(app, chosen);
    add_info_command(app, chosen);
    add_compare_command(app, chosen);
    add_display_command(app, chosen);
    add_bloom_command(app, chosen);
    add_maketx_command(app, chosen);
    add_denoise_command(app, chosen);
    add_help_command(app, chosen);
    add_schema_command(app, chosen);
    add_docs_command(app, chosen);
    add_completion_command(app, chosen);
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? kDone : kInputError;
    }
    try {
        return chosen();
    } catch (weft::InputError const& e) {
        std::fprintf(stderr, "error: %s\n", e.what());
        return kInputError;
    } catch (weft::image::IoError const& e) {
        std::fprintf(stderr, "error: %s\n", e.what());
        return kInputError;
    } catch (std::filesystem::filesystem_error const& e) { // a path that the system does not take
        std::fprintf(stderr, "error: %s: %s\n", e.path1().c_str(), e.code().message().c_str());
        return kInputError;
    } catch (std::exception const& e) {
        std::fprintf(stderr, "internal error: %s\n", e.what());
        return kInternalError;
    }
}
