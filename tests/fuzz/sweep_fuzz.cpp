// Sweep files, and the cells that they stand for.
#include "bench/plan/sweep.h"
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace lightsweep;
    static const Catalog catalog = shipped_catalog(
        {{"forward"}, {"forward_clustered", false, true}, {"deferred", true}, {"deferred_tiled", true, true}});
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    return expect_input_errors_alone([&] {
        for (const CellParams& cell : sweep_cells(parse_sweep(text, "input.json", catalog), {}, catalog)) {
            CHECK_THAT(parse_cell(cell.name()) == cell, "{}", cell.name());
        }
    });
}
