#include "bench/measure/scene_store.h"

namespace lightsweep {

const Scene& SceneStore::scene(const std::string& key_or_path) {
    auto& slot = scenes_[key_or_path];
    if (!slot) {
        slot = std::make_unique<Scene>(load_scene(key_or_path));
        auto& generator = slot->lights.generator;
        if (seed_ != 0 && generator) generator->seed = static_cast<uint64_t>(seed_);
    }
    return *slot;
}

const GpuScene& SceneStore::gpu_scene(const std::string& key_or_path) {
    const Scene& wanted = scene(key_or_path);
    if (!gpu_scene_ || uploaded_ != key_or_path) {
        gpu_scene_.reset();
        gpu_scene_ = std::make_unique<GpuScene>(wanted, scene_needs(wanted));
        uploaded_ = key_or_path;
    }
    return *gpu_scene_;
}

}  // namespace lightsweep
