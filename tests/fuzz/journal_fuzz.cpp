// Journals, and the report that is assembled of one.
#include "bench/report/assemble.h"
#include "bench/report/merge.h"
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace lightsweep;
    static const InputFile file("input.jsonl");
    return expect_input_errors_alone([&] {
        const std::string path = file.write(data, size);
        const NamedJournal journal{path, read_journal(path)};
        assemble_report(merge_journals({&journal, 1}));
    });
}
