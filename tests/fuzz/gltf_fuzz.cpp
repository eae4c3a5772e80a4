// glTF files, with their buffers and images inside: text or binary, as their first bytes say.
#include "renderer/scene/scene.h"
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace lightsweep;
    static const InputFile file("input.gltf");
    return expect_input_errors_alone([&] { load_scene(file.write(data, size)); });
}
