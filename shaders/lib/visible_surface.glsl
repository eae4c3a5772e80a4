// The surface that a pixel shows, rebuilt from the triangle that is visible there (Burns and Hunt 2013, "The Visibility
// Buffer"): its vertices are fetched and transformed as the vertex shader does, and interpolated where the pixel's ray
// meets it.
#include "lib/instance.glsl"
#define MATERIAL_GRADIENTS
#include "lib/material.glsl"

layout(binding = kInstanceMeshUnit) uniform usamplerBuffer instance_mesh_texels;
layout(binding = kVertexUnit) uniform samplerBuffer vertex_texels;
layout(binding = kIndexUnit) uniform usamplerBuffer index_texels;

// What an instance draws.
struct InstanceMesh {
    int first_index;
    uint material;
    bool mirrored;  // the transform turns triangles inside out
};

InstanceMesh instance_mesh_at(uint instance) {
    uvec2 packed_mesh = texelFetch(instance_mesh_texels, int(instance)).xy;
    return InstanceMesh(int(packed_mesh.x), packed_mesh.y >> 1, (packed_mesh.y & 1u) != 0u);
}

struct MeshVertex {
    vec3 position;
    vec3 normal;
    vec4 tangent;
    vec2 uv;
};

MeshVertex vertex_at(int index) {
    int first = int(texelFetch(index_texels, index).x) * 3;
    vec4 a = texelFetch(vertex_texels, first), b = texelFetch(vertex_texels, first + 1),
         c = texelFetch(vertex_texels, first + 2);
    return MeshVertex(a.xyz, vec3(a.w, b.xy), vec4(b.zw, c.xy), c.zw);
}

// Where a ray d from the eye meets the plane of a triangle, the weights of the vertices 1 and 2 and the distance are
// dot(d, weight1), dot(d, weight2) and `distance`, each over dot(d, normal) (Cramer's rule). Nothing is divided by a
// vertex's distance: vertices may lie behind the eye.
struct TrianglePlane {
    vec3 weight1, weight2, normal;
    float distance;
};

TrianglePlane triangle_plane(vec3 corner, vec3 edge1, vec3 edge2) {
    vec3 normal = cross(edge1, edge2);
    return TrianglePlane(cross(edge2, corner), cross(corner, edge1), normal, dot(normal, corner));
}

vec2 weights(TrianglePlane plane, vec3 ray) { return vec2(dot(ray, plane.weight1), dot(ray, plane.weight2)); }

// How the weights change from the pixel at `ray` to the next one, whose ray is `step` further:
// (w + dw) / (n + dn) - w / n, without the difference.
vec2 weight_step(TrianglePlane plane, vec3 ray, vec3 step) {
    float n = dot(ray, plane.normal), dn = dot(step, plane.normal);
    return (weights(plane, step) - weights(plane, ray) * (dn / n)) / (n + dn);
}

// A rasteriser takes differences within quads of 2x2 pixels that begin at even ones.
mat2 quad_weight_steps(TrianglePlane plane, vec2 frag_coord) {
    vec3 ray = pixel_ray(2.0 * floor(0.5 * frag_coord) + 0.5);
    return mat2(weight_step(plane, ray, frame.pixel_to_ndc_x * frame.ray_right),
                weight_step(plane, ray, frame.pixel_to_ndc_y * frame.ray_up));
}

const float kOutside = 4.0;  // how far, as weights

Surface visible_surface(vec2 frag_coord, uint instance, uint triangle, InstanceMesh mesh) {
    InstanceData placed = instance_at(instance);
    int index = mesh.first_index + 3 * int(triangle);
    MeshVertex v0 = vertex_at(index), v1 = vertex_at(index + 1), v2 = vertex_at(index + 2);
    vec3 corner = to_world(placed, v0.position) + instance_origin(placed);
    // Of differences within the mesh: they keep their digits however far away the triangle is.
    vec3 edge1 = to_world(placed, v1.position - v0.position), edge2 = to_world(placed, v2.position - v0.position);
    TrianglePlane plane = triangle_plane(corner, edge1, edge2);

    vec3 ray = pixel_ray(frag_coord);
    float facing = dot(ray, plane.normal);
    // The pixel's centre is inside, but for a rasteriser's rounding of window positions, which may be wider than a
    // sliver. Seen edge-on, our own rounding would put it anywhere.
    vec2 w = clamp(weights(plane, ray) / facing, -kOutside, 1.0 + kOutside);
    float z0 = dot(corner, frame.ray_forward);
    float z1 = z0 + dot(edge1, frame.ray_forward), z2 = z0 + dot(edge2, frame.ray_forward);
    float low = min(z0, min(z1, z2)), high = max(z0, max(z1, z2)), outside = kOutside * (high - low);
    float z = clamp(plane.distance / facing, max(low - outside, 1e-20), high + outside);

    vec2 uv1 = v1.uv - v0.uv, uv2 = v2.uv - v0.uv;
    uv_per_pixel = mat2(uv1, uv2) * quad_weight_steps(plane, frag_coord);
    vec2 uv = v0.uv + w.x * uv1 + w.y * uv2;
    vec3 normal0 = world_normal(placed, v0.normal);
    vec3 normal = normal0 + w.x * (world_normal(placed, v1.normal) - normal0) +
                  w.y * (world_normal(placed, v2.normal) - normal0);
    vec4 tangent = vec4(0.0);
#ifdef HAS_NORMAL_TEXTURE
    vec4 tangent0 = world_tangent(placed, v0.tangent);
    tangent = tangent0 + w.x * (world_tangent(placed, v1.tangent) - tangent0) +
              w.y * (world_tangent(placed, v2.tangent) - tangent0);
#endif
    triangle_normal = facing < 0.0 ? plane.normal : -plane.normal;
    // Counter-clockwise triangles face the eye; a mirrored instance's are clockwise.
    return evaluate_material(z * ray, normal, tangent, uv, (facing < 0.0) != mesh.mirrored);
}
