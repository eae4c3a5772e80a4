// lightsweep diff: how far apart two images are.
#include "bench/cli/commands.h"
#include "bench/cli/table.h"
#include "bench/metrics/flip.h"
#include "bench/metrics/image_error.h"
#include "renderer/image/image.h"

#include <fmt/format.h>

#include <memory>

namespace lightsweep {

Command add_diff(CLI::App& app) {
    struct Options {
        std::string reference, test, map;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("diff", "the error metrics of any two PNG (display values) or EXR (linear) images");
    command->add_option("reference", options->reference, "PNG or EXR")->required();
    command->add_option("test", options->test, "PNG or EXR of the same size")->required();
    command->add_flag("--json", options->json, "for programs");
    command->add_option("-o,--output", options->map, "write the FLIP map, in magma's colours (PNG)");
    return [options] {
        const ImagePair pair = image_pair(read_image(options->reference), read_image(options->test));
        const ImageError error = measure_error(pair);
        if (!options->map.empty()) write_image(flip_picture(flip(pair)), options->map);
        const auto json = to_json(error);
        if (options->json) {
            fmt::print("{}\n", json.dump(2));
            return kDone;
        }
        Table table({"metric", "value"});
        for (const auto& [name, value] : json.items()) {
            table.add({name, value.is_number_float() ? fmt::format("{:.6g}", value.get<double>()) : value.dump()});
        }
        fmt::print("{}", table.text());
        return kDone;
    };
}

}  // namespace lightsweep
