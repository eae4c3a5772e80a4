#include "renderer/post/post.h"

namespace lightsweep {
namespace {
constexpr const PostInfo* kPostEffects[] = {&post_tone_map};
}

std::span<const PostInfo* const> all_post_effects() { return kPostEffects; }

}  // namespace lightsweep
