// A shared library that the program can start without: opened by name at run time, closed with its owner.
#pragma once

#include <string>

namespace lightsweep::gl {

class Library {
  public:
    /// Opens `name` ("libEGL.so.1") with RTLD_NOW | RTLD_LOCAL. Throws EnvironmentError with the loader's own words,
    /// followed by `cure` ("install libegl1").
    Library(const std::string& name, const std::string& cure);
    ~Library();
    Library(Library&& other) noexcept;
    Library& operator=(Library&& other) noexcept;

    /// The function `symbol`, cast to the pointer type asked for. Throws EnvironmentError when the library lacks it.
    template <typename Function>
    Function function(const char* symbol) const {
        return reinterpret_cast<Function>(address(symbol));
    }

  private:
    void* address(const char* symbol) const;

    std::string name_;
    void* handle_ = nullptr;
};

}  // namespace lightsweep::gl
