// Scenes that cases build: plain data, no files, no GL.
#pragma once

#include "renderer/scene/geometry.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/shapes.h"

#include <string>

namespace lightsweep {

/// Appends an instance of `geometry` with `material`, which becomes the scene's next one.
void add_instance(Scene& scene, const Geometry& geometry, const Material& material,
                  const glm::dmat4& transform = glm::dmat4(1.0));

/// Another instance of the scene's mesh `mesh`.
void add_instance(Scene& scene, uint32_t mesh, const glm::dmat4& transform);

/// A plane `size` units wide at z = 0 that faces +z, seen from `distance` straight above its middle, filling the view
/// with fov_y 60 degrees where size >= 1.2 distance (and the picture is square).
Scene facing_plane(const Material& material, double size, double distance);

/// A sphere of radius 1 at the origin, finely tessellated, seen from (0, 0, 3).
Scene sphere_scene(const Material& material);

Light point_light(const glm::dvec3& position, double radius, const glm::dvec3& color);
Light spot_light(const glm::dvec3& position, const glm::dvec3& direction, double radius, double outer_deg,
                 const glm::dvec3& color);
Light sun(const glm::dvec3& direction, const glm::dvec3& color);

/// Says which kinds of light the scene's shaders are to know, by writing one of each into its rig: draws with lights of
/// these kinds may follow. Lights that reach nothing count.
void declare_light_kinds(Scene& scene, bool points, bool spots, bool directional);

}  // namespace lightsweep
