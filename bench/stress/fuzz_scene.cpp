#include "bench/stress/fuzz_scene.h"

#include "renderer/base/random.h"
#include "renderer/base/skips.h"
#include "renderer/gbuffer/layout.h"
#include "renderer/paths/paths.h"
#include "renderer/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <string>

namespace lightsweep {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostPx = 96;
constexpr size_t kCellsOfScene = 3;
// What the scene format allows.
constexpr double kLeastLength = 1e-6, kMostLength = 1e9, kMostIntensity = 1e9;

Json vector(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Draws come one after the other in statements of their own, or in braces: there their order is fixed.
class Maker {
  public:
    explicit Maker(uint64_t seed) : random_(seed) {
        unit_ = power(-3.0, 4.0);
        if (chance(0.5)) origin_ = direction() * power(0.0, 6.0);
    }

    Json scene() {
        Json json{{"summary", "a random scene"}};
        const size_t materials = 1 + index(4), shapes = 1 + index(3), instances = 1 + index(8);
        for (size_t i = 0; i < materials; ++i) json["materials"]["m" + std::to_string(i)] = material();
        for (size_t i = 0; i < shapes; ++i) json["shapes"]["s" + std::to_string(i)] = shape();
        for (size_t i = 0; i < instances; ++i) json["instances"].push_back(instance(materials));
        json["camera"] = camera();
        json["lights"] = lights();
        if (chance(0.4)) json["ambient"] = vector(color() * power(-4.0, 2.0));
        if (chance(0.4)) json["background"] = vector(color() * power(-4.0, 4.0));
        return json;
    }

    std::vector<CellParams> cells() {
        CellParams cell;
        cell.width = extent();
        cell.height = extent();
        cell.hdr = chance(0.5) ? "rgba32f" : pick(kHdrFormats);
        cell.skip = skips();
        const std::string layout = chance(0.3) ? "float32" : pick(layout_keys());
        const std::string builder = chance(0.5) ? "cpu" : "compute";
        if (chance(0.2)) cell.sums = kCompensatedSums;
        std::vector<CellParams> cells;
        auto paths = path_keys();
        while (cells.size() < kCellsOfScene && !paths.empty()) {
            const size_t chosen = index(paths.size());
            const PathInfo& path = find_path(paths[chosen]);
            paths.erase(paths.begin() + static_cast<std::ptrdiff_t>(chosen));
            cell.path = path.key;
            cell.layout = path.uses_layout ? layout : "";
            cell.light_lists = path.uses_light_lists ? builder : "";
            cells.push_back(cell);
        }
        return cells;
    }

  private:
    template <class List>
    std::ranges::range_value_t<List> pick(const List& list) {
        return *(std::begin(list) + static_cast<std::ptrdiff_t>(index(std::size(list))));
    }
    double uniform(double low, double high) { return random_.uniform(low, high); }
    size_t index(size_t count) { return random_.index(count); }
    bool chance(double share) { return random_.uniform() < share; }
    /// 10 to a power in between.
    double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }
    glm::dvec3 cube() { return glm::dvec3{uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)}; }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 v = cube();
            if (const double length = glm::length(v); length > 0.1 && length < 1.0) return v / length;
        }
    }
    glm::dvec3 color() {
        glm::dvec3 c{uniform(0.0, 1.0), uniform(0.0, 1.0), uniform(0.0, 1.0)};
        if (chance(0.2)) c[static_cast<int>(index(3))] = 0.0;
        return chance(0.1) ? glm::dvec3(1.0) : c;
    }
    /// Of [0, 1], its ends among them.
    double share() {
        if (chance(0.2)) return 0.0;
        if (chance(0.2)) return 1.0;
        return chance(0.4) ? power(-4.0, 0.0) : uniform(0.0, 1.0);
    }
    static double length(double wanted) { return std::clamp(wanted, kLeastLength, kMostLength); }
    int extent() {
        if (chance(0.1)) return 1;
        return 1 + static_cast<int>(index(chance(0.2) ? kMostPx : 48));
    }

    std::string skips() {
        if (chance(0.6)) return kSkipEverything;
        SkipSet set = SkipSet::none();
        for (const SkipInfo& info : skip_infos()) {
            if (info.skip != Skip::cells && chance(0.5)) set = set.with(info.skip);
        }
        return set.text();
    }

    Json color_texture() {
        const int size = pick(kTextureSizes);
        if (chance(0.5)) {
            return {{"checker",
                     {{"size", size}, {"squares", 2 + 2 * index(8)}, {"colors", {vector(color()), vector(color())}}}}};
        }
        return {{"noise",
                 {{"size", size},
                  {"cells", 1 + index(8)},
                  {"seed", index(1000)},
                  {"colors", {vector(color()), vector(color())}}}}};
    }

    Json material() {
        const std::string model = pick(kShadingModelNames);
        Json json{{"model", model}, {"base_color", vector(color())}};
        if (model != "lambert") json["roughness"] = share();
        if (model == "ggx") json["metallic"] = share();
        if (model == "blinn_phong") json["specular"] = chance(0.2) ? Json("luminance") : vector(color());
        if (chance(0.2)) json["emissive"] = vector(color() * power(-5.0, 5.0));
        if (chance(0.3)) json["double_sided"] = true;
        if (chance(0.15)) json["textures"]["base_color"] = color_texture();
        if (model == "ggx" && chance(0.1)) json["textures"]["metallic_roughness"] = color_texture();
        if (json.contains("emissive") && chance(0.3)) json["textures"]["emissive"] = color_texture();
        if (chance(0.15)) {
            json["textures"]["normal"] = {
                {"bumps", {{"size", pick(kTextureSizes)}, {"count", 1 + index(8)}, {"height", power(-3.0, 0.6)}}}};
            if (chance(0.5)) json["normal_scale"] = uniform(-1.0, 1.0) * power(-1.0, 2.0);
        }
        if (chance(0.1)) {
            json["textures"]["base_color"] = {
                {"holes", {{"size", pick(kTextureSizes)}, {"count", 1 + index(6)}, {"color", vector(color())}}}};
            json["alpha_cutoff"] = share();
        }
        return json;
    }

    // About `size` large; instances take that out again.
    Json shape() {
        const double size = power(-3.0, 3.0);
        sizes_.push_back(size);
        const auto several = [&](size_t low, size_t high) { return low + index(high - low + 1); };
        switch (index(7)) {
            case 0:
                return {{"plane", {{"size", {size, size}}, {"segments", {several(1, 6), several(1, 6)}}}}};
            case 1:
                return {{"quad", {{"size", {size, size}}}}};
            case 2:
                return {{"box", {{"size", {size, size, size}}, {"segments", several(1, 4)}}}};
            case 3:
                return {{"sphere", {{"radius", size}, {"segments", several(3, 32)}, {"rings", several(2, 20)}}}};
            case 4:
                return {{"cylinder", {{"radius", size}, {"height", size}, {"segments", several(3, 24)}}}};
            case 5:
                return {{"cone", {{"radius", size}, {"height", size}, {"segments", several(3, 24)}}}};
            default:
                return {{"torus",
                         {{"radius", size},
                          {"tube", 0.3 * size},
                          {"segments", several(3, 24)},
                          {"sides", several(3, 12)}}}};
        }
    }

    Json instance(size_t materials) {
        const size_t shape = index(sizes_.size());
        const glm::dvec3 place = origin_ + unit_ * 2.0 * cube();
        places_.push_back(place);
        Json json{{"shape", "s" + std::to_string(shape)}, {"material", "m" + std::to_string(index(materials))}};
        json["translate"] = vector(place);
        if (chance(0.8)) json["rotate_deg"] = vector(360.0 * cube());
        const double scale = unit_ * power(-0.7, 0.6) / sizes_[shape];
        glm::dvec3 scales(scale);
        if (chance(0.4)) {
            for (int k = 0; k < 3; ++k) scales[k] *= (chance(0.2) ? -1.0 : 1.0) * power(-0.5, 0.5);
        }
        if (chance(0.1)) scales[static_cast<int>(index(3))] *= power(-6.0, -1.0);  // slivers
        json["scale"] = vector(glm::clamp(glm::abs(scales), 1e-8, 1e6) * glm::sign(scales));
        if (chance(0.1)) {
            json["grid"] = {{"count", {1 + index(3), 1 + index(3), 1 + index(2)}}, {"spacing", vector(unit_ * cube())}};
        }
        return json;
    }

    Json camera() {
        const bool inside = chance(0.25);
        eye_ = origin_ + unit_ * (inside ? power(-3.0, 0.0) : power(0.3, chance(0.9) ? 0.8 : 3.0)) * direction();
        glm::dvec3 target = origin_ + unit_ * 0.5 * cube();
        if (chance(0.2)) target = eye_ + unit_ * direction();
        const glm::dvec3 forward = glm::normalize(target - eye_);
        glm::dvec3 up(0.0, 1.0, 0.0);
        while (chance(0.3) || glm::length(glm::cross(forward, up)) < 0.05) up = direction();
        const double near = length(unit_ * power(-4.0, -0.5));
        return {{"eye", vector(eye_)}, {"target", vector(target)},
                {"up", vector(up)},    {"fov_y_deg", chance(0.7) ? uniform(20.0, 90.0) : uniform(5.0, 150.0)},
                {"near", near},        {"far", std::max(length(unit_ * power(0.8, 5.0)), 2.0 * near)}};
    }

    Json lights() {
        const bool many = chance(0.05);
        const size_t count = many ? 50 + index(250) : chance(0.1) ? 0 : 1 + index(12);
        Json fixed = Json::array();
        for (size_t i = 0; i < count; ++i) fixed.push_back(light(many));
        return {{"fixed", fixed}, {"default_count", count}};
    }

    glm::dvec3 light_place() {
        if (chance(0.1)) return eye_;
        if (chance(0.1)) return pick(places_);  // inside of something
        return origin_ + unit_ * (chance(0.9) ? 3.0 : power(1.0, 4.0)) * cube();
    }

    Json light(bool one_of_many) {
        const double kind = one_of_many ? uniform(0.0, 0.85) : uniform(0.0, 1.0);
        if (kind > 0.85) {
            return {{"kind", "directional"},
                    {"color", vector(color() * power(-3.0, 3.0))},
                    {"direction", vector(direction() * power(-3.0, 3.0))}};
        }
        const double radius = unit_ * (chance(0.6) ? power(0.0, 1.0) : power(-4.0, 4.0));
        const double intensity = std::min(unit_ * unit_ * power(-3.0, 4.0), kMostIntensity);
        Json json{{"kind", kind > 0.55 ? "spot" : "point"},
                  {"color", chance(0.05) ? vector(glm::dvec3(0.0)) : vector(color() * intensity)},
                  {"position", vector(light_place())},
                  {"radius", length(radius)}};
        if (kind <= 0.55) return json;
        json["direction"] = vector(direction() * power(-3.0, 3.0));
        const double outer = chance(0.2) ? 90.0 : uniform(0.5, 90.0);
        json["inner_deg"] = outer * (chance(0.2) ? 0.999 : uniform(0.0, 0.95));
        json["outer_deg"] = outer;
        return json;
    }

    static constexpr int kTextureSizes[] = {1, 2, 7, 16, 64};

    Random random_;
    double unit_ = 1.0;  // about how large the scene is
    glm::dvec3 origin_{0.0}, eye_{0.0};
    std::vector<double> sizes_;       // of the shapes
    std::vector<glm::dvec3> places_;  // of the instances
};

}  // namespace

FuzzCase make_fuzz_case(uint64_t seed) {
    Maker maker(seed);
    FuzzCase result{.seed = seed, .scene = maker.scene(), .cells = {}};
    result.cells = maker.cells();
    return result;
}

}  // namespace lightsweep
