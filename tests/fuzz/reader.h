// What the fuzz targets share. A target is tests/fuzz/<reader>_fuzz.cpp: any bytes as a file for one of the program's
// readers, which may refuse them with an InputError of one line, and nothing else. With Clang's libFuzzer
// (scripts/fuzz.sh) bytes are searched for that reach new code; replay_main.cpp feeds the corpus and mutations of it.
#pragma once

#include "renderer/base/check.h"
#include "renderer/base/error.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace lightsweep {

/// A file that is gone with the process, written anew for each input.
class InputFile {
  public:
    explicit InputFile(const std::string& name) {
        std::string folder = (std::filesystem::temp_directory_path() / "lightsweep_fuzz_XXXXXX").string();
        if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
        folder_ = folder;
        path_ = folder_ / name;
    }
    ~InputFile() { std::filesystem::remove_all(folder_); }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    std::string write(const uint8_t* data, size_t size) const {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
        return path_.string();
    }

  private:
    std::filesystem::path folder_, path_;
};

/// Anything but an InputError is a finding, and so is one of several lines.
template <class Read>
int expect_input_errors_alone(Read read) {
    try {
        read();
    } catch (const InputError& error) {
        CHECK_THAT(std::string_view(error.what()).find('\n') == std::string_view::npos, "{}", error.what());
    }
    return 0;
}

}  // namespace lightsweep
