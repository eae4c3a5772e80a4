// One value everywhere: for probes of what a target's format makes of it.
layout(location = 0) uniform float value;
layout(location = 0) out vec4 color;

void main() { color = vec4(value); }
