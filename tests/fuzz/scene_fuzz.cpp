// Scene files, and the lights that they make.
#include "renderer/scene/scene.h"
#include "tests/fuzz/reader.h"

#include <algorithm>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace lightsweep;
    static const InputFile file("input.json");
    return expect_input_errors_alone([&] {
        const Scene scene = load_scene(file.write(data, size));
        make_lights(scene, std::min(scene.lights.default_count, 64), {scene.lights.default_overlap});
    });
}
