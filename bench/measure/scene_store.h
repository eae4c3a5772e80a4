// Scenes by key: each loaded once per run, and the one on the GPU kept until another is asked for.
#pragma once

#include "renderer/frame/gpu_scene.h"
#include "renderer/scene/scene.h"

#include <map>
#include <memory>
#include <string>

namespace lightsweep {

class SceneStore {
  public:
    /// `seed` replaces that of the scenes' generated lights; 0: as the scenes say.
    explicit SceneStore(int64_t seed = 0) : seed_(seed) {}

    /// Throws InputError.
    const Scene& scene(const std::string& key_or_path);
    /// Uploads the scene; the one uploaded before is freed.
    const GpuScene& gpu_scene(const std::string& key_or_path);

  private:
    int64_t seed_;
    std::map<std::string, std::unique_ptr<Scene>> scenes_;
    std::string uploaded_;
    std::unique_ptr<GpuScene> gpu_scene_;
};

}  // namespace lightsweep
