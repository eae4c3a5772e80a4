// Depth prepass: nothing but the alpha mask.
#include "lib/material.glsl"

layout(location = 0) in vec2 in_texcoord;

void main() { apply_alpha_mask(in_texcoord); }
