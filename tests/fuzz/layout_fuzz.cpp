// Layout files, and the GLSL that is made of them.
#include "renderer/gbuffer/layout.h"
#include "renderer/gbuffer/layout_glsl.h"
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace lightsweep;
    static const InputFile file("input.json");
    return expect_input_errors_alone([&] { layout_glsl(load_layout(file.write(data, size))); });
}
