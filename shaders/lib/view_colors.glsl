// Pictures of numbers.

// Turbo-like ramp from blue over green to red for t in [0, 1].
vec3 ramp(float t) { return clamp(1.5 - abs(4.0 * t - vec3(3.0, 2.0, 1.0)), 0.0, 1.0); }

// A colour for each number, far from its neighbours': hue steps of the golden ratio.
vec3 label_color(uint label) {
    float hue = fract(float(label) * 0.61803399 + 0.1);
    return clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0) * 0.75 + 0.2;
}
