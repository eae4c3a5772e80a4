// Which material each pixel shows.
#include "lib/mesh_surface.glsl"
#include "lib/view_colors.glsl"

layout(location = 0) out vec4 value;
layout(location = 1) out vec4 picture;

void main() {
    discard_unseen(in_texcoord);
    value = vec4(vec3(float(material.id)), 1.0);
    picture = vec4(label_color(material.id), 1.0);
}
