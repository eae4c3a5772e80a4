// The file of a layout: what load_layout() reads (docs/layouts.md).
#pragma once

#include "renderer/gbuffer/layout.h"

#include <string>

namespace lightsweep {

/// Text that load_layout() reads back as the same layout, but for its key, which is the file's name.
std::string layout_json(const Layout& layout);

}  // namespace lightsweep
