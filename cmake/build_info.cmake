# Writes generated/build_info.h at every build, and touches it only when something changed. Run by the target build_info.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=40 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(WRITE ${OUTPUT}.new "// What this build is made of. Generated.
#pragma once

namespace lightsweep {
inline constexpr const char* kBuildVersion = \"${VERSION}\";
inline constexpr const char* kBuildGitCommit = \"${commit}\";  // empty outside a checkout
inline constexpr const char* kBuildType = \"${BUILD_TYPE}\";
inline constexpr const char* kBuildCompiler = \"${COMPILER}\";
}  // namespace lightsweep
")
execute_process(COMMAND ${CMAKE_COMMAND} -E copy_if_different ${OUTPUT}.new ${OUTPUT})
