#include "bench/stress/fuzz_check.h"
#include "bench/stress/vector_math.h"

#include "renderer/base/error.h"
#include "renderer/paths/paths.h"
#include "renderer/post/post.h"
#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightsweep {
namespace {

constexpr const char* kControl = "float32";
// A surface that rounding may put further off, relative to its distance or in radians, is seen edge-on: no bound on its
// radiance says anything.
constexpr double kEdgeOn = 1e-4;
// Above it a picture's p99 is told as what its layout cannot hold.
constexpr double kPacked = 1e-3;
// The median of a path that samples textures with coordinates of its own: texels may be others, most are not.
constexpr double kResampled = 1e-3;

// Every instance is drawn by itself, in the scene's order or the other way round, its triangles too.
Scene one_by_one(const Scene& scene, bool backwards) {
    Scene result = scene;
    result.meshes.clear();
    for (Instance& instance : result.instances) {
        result.meshes.push_back(scene.meshes[instance.mesh]);
        instance.mesh = static_cast<uint32_t>(result.meshes.size()) - 1;
    }
    if (!backwards) return result;
    std::ranges::reverse(result.instances);
    // Meshes share indices where a shape has several materials.
    std::map<uint32_t, bool> reversed;
    for (const Mesh& mesh : result.meshes) {
        if (reversed[mesh.first_index]) continue;
        reversed[mesh.first_index] = true;
        const auto first = result.indices.begin() + mesh.first_index;
        for (uint32_t low = 0, high = mesh.index_count; low + 3 < high; low += 3) {
            high -= 3;
            std::swap_ranges(first + low, first + low + 3, first + high);
        }
    }
    return result;
}

bool blends(const Path& path) {
    return std::ranges::any_of(path.passes, [](const Pass& pass) {
        return pass.state.blend != gl::Blend::none || std::ranges::any_of(pass.more_stages, [](const Stage& stage) {
                   return stage.state.blend != gl::Blend::none;
               });
    });
}

ReferenceSurface in_double(const DecodedSurface& decoded, ShadingModel model) {
    return {.position = decoded.position,
            .normal = decoded.normal,
            .base_color = decoded.base_color,
            .specular = decoded.specular,
            .emissive = decoded.emissive,
            .roughness = decoded.roughness,
            .metallic = decoded.metallic,
            .model = model,
            .covered = decoded.covered};
}

bool all_finite(const ReferenceSurface& s) {
    return is_finite(s.position) && is_finite(s.normal) && is_finite(s.base_color) && is_finite(s.specular) &&
           is_finite(s.emissive) && std::isfinite(s.roughness) && std::isfinite(s.metallic);
}

std::string place(size_t pixel, int width) {
    return fmt::format("pixel ({}, {})", pixel % static_cast<size_t>(width), pixel / static_cast<size_t>(width));
}

// What a light buffer can hold at most, before its shader cuts it.
constexpr double kLargestBuffered = 64512.0;

}  // namespace

FuzzStage::FuzzStage(Workbench& bench, Scene scene, int width, int height)
    : bench_(&bench),
      scene_(std::make_unique<Scene>(std::move(scene))),
      gpu_scene_(std::make_unique<GpuScene>(*scene_, scene_needs(*scene_))),
      subject_{*gpu_scene_,
               make_lights(*scene_, scene_->lights.default_count, {scene_->lights.default_overlap}),
               width,
               height,
               {}},
      lights_(lights_in_float(subject_.lights, scene_->camera.eye)) {}

CellCheck FuzzStage::check(const CellParams& cell, const PlantedText& planted) {
    const auto ended = [](StressVerdict verdict, const std::exception& error) {
        return CellCheck{.verdict = verdict, .reason = error.what(), .limits = {}};
    };
    try {
        return check_cell(cell, planted);
    } catch (const InputError& error) {
        return ended(StressVerdict::skipped, error);
    } catch (const EnvironmentError& error) {
        return ended(StressVerdict::skipped, error);
    } catch (const std::exception& error) {
        return ended(StressVerdict::fail, error);
    }
}

CellCheck FuzzStage::check_cell(const CellParams& cell, const PlantedText& planted) {
    const Drawn drawn = draw(cell, planted);
    const std::string layout = cell.layout.empty() ? kControl : cell.layout;
    const bool rebuilds = cell.path == "visibility", buffers_light = cell.path == "light_prepass";
    const Expected& truth = rebuilds ? rebuilt() : buffers_light ? of_light_prepass(layout) : of_layout(layout);

    CellCheck result;
    const auto fail = [&](std::string why) {
        result.verdict = StressVerdict::fail;
        result.reason = std::move(why);
        return result;
    };
    if (!truth.fault.empty()) return fail(truth.fault);
    const HdrRounding hdr = hdr_rounding(cell.hdr);
    const double darkest = hdr.step / kPacked;  // where a step of the format is not yet an error that counts
    std::vector<bool> may_saturate;
    if (buffers_light && cell.hdr != "rgba32f") may_saturate = overflowing(truth.surfaces, kLargestBuffered);
    const bool resamples = rebuilds && gpu_scene_->needs().textures();
    const std::vector<bool> none(truth.judged.size(), false);
    const PictureFaults faults =
        find_faults(drawn.picture, truth.exact, resamples ? none : truth.judged, may_saturate, hdr, drawn.roundings);
    if (faults.non_finite > 0)
        return fail(fmt::format("{} pixels are not finite; {}", faults.non_finite, faults.worst));
    if (faults.wrong > 0) {
        return fail(fmt::format("{} of {} pixels are wrong; {}", faults.wrong, faults.judged, faults.worst));
    }
    if (resamples) {
        const double median = relative_error_quantile(drawn.picture, truth.exact.radiance, truth.judged, darkest, 0.5);
        const double rounded = drawn.roundings * hdr.relative;
        if (median > kResampled + rounded) return fail(fmt::format("the median relative error is {:.3g}", median));
    }
    if (faults.saturated > 0) {
        result.limits["hdr=" + cell.hdr] = fmt::format("{} pixels of up to {:.3g}, where it ends at {:.5g}",
                                                       faults.saturated, faults.largest_exact, hdr.largest);
    }
    if (layout != kControl) {
        const auto exact = shade_reference(*scene_, seen(load_layout(layout)).surfaces, subject_.width, subject_.height,
                                           scene_->camera, subject_.lights);
        const double p99 = relative_error_quantile(drawn.picture, exact, truth.judged, darkest, 0.99);
        if (p99 > kPacked) result.limits["layout=" + layout] = fmt::format("p99 of the relative error {:.3g}", p99);
    }
    if (!result.limits.empty()) result.verdict = StressVerdict::limit;
    return result;
}

FuzzStage::Drawn FuzzStage::draw(const CellParams& cell, const PlantedText& planted) {
    auto arm = std::make_unique<Arm>(cell, subject_, bench_->buffers, bench_->shapes);
    Path path = find_path(cell.path).build(arm->setup());
    Drawn drawn;
    // Sums in registers are stored once, in buffers for lights once more, blended ones with every light.
    drawn.roundings = cell.path == "light_prepass" ? 3 : 1;
    if (blends(path)) drawn.roundings += 1 + static_cast<int>(subject_.lights.size());
    if (!planted.empty()) {
        for (Pass& pass : path.passes) {
            pass.shader.replaced = planted;
            for (Stage& stage : pass.more_stages) stage.shader.replaced = planted;
        }
        post_tone_map.append(path);
        arm = std::make_unique<Arm>(std::move(path), arm->setup(), subject_, bench_->buffers, bench_->shapes);
    }
    arm->draw();
    drawn.picture = arm->hdr_image();
    return drawn;
}

const FuzzStage::Seen& FuzzStage::seen(const Layout& layout) {
    const std::pair key(layout.depth, layout.convention);
    if (const auto known = seen_.find(key); known != seen_.end()) return known->second;
    Seen result;
    const auto look = [&](const Scene& scene) {
        const GpuScene gpu_scene(scene, gpu_scene_->needs());
        const Subject subject{gpu_scene, {}, subject_.width, subject_.height, {}};
        return draw_visibility(subject, bench_->buffers, bench_->shapes, layout, SkipSet::all().without(Skip::sort));
    };
    const Scene forwards = one_by_one(*scene_, false), backwards = one_by_one(*scene_, true);
    result.visible = look(forwards);
    const Visibility other = look(backwards);
    const auto count = static_cast<uint32_t>(scene_->instances.size());
    for (size_t i = 0; i < other.triangles.size(); ++i) {
        VisibleTriangle mine = result.visible.triangles[i], its = other.triangles[i];
        if (its.instance != kNoSurface) {
            its.instance = count - 1 - its.instance;
            const Mesh& mesh = scene_->meshes[scene_->instances[its.instance].mesh];
            its.triangle = mesh.index_count / 3 - 1 - its.triangle;
        }
        result.torn.push_back(mine.instance != its.instance ||
                              (mine.instance != kNoSurface && mine.triangle != its.triangle));
    }
    result.surfaces = reference_surfaces(*scene_, scene_->camera, result.visible);
    return seen_[key] = std::move(result);
}

const FuzzStage::Expected& FuzzStage::of_layout(const std::string& key) {
    if (const auto known = expected_.find(key); known != expected_.end()) return known->second;
    const PathSetup setup{.needs = gpu_scene_->needs(),
                          .layout = drop_unneeded(load_layout(key), gpu_scene_->needs()),
                          .hdr = gl::Format::RGBA32F};
    const Seen& truth = seen(setup.layout);
    const auto decoded = draw_decoded_surface(setup, subject_, bench_->buffers, bench_->shapes);
    std::vector<ReferenceSurface> surfaces;
    for (size_t i = 0; i < decoded.size(); ++i) surfaces.push_back(in_double(decoded[i], truth.surfaces[i].model));
    auto steps = shading_steps(surfaces);
    Expected result = expected(std::move(surfaces), std::move(steps), truth.torn);
    result.fault = surface_fault(truth, decoded, key == kControl);
    return expected_[key] = std::move(result);
}

// Lights read from the layout what they need, the material is the mesh's own.
const FuzzStage::Expected& FuzzStage::of_light_prepass(const std::string& key) {
    const std::string own_key = "light_prepass " + key;
    if (const auto known = expected_.find(own_key); known != expected_.end()) return known->second;
    const Expected& packed = of_layout(key);
    const Seen& truth = seen(load_layout(key));
    std::vector<ReferenceSurface> surfaces = packed.surfaces;
    for (size_t i = 0; i < surfaces.size(); ++i) {
        const ReferenceSurface& exact = truth.surfaces[i];
        surfaces[i].base_color = exact.base_color;
        surfaces[i].specular = exact.specular;
        surfaces[i].emissive = exact.emissive;
        surfaces[i].metallic = exact.metallic;
    }
    auto steps = shading_steps(surfaces);
    Expected result = expected(std::move(surfaces), std::move(steps), truth.torn);
    result.fault = packed.fault;
    return expected_[own_key] = std::move(result);
}

const FuzzStage::Expected& FuzzStage::rebuilt() {
    const std::string key = "rebuilt";
    if (const auto known = expected_.find(key); known != expected_.end()) return known->second;
    const Seen& truth = seen(Layout{});
    auto steps = rebuilding_steps(*scene_, scene_->camera, truth.visible, truth.surfaces);
    return expected_[key] = expected(truth.surfaces, std::move(steps), truth.torn);
}

FuzzStage::Expected FuzzStage::expected(std::vector<ReferenceSurface> surfaces, std::vector<SurfaceStep> steps,
                                        const std::vector<bool>& torn) const {
    Expected result;
    for (size_t i = 0; i < surfaces.size(); ++i) {
        const bool known = !surfaces[i].covered || (all_finite(surfaces[i]) &&
                                                    steps[i].position <= kEdgeOn * glm::length(surfaces[i].position) &&
                                                    steps[i].normal <= kEdgeOn);
        if (!known) surfaces[i].covered = false;  // what is not finite is not to be shaded
        result.judged.push_back(known && !torn[i]);
    }
    result.exact = bounded_radiance(*scene_, surfaces, steps, subject_.width, subject_.height, lights_);
    result.surfaces = std::move(surfaces);
    return result;
}

// The first pixel where shading reads what it must not.
std::string FuzzStage::surface_fault(const Seen& truth, const std::vector<DecodedSurface>& decoded,
                                     bool is_control) const {
    std::vector<SurfaceStep> steps;
    if (is_control) steps = interpolation_steps(*scene_, scene_->camera, truth.visible, truth.surfaces);
    for (size_t i = 0; i < decoded.size(); ++i) {
        if (truth.torn[i]) continue;
        const ReferenceSurface &right = truth.surfaces[i], read = in_double(decoded[i], right.model);
        const std::string at = place(i, subject_.width);
        if (read.covered != right.covered) {
            return fmt::format("the G-buffer at {} is {}covered", at, read.covered ? "" : "not ");
        }
        if (!read.covered) continue;
        if (!all_finite(read)) return fmt::format("the G-buffer at {} is not finite", at);
        if (!is_control) continue;
        const double moved = glm::length(read.position - right.position),
                     turned = glm::length(read.normal - right.normal);
        if (moved > kExplained * steps[i].position) {
            return fmt::format("the position at {} is off by {:.3g}, {:.3g} times its bound", at, moved,
                               moved / (kExplained * steps[i].position));
        }
        if (turned > kExplained * steps[i].normal) {
            return fmt::format("the normal at {} is off by {:.3g}, {:.3g} times its bound", at, turned,
                               turned / (kExplained * steps[i].normal));
        }
        if (largest(read.base_color - right.base_color) > kRoundings) {
            return fmt::format("the base colour at {} is off by {:.3g}", at,
                               largest(read.base_color - right.base_color));
        }
    }
    return {};
}

// Pixels where a light buffer passes `most`: what surfaces show whose material lets all of one lobe through.
std::vector<bool> FuzzStage::overflowing(const std::vector<ReferenceSurface>& surfaces, double most) const {
    Scene dark = *scene_;
    dark.ambient = glm::dvec3(0.0);
    dark.background = glm::dvec3(0.0);
    dark.camera.eye = glm::dvec3(0.0);
    std::vector<bool> result(surfaces.size(), false);
    for (const bool diffuse : {true, false}) {
        std::vector<ReferenceSurface> white = surfaces;
        for (ReferenceSurface& s : white) {
            s.base_color = s.specular = glm::dvec3(1.0);
            s.emissive = glm::dvec3(0.0);
            s.metallic = 1.0;
            if (diffuse) s.model = ShadingModel::lambert;
        }
        const auto sums = shade_reference(dark, white, subject_.width, subject_.height, dark.camera, lights_);
        for (size_t i = 0; i < sums.size(); ++i) {
            result[i] = result[i] || (diffuse ? std::numbers::pi : 1.0) * largest(sums[i]) > 0.9 * most;
        }
    }
    return result;
}

}  // namespace lightsweep
