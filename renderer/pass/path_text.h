// A path as text: all that decides what a frame of it asks of the device, but for the frame's own data. Equal texts are
// the same work.
#pragma once

#include "renderer/pass/path.h"

#include <string>

namespace lightsweep {

std::string path_text(const Path& path, const PathSetup& setup, int width, int height);

}  // namespace lightsweep
