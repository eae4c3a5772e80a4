// Depth prepass: nothing but what is discarded.
#include "lib/material.glsl"

layout(location = 0) in vec2 in_texcoord;

void main() { discard_unseen(in_texcoord); }
