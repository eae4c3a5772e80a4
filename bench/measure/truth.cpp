#include "bench/measure/truth.h"

#include "bench/measure/light_hits.h"
#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/gl/context.h"

#include <fmt/format.h>

namespace lightsweep {
namespace {

constexpr size_t kMostLightsOfPlainControl = 256;

Picture draw_control(const CellParams& cell, const Subject& subject, FrameBuffers& buffers, const DrawShapes& shapes,
                     GroupResult& result) {
    const int64_t start = now_ns();
    Arm arm(control_cell(cell, subject.lights.size()), subject, buffers, shapes);
    arm.draw();
    result.frames_s += static_cast<double>(now_ns() - start) * 1e-9;
    return picture_of(arm.hdr_image());
}

CellError picture_errors(const Image& hdr, const std::filesystem::path& maps_folder, Truth& truth, CellResult& cell) {
    const uint64_t hash =
        hash_bytes({reinterpret_cast<const char*>(hdr.rgb.data()), hdr.rgb.size() * sizeof(hdr.rgb[0])});
    const auto known = truth.errors_of_picture.find(hash);
    if (known != truth.errors_of_picture.end() && maps_folder.empty()) return known->second;
    const Picture picture = picture_of(hdr);
    CellError error;
    if (truth.control) error.control = picture_error(*truth.control, picture, HdrFlip::leave_out);
    if (!truth.reference) return error;
    const Picture& reference = truth.reference->picture;
    error.reference = picture_error(reference, picture, HdrFlip::measure);
    if (truth.control) error.packing_share = packing_share(reference.display, truth.control->display, picture.display);
    const FlipMap map = ldr_flip(reference.display, picture.display);
    if (const auto interval = mean_interval(map)) {
        error.flip_mean_low = interval->low;
        error.flip_mean_high = interval->high;
    }
    if (!maps_folder.empty()) {
        try {
            write_flip_map(map, maps_folder / (cell.id + ".png"));
        } catch (const InputError& failure) {  // a full disk must not cost what is measured
            cell.warnings.push_back(std::string("no FLIP map: ") + failure.what());
        }
    }
    truth.errors_of_picture[hash] = error;
    return error;
}

}  // namespace

CellParams control_cell(const CellParams& any_cell_of_group, size_t light_count) {
    const bool plain = light_count <= kMostLightsOfPlainControl;
    CellParams control = any_cell_of_group;
    control.path = plain ? "deferred" : "deferred_clustered";
    control.layout = "float32";
    control.light_lists = plain ? "" : "cpu";
    control.hdr = "rgba32f";
    control.skip = kSkipEverything;
    control.guards = kGuards.front();
    control.sums = kSums.front();
    return control;
}

Truth TruthFinder::find(const CellParams& any_cell_of_group, const Subject& subject, GroupResult& result) {
    Truth truth;
    try {
        truth.control = draw_control(any_cell_of_group, subject, *buffers_, *shapes_, result);
    } catch (const std::exception& error) {
        truth.failures.push_back(std::string("no error against the control arm: ") + error.what());
    }
    try {
        references_.look_at(subject, *buffers_, *shapes_);
        truth.reference = references_.reference(subject);
        truth.light_hits = count_light_hits(references_.surfaces(), subject.lights, subject.scene.scene().camera.eye);
        const auto subpixel_bits = static_cast<int>(gl::Context::current()->limits().subpixel_bits);
        GroupReference& record = result.reference.emplace();
        record.key = truth.reference->key;
        record.from_cache = truth.reference->from_cache;
        record.seconds = truth.reference->seconds;
        record.subpixel_bits = subpixel_bits;
        if (truth.control) {
            const Reference snapped = references_.reference(subject, subpixel_bits);
            record.from_cache = record.from_cache && snapped.from_cache;
            record.seconds += snapped.seconds;
            const auto& surfaces = references_.surfaces();
            record.control_exact = relative_error(truth.reference->picture.hdr, truth.control->hdr, surfaces);
            record.control_snapped = relative_error(snapped.picture.hdr, truth.control->hdr, surfaces);
        }
    } catch (const std::exception& error) {
        truth.failures.push_back(std::string("no error against the reference: ") + error.what());
    }
    return truth;
}

const LayoutError& TruthFinder::layout_error_of(const CellParams& params, const Arm& arm, const Subject& subject) {
    const Scene& scene = subject.scene.scene();
    // By the layout as the user named it: two files may have one key.
    const std::string key =
        fmt::format("{} {}x{} {}", scene.content_hash, subject.width, subject.height, params.layout);
    auto found = layout_errors_.find(key);
    if (found == layout_errors_.end()) {  // entered only when it is known: a failure must not leave an empty one
        const auto decoded = draw_decoded_surface(arm.setup(), subject, *buffers_, *shapes_);
        found = layout_errors_.emplace(key, layout_error(references_.surfaces(), decoded, subject.scene.needs())).first;
    }
    return found->second;
}

CellError TruthFinder::error(const Arm& arm, const Subject& subject, const std::filesystem::path& maps_folder,
                             Truth& truth, CellResult& cell) {
    CellError error = picture_errors(arm.hdr_image(), maps_folder, truth, cell);
    if (!truth.reference) return error;
    if (!arm.setup().layout.targets.empty()) {
        try {
            const LayoutError& layout = layout_error_of(cell.params, arm, subject);
            error.fields = layout.fields;
            error.lost_px = layout.lost_px;
        } catch (const EnvironmentError& failure) {  // no room for the probe's targets: the arm itself can be timed
            cell.warnings.push_back(std::string("no errors of the fields: ") + failure.what());
        }
    }
    return error;
}

}  // namespace lightsweep
