// Reports, and what `lightsweep compare` says of one and itself.
#include "bench/report/compare.h"
#include "bench/report/report_file.h"
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace lightsweep;
    static const InputFile file("input.json");
    return expect_input_errors_alone([&] {
        const Report report = read_report(file.write(data, size));
        comparison_text(compare_reports(report, report, 5.0));
    });
}
