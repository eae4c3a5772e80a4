// Guards against what arithmetic cannot do: dividing by zero, roots and powers of what is negative, lengths beyond the
// range. UNGUARDED (the axis guards=off) takes the plain expression, to show what a guard costs and what it is for.
#ifdef UNGUARDED
#define GUARDED(guarded, plain) (plain)
#else
#define GUARDED(guarded, plain) (guarded)
#endif

// Unit length, and zero for zero, for lengths between 1e-15 and 1e15 (lib/safe_normalize.glsl takes all). One maximum
// more than normalize().
vec3 unit_or_zero(vec3 v) {
    float length_squared = dot(v, v);
    return v * inversesqrt(GUARDED(max(length_squared, 1e-30), length_squared));
}
