// Shader programs. A shader that does not compile or link aborts the cell with the log, file and line.
#pragma once

#include "renderer/gl/handle.h"

#include <map>
#include <string>
#include <vector>

namespace lightsweep::gl {

namespace detail {
void delete_program(unsigned id);
}

struct ProgramDesc {
    std::string vertex{}, fragment{};                ///< file names below shaders/; or
    std::string compute{};                           ///< this one alone
    std::vector<std::string> defines{};              ///< "NAME" or "NAME value"
    std::map<std::string, std::string> generated{};  ///< text for `#include "generated/..."`
};

class Program {
  public:
    Program() = default;
    /// Throws std::runtime_error with the driver's log mapped to our files and lines.
    explicit Program(const ProgramDesc& desc);
    void use() const;
    /// `layout(location = ...) uniform` of this program.
    void set_uint(int location, unsigned value) const;
    void set_float(int location, float value) const;
    unsigned id() const { return handle_.id(); }

  private:
    Handle<detail::delete_program> handle_;
};

}  // namespace lightsweep::gl
