// lightsweep doctor: what this machine is, and what may be believed on it.
#include "bench/cli/commands.h"
#include "bench/cli/costs.h"
#include "bench/cli/device_options.h"
#include "bench/cli/table.h"
#include "bench/measure/environment.h"
#include "bench/measure/known_work.h"
#include "bench/measure/list_probe.h"
#include "bench/measure/rounding_probe.h"
#include "bench/measure/self_test.h"
#include "bench/report/pairs.h"
#include "bench/stats/schedule.h"
#include "renderer/base/error.h"
#include "renderer/gl/draw.h"

#include <fmt/format.h>

#include <memory>

namespace lightsweep {
namespace {

constexpr int kNoiseRounds = 60;
constexpr size_t kNoiseWork = 0;  // one_framebuffer

Json devices_json() {
    Json list = Json::array();
    for (const auto& device : gl::list_devices()) {
        list.push_back({{"key", device.key},
                        {"available", device.available},
                        {"renderer", device.renderer},
                        {"version", device.version},
                        {"software", device.software},
                        {"reason", device.reason}});
    }
    return list;
}

// The same work twice, interleaved: how far apart two equal things look here.
Json noise_json(const std::string& method) {
    KnownWork work;
    work.calibrate(3'000'000);
    const auto timer = make_frame_timer(method);
    std::vector<double> times[2];
    for (size_t round = 0; round < kNoiseRounds; ++round) {
        for (const size_t arm : schedule(2, round)) {
            work.issue(kNoiseWork, 1, *timer);
            gl::finish();
            times[arm].push_back(static_cast<double>(timer->take().total_ns));
        }
    }
    Json json = {{"pairs", kNoiseRounds}, {"ratio", nullptr}, {"low", nullptr}, {"high", nullptr}, {"floor", nullptr}};
    const auto ratio = ratio_of_pairs(times[0], times[1]);
    if (!ratio) return json;
    json["ratio"] = ratio->ratio.estimate;
    if (ratio->ratio.low) json["low"] = *ratio->ratio.low;
    if (ratio->ratio.high) json["high"] = *ratio->ratio.high;
    if (const auto floor = noise_floor(*ratio)) json["floor"] = *floor;
    return json;
}

void print_doctor(const Json& json) {
    const auto& environment = json.at("environment");
    fmt::print("machine   {} ({} cores), {}\n", environment.at("cpu").get<std::string>(),
               environment.at("cores").get<int>(), environment.at("os").get<std::string>());
    fmt::print("renderer  {}\n          {} ({}{})\n\n", environment.at("gl_renderer").get<std::string>(),
               environment.at("gl_version").get<std::string>(), environment.at("gl_provider").get<std::string>(),
               environment.at("software").get<bool>() ? ", software" : "");
    Table devices({"device", "available", "renderer, or why not"});
    for (const auto& d : json.at("devices")) {
        const bool available = d.at("available").get<bool>();
        devices.add({d.at("key").get<std::string>(), available ? "yes" : "no",
                     (available ? d.at("renderer") : d.at("reason")).get<std::string>()});
    }
    fmt::print("{}\n", devices.text());
    Table timers({"timer", "verdict", "overhead per frame", "why"});
    for (const auto& m : json.at("timer").at("methods")) {
        timers.add({m.at("method").get<std::string>(), m.at("accepted").get<bool>() ? "accepted" : "refused",
                    m.at("overhead_ns").is_null() ? "" : time_text(m.at("overhead_ns").get<double>()),
                    m.at("why").get<std::string>()});
    }
    const auto& timer = json.at("timer");
    const bool trusted = timer.at("trusted").get<bool>();
    fmt::print("{}used: {}\n\n", timers.text(),
               trusted
                   ? fmt::format("{} ({})", timer.at("method").get<std::string>(), timer.at("why").get<std::string>())
                   : "none: no method agrees with the clock, or the machine is too busy to tell");
    const auto& noise = json.at("noise");
    if (noise.at("floor").is_null()) {
        fmt::print("noise floor: unknown\n\n");
    } else {
        fmt::print("noise floor: {:.2f} % (the same work twice, {} pairs: ratio {:.4f})\n\n",
                   100 * noise.at("floor").get<double>(), noise.at("pairs").get<int>(),
                   noise.at("ratio").get<double>());
    }
    Table rounding({"format", "write", "ties", "blend", "4000 x 0.1 blended (exact: 400)"});
    const auto text_or_dash = [](const Json& found) { return found.is_null() ? "-" : found.get<std::string>(); };
    for (const auto& p : json.at("rounding")) {
        const Json& sum = p.at("sum_of_4000_tenths");
        rounding.add({p.at("format").get<std::string>(), text_or_dash(p.at("write")), text_or_dash(p.at("ties")),
                      text_or_dash(p.at("blend")),
                      sum.is_null() ? std::string() : fmt::format("{:.6g}", sum.get<double>())});
    }
    fmt::print("{}\n", rounding.text());
    const auto& lists = json.at("light_lists");
    fmt::print("light lists: the faster builder is {} ({})\n\n", lists.at("faster").get<std::string>(),
               lists.at("why").get<std::string>());
    if (json.at("cost_model").is_null()) {
        fmt::print(
            "cost model of path=auto: none yet; `doctor --calibrate` or the first run that asks for it measures "
            "one\n\n");
    } else {
        Table costs({"cost model of path=auto", "light search", "samples", "error of the fit (rms)"});
        for (const auto& [path, cost] : json.at("cost_model").at("paths").items()) {
            costs.add({path, cost.at("lights").get<std::string>(), std::to_string(cost.at("samples").get<int64_t>()),
                       fmt::format("{:.1f} %", 100 * cost.at("fit_error").get<double>())});
        }
        fmt::print("{}\n", costs.text());
    }
    Table limits({"limit", "value"});
    for (const auto& [name, value] : json.at("limits").items()) limits.add({name, value.dump()});
    fmt::print("{}", limits.text());
    for (const auto& workaround : environment.at("workarounds")) {
        fmt::print("\nworkaround: {}\n", workaround.get<std::string>());
    }
}

}  // namespace

Command add_doctor(CLI::App& app) {
    struct Options {
        DeviceOptions device;
        bool json = false, calibrate = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("doctor", "devices, limits, timer self-test, noise floor, rounding and light list probes");
    options->device.add(*command);
    command->add_flag("--json", options->json, "for programs");
    command->add_flag("--calibrate", options->calibrate, "measure the cost model of path=auto anew; a few minutes");
    return [options] {
        Json json;
        json["devices"] = devices_json();
        const auto context = options->device.make_context();
        const Environment environment = read_environment(*context);
        json["environment"] = to_json(environment);
        for (const auto& [name, value] : gl::named_limits(context->limits())) json["limits"][std::string(name)] = value;
        // The table is wanted most where no timer is accepted; the noise is then measured with the clock.
        auto methods = test_timers(all_timers());
        const bool trusted = std::any_of(methods.begin(), methods.end(), [](const auto& m) { return m.accepted; });
        const TimerReport timer = choose_timer(std::move(methods), trusted ? "" : timer_methods().back());
        json["timer"] = to_json(timer);
        json["timer"]["trusted"] = trusted;
        json["noise"] = noise_json(timer.method);
        json["rounding"] = to_json(probe_rounding());
        json["light_lists"] = to_json(probe_light_lists());
        const auto costs = options->calibrate ? measure_costs(environment) : find_cost_model(environment);
        json["cost_model"] = costs ? to_json(*costs) : Json(nullptr);
        if (options->json) {
            fmt::print("{}\n", report_text(json));
        } else {
            print_doctor(json);
        }
        if (!trusted) throw EnvironmentError("no trustworthy timer on this device");
        return kDone;
    };
}

}  // namespace lightsweep
