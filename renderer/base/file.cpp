#include "renderer/base/file.h"

#include "renderer/base/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace lightsweep {
namespace {

std::string environment(const char* variable) {
    const char* value = std::getenv(variable);
    return value == nullptr ? "" : value;
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
    std::error_code ignored;  // opening it says what is wrong
    if (std::filesystem::is_directory(path, ignored)) throw InputError(path.string(), "is a folder, not a file");
    std::ifstream in(path, std::ios::binary);
    if (!in) throw InputError(path.string(), std::string("cannot be read: ") + std::strerror(errno));
    std::ostringstream text;
    text << in.rdbuf();
    return std::move(text).str();
}

void write_file_atomically(const std::filesystem::path& path, std::string_view content) {
    const std::string temporary = path.string() + ".part";
    const auto fail = [&](const char* what) {
        const int code = errno;
        ::unlink(temporary.c_str());
        throw InputError(path.string(), std::string(what) + ": " + std::strerror(code));
    };
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd < 0) fail("cannot be written");
    while (!content.empty()) {
        const ssize_t n = ::write(fd, content.data(), content.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            ::close(fd);
            fail("cannot be written");
        }
        content.remove_prefix(static_cast<size_t>(n));
    }
    const bool synced = ::fsync(fd) == 0;
    if (::close(fd) != 0 || !synced) fail("cannot be flushed to disk");
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail("cannot be put in place");
}

std::filesystem::path cache_folder() {
    if (const auto own = environment("LIGHTSWEEP_CACHE"); !own.empty()) return own;
    // The XDG base directory specification: relative paths are to be ignored.
    if (const std::filesystem::path cache = environment("XDG_CACHE_HOME"); cache.is_absolute()) {
        return cache / "lightsweep";
    }
    if (const std::filesystem::path home = environment("HOME"); !home.empty()) return home / ".cache" / "lightsweep";
    return {};
}

}  // namespace lightsweep
