// For compilers without libFuzzer: feeds a target its corpus, and mutations of it from a fixed seed, for a bounded
// time. Usage: fuzz_<reader> CORPUS_FOLDER      A finding ends the program as whatever it is: an exception, a CHECK, a
// signal.
#include "renderer/base/file.h"
#include "renderer/base/random.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace lightsweep {
namespace {

constexpr int kMutationsOfFile = 400;
constexpr auto kMostTime = std::chrono::milliseconds(1500);

// What JSON is made of, and numbers at the ends of ranges.
constexpr const char* kTokens[] = {"0",    "-1",     "1e999", "4294967296", "18446744073709551615",
                                   "-0.0", "1e-320", "null",  "[]",         "{}",
                                   "\"\"", "true",   "\"/\"", ",",          ":",
                                   "\n",   "[[",     "}}",    "\\u0000",    "NaN"};

void feed(const std::string& bytes) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

std::string mutated(std::string bytes, Random& random) {
    const size_t at = random.index(bytes.size() + 1);
    const size_t length = std::min<size_t>(bytes.size() - at, 1 + random.index(random.index(2) == 0 ? 8 : 200));
    switch (random.index(6)) {
        case 0:  // a bit turned over
            if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.index(8)));
            return bytes;
        case 1:
            return bytes.erase(at, length);
        case 2:  // a part twice
            return bytes.insert(at, bytes.substr(at, length));
        case 3:  // a part from elsewhere
            return bytes.replace(at, length, bytes.substr(random.index(bytes.size() + 1), length));
        case 4:  // cut off
            return bytes.substr(0, at);
        default: {  // another value in place of a number or word
            size_t end = at;
            while (end < bytes.size() && bytes[end] != ',' && bytes[end] != '}' && bytes[end] != ']') ++end;
            size_t begin = at;
            while (begin > 0 && bytes[begin - 1] != ':' && bytes[begin - 1] != ',' && bytes[begin - 1] != '[') --begin;
            return bytes.replace(begin, end - begin, kTokens[random.index(std::size(kTokens))]);
        }
    }
}

int replay(const std::filesystem::path& corpus) {
    std::vector<std::string> inputs{""};
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) inputs.push_back(read_file(entry.path()));
    std::ranges::sort(inputs);  // the folder's order is the file system's
    for (const std::string& input : inputs) feed(input);
    const auto end = std::chrono::steady_clock::now() + kMostTime;
    Random random(1);
    size_t mutations = 0;
    for (int round = 0; round < kMutationsOfFile; ++round) {
        for (const std::string& input : inputs) {
            std::string bytes = mutated(input, random);
            while (random.index(2) == 0) bytes = mutated(std::move(bytes), random);
            if (std::chrono::steady_clock::now() >= end) break;
            feed(bytes);
            ++mutations;
        }
    }
    std::printf("%zu files, %zu mutations\n", inputs.size(), mutations);
    return inputs.size() > 1 ? 0 : 1;
}

}  // namespace
}  // namespace lightsweep

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: %s CORPUS_FOLDER\n", argv[0]);
        return 2;
    }
    return lightsweep::replay(argv[1]);
}
