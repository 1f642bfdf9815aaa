// weft completion SHELL: a script that completes the command line in a shell.
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/completion.h"

namespace weft::apps {

void add_completion_command(CLI::App& app, Command& chosen) {
    auto shell = std::make_shared<std::string>();
    CLI::App* c = app.add_subcommand(
        "completion",
        "Print a script with which a shell completes commands, options and file names: "
        "`source <(weft completion bash)`");
    c->add_option("shell", *shell, "The shell")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    c->callback([shell, &app, &chosen] {
        chosen = [shell, &app] {
            auto const commands = command_texts(app);
            fmt::print("{}", *shell == "bash"  ? bash_completion(commands)
                             : *shell == "zsh" ? zsh_completion(commands)
                                               : fish_completion(commands));
            return int(kDone);
        };
    });
}

} // namespace weft::apps
