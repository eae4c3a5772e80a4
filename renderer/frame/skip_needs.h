// Which skips can find something to leave out in a scene: decided by what the scene needs alone, for every camera,
// light count and path.
#pragma once

#include "renderer/base/skips.h"
#include "renderer/frame/needs.h"

#include <string>

namespace lightsweep {

struct SkipUse {
    bool may_help = true;
    std::string why;  ///< a few words: what there is to leave out, or why there is nothing
};

/// Where only a frame, a path or a sweep can tell, the skip may help.
SkipUse skip_use(Skip skip, const SceneNeeds& needs);

}  // namespace lightsweep
