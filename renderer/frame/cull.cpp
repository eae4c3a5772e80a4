#include "renderer/frame/cull.h"

#include "renderer/base/check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace lightsweep {
namespace {

constexpr size_t kFewKeys = 256;  // a comparison sort is faster

// Differences in double precision: they are what a far origin would cost bits.
void load_spheres(const SphereArrays& spheres, size_t first, size_t count, const glm::dvec3& eye, SphereChunk& chunk) {
    const double *x = spheres.x.data() + first, *y = spheres.y.data() + first, *z = spheres.z.data() + first;
    for (size_t i = 0; i < count; ++i) {
        chunk.x[i] = static_cast<float>(x[i] - eye.x);
        chunk.y[i] = static_cast<float>(y[i] - eye.y);
        chunk.z[i] = static_cast<float>(z[i] - eye.z);
    }
    std::copy_n(spheres.radius.begin() + static_cast<std::ptrdiff_t>(first), count, chunk.radius.begin());
}

// The keys of a batch's instances that the view may show; `first_sphere` is that of the first of them.
void find_visible(const ViewVolume& view, const Batch& batch, const SphereArrays& spheres, size_t first_sphere,
                  const FrameSetup& setup, std::vector<uint64_t>& keys) {
    const uint32_t keep_all = setup.skips.has(Skip::frustum) ? 0 : 1;
    keys.clear();
    SphereChunk chunk;
    std::array<uint64_t, SphereChunk::kCapacity> kept;
    for (size_t begin = 0; begin < batch.instances.size(); begin += SphereChunk::kCapacity) {
        const size_t count = std::min(batch.instances.size() - begin, SphereChunk::kCapacity);
        load_spheres(spheres, first_sphere + begin, count, setup.camera.eye, chunk);
        view.test(chunk, count);
        size_t end = 0;  // no branch, see draw_key
        for (size_t i = 0; i < count; ++i) {
            kept[end] = draw_key(chunk.distance[i], batch.instances[begin + i]);
            end += chunk.inside[i] | keep_all;
        }
        keys.insert(keys.end(), kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(end));
    }
}

void sort_draws(Frame::Scratch& scratch, std::vector<DrawCall>& draws) {
    sort_draw_keys(scratch.draw_keys, scratch.sorted);
    scratch.draws.clear();
    for (const uint64_t key : scratch.draw_keys) scratch.draws.push_back(draws[index_of_key(key)]);
    draws.swap(scratch.draws);
}

}  // namespace

ViewVolume::ViewVolume(const FrameSetup& setup, float margin)
    : near_(static_cast<float>(setup.camera.near_distance)),
      far_(static_cast<float>(setup.camera.far_distance)),
      margin_(margin) {
    const CameraBasis basis = camera_basis(setup.camera);
    right_ = glm::vec3(basis.right);
    up_ = glm::vec3(basis.up);
    forward_ = glm::vec3(basis.forward);
    const double tan_y = std::tan(glm::radians(setup.camera.fov_y_deg) / 2.0);
    const double tan_x = tan_y * setup.width / setup.height;
    sin_x_ = static_cast<float>(tan_x / std::sqrt(1.0 + tan_x * tan_x));
    cos_x_ = static_cast<float>(1.0 / std::sqrt(1.0 + tan_x * tan_x));
    sin_y_ = static_cast<float>(tan_y / std::sqrt(1.0 + tan_y * tan_y));
    cos_y_ = static_cast<float>(1.0 / std::sqrt(1.0 + tan_y * tan_y));
}

// The planes of two opposite sides differ in the sign of `across` alone. Comparisons ask what is outside: they are
// false for what is no number.
void ViewVolume::test(SphereChunk& spheres, size_t count) const {
    CHECK_THAT(count <= SphereChunk::kCapacity, "{} spheres", count);
    const ViewVolume view = *this;  // whose floats those written below cannot be
    for (size_t i = 0; i < count; ++i) {
        const float x = spheres.x[i], y = spheres.y[i], z = spheres.z[i], radius = spheres.radius[i];
        const float across = std::abs(view.right_.x * x + view.right_.y * y + view.right_.z * z);
        const float above = std::abs(view.up_.x * x + view.up_.y * y + view.up_.z * z);
        const float distance = view.forward_.x * x + view.forward_.y * y + view.forward_.z * z;
        const float reach = radius + view.margin_ * (std::abs(x) + std::abs(y) + std::abs(z) + radius);
        const bool outside = (distance * view.sin_x_ + reach < across * view.cos_x_) |
                             (distance * view.sin_y_ + reach < above * view.cos_y_) | (distance + reach < view.near_) |
                             (distance - reach > view.far_);
        spheres.distance[i] = distance;
        spheres.inside[i] = outside ? 0 : 1;
    }
}

void cull_instances(std::span<const Batch> batches, const SphereArrays& spheres, Frame& frame) {
    const ViewVolume view(frame.setup);
    const bool sorts = frame.setup.skips.has(Skip::sort);
    auto& [draws, instances] = frame.visible;
    Frame::Scratch& scratch = frame.scratch;
    frame.visible.clear();
    scratch.draw_keys.clear();
    size_t first_sphere = 0;
    uint64_t triangles = 0;
    for (uint32_t b = 0; b < batches.size(); ++b) {
        const Batch& batch = batches[b];
        find_visible(view, batch, spheres, first_sphere, frame.setup, scratch.keys);
        first_sphere += batch.instances.size();
        const auto count = static_cast<uint32_t>(scratch.keys.size());
        if (count == 0) continue;
        triangles += uint64_t{count} * batch.index_count / 3;
        if (sorts) {
            sort_draw_keys(scratch.keys, scratch.sorted);
            // The nearest distance of the draw in front of its place in the list.
            scratch.draw_keys.push_back((scratch.keys[0] & ~uint64_t{0xFFFFFFFF}) | draws.size());
        }
        const auto first = static_cast<uint32_t>(instances.size());
        instances.resize(instances.size() + count);
        std::ranges::transform(scratch.keys, instances.begin() + first, index_of_key);
        draws.push_back({b, count, first});
    }
    CHECK(first_sphere == spheres.size());
    if (sorts) sort_draws(scratch, draws);
    frame.work.draws = draws.size();
    frame.work.triangles = triangles;
    frame.work.instances_drawn = instances.size();
    frame.work.instances_culled = spheres.size() - instances.size();
}

// Read as integers, the bits of floats rise with them, and those of negative floats are negative: integers have a
// maximum without a branch, which would be guessed wrong half of the time.
uint64_t draw_key(float distance, uint32_t index) {
    const int32_t bits = std::max(std::bit_cast<int32_t>(distance), 0);
    return uint64_t{static_cast<uint32_t>(bits)} << 32 | index;
}

// By digits of the distances, the lowest first (Knuth, The Art of Computer Programming 3, 5.2.5): each pass keeps the
// order of equal digits, and so the indices of equal distances go on rising.
void sort_draw_keys(std::vector<uint64_t>& keys, std::vector<uint64_t>& scratch) {
    if (keys.size() <= kFewKeys) {
        std::ranges::sort(keys);
        return;
    }
    constexpr unsigned kDigits = 3, kBits = 11;
    constexpr size_t kValues = size_t{1} << kBits;
    const auto digit = [](uint64_t key, unsigned place) { return key >> (32 + place * kBits) & (kValues - 1); };
    std::array<std::array<uint32_t, kValues>, kDigits> places{};  // how often a value occurs, then where it goes next
    for (const uint64_t key : keys) {
        for (unsigned place = 0; place < kDigits; ++place) ++places[place][digit(key, place)];
    }
    scratch.resize(keys.size());
    for (unsigned place = 0; place < kDigits; ++place) {
        auto& next = places[place];
        if (next[digit(keys[0], place)] == keys.size()) continue;  // all the same
        uint32_t sum = 0;
        for (uint32_t& value : next) sum += std::exchange(value, sum);
        for (const uint64_t key : keys) scratch[next[digit(key, place)]++] = key;
        keys.swap(scratch);
    }
}

}  // namespace lightsweep
