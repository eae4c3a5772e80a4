// lightsweep: the command line. Every failure that a user can cure is one line on stderr and an exit code.
#include "bench/cli/commands.h"
#include "bench/measure/environment.h"
#include "renderer/base/error.h"
#include "renderer/base/names.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <map>
#include <vector>

namespace lightsweep {
namespace {

int report(const std::string& message, int code) {
    fmt::print(stderr, "lightsweep: {}\n", message);
    return code;
}

int main_checked(int argc, char** argv) {
    CLI::App app{"Which shading path, which G-buffer layout: at what cost in time, and what cost in error?",
                 "lightsweep"};
    app.set_version_flag("--version", program_version() + " (" + program_git_commit().value_or("no commit") + ")");
    app.require_subcommand(1);
    app.fallthrough();
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const std::vector<std::pair<std::string, std::function<Command(CLI::App&)>>> table = {
        {"list", add_list},
        {"doctor", add_doctor},
        {"render", add_render},
        {"diff", add_diff},
        {"compare", add_compare},
        {"merge", add_merge},
        {"run", [&](CLI::App& command) { return add_run(command, arguments); }},
    };
    std::map<std::string, Command> commands;
    std::vector<std::string> names;
    for (const auto& [name, add] : table) {
        names.push_back(name);
        commands[name] = add(app);
    }
    if (argc > 1 && argv[1][0] != '-' && !commands.contains(argv[1])) {
        return report(unknown_name("command", argv[1], names), kBadInput);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        return report(fmt::format("{} (lightsweep --help shows the usage)", error.what()), kBadInput);
    }
    return commands.at(app.get_subcommands().front()->get_name())();
}

}  // namespace
}  // namespace lightsweep

int main(int argc, char** argv) {
    using namespace lightsweep;
    try {
        return main_checked(argc, argv);
    } catch (const InputError& error) {
        return report(error.what(), kBadInput);
    } catch (const EnvironmentError& error) {
        return report(error.what(), kRefused);
    } catch (const std::exception& error) {
        return report(fmt::format("failed: {}", error.what()), kCellsFailed);
    }
}
