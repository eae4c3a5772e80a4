// lightsweep: the command line. Every failure that a user can cure is one line on stderr and an exit code.
#include "bench/cli/commands.h"
#include "bench/measure/checked_main.h"
#include "bench/measure/environment.h"
#include "renderer/base/error.h"
#include "renderer/base/names.h"

#include <fmt/format.h>

#include <map>
#include <vector>

namespace lightsweep {
namespace {

int run_program(int argc, char** argv) {
    CLI::App app{"Which shading path, which G-buffer layout: at what cost in time, and what cost in error?",
                 "lightsweep"};
    app.set_version_flag("--version", program_version() + " (" + program_git_commit().value_or("no commit") + ")");
    app.require_subcommand(1);
    app.fallthrough();
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const std::vector<std::pair<std::string, std::function<Command(CLI::App&)>>> table = {
        {"list", add_list},
        {"doctor", add_doctor},
        {"needs", add_needs},
        {"render", add_render},
        {"diff", add_diff},
        {"encodings", add_encodings},
        {"compare", add_compare},
        {"merge", add_merge},
        {"run", [&](CLI::App& command) { return add_run(command, arguments); }},
        {"explore", [&](CLI::App& command) { return add_explore(command, arguments); }},
        {"stress", [&](CLI::App& command) { return add_stress(command, arguments); }},
    };
    std::map<std::string, Command> commands;
    std::vector<std::string> names;
    for (const auto& [name, add] : table) {
        names.push_back(name);
        commands[name] = add(app);
    }
    if (argc > 1 && argv[1][0] != '-' && !commands.contains(argv[1])) {
        throw InputError(unknown_name("command", argv[1], names));
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        throw InputError(fmt::format("{} (lightsweep --help shows the usage)", error.what()));
    }
    return commands.at(app.get_subcommands().front()->get_name())();
}

}  // namespace
}  // namespace lightsweep

int main(int argc, char** argv) { return lightsweep::checked_main("lightsweep", lightsweep::run_program, argc, argv); }
