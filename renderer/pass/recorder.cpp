#include "renderer/pass/recorder.h"

#include "shaders/shared/slots.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace lightsweep {
namespace {

struct SphereMesh {
    std::vector<glm::vec3> vertices;
    std::vector<uint32_t> indices;
};

// An icosphere whose flat faces touch the unit sphere from outside: every point of the sphere is inside the mesh.
SphereMesh make_enclosing_sphere(int subdivisions) {
    const float t = (1.0F + std::sqrt(5.0F)) / 2.0F;
    SphereMesh mesh{
        {{-1, t, 0},
         {1, t, 0},
         {-1, -t, 0},
         {1, -t, 0},
         {0, -1, t},
         {0, 1, t},
         {0, -1, -t},
         {0, 1, -t},
         {t, 0, -1},
         {t, 0, 1},
         {-t, 0, -1},
         {-t, 0, 1}},
        {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
         3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1}};
    for (auto& v : mesh.vertices) v = glm::normalize(v);
    for (int s = 0; s < subdivisions; ++s) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> midpoints;
        const auto midpoint = [&](uint32_t a, uint32_t b) {
            const auto [found, is_new] =
                midpoints.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh.vertices.size()));
            if (is_new) mesh.vertices.push_back(glm::normalize(mesh.vertices[a] + mesh.vertices[b]));
            return found->second;
        };
        std::vector<uint32_t> finer;
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            const uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
            const uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
            finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
        }
        mesh.indices = std::move(finer);
    }
    float nearest = 1.0F;  // distance of the nearest face's plane from the centre
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.vertices[mesh.indices[i]], b = mesh.vertices[mesh.indices[i + 1]],
                        c = mesh.vertices[mesh.indices[i + 2]];
        nearest = std::min(nearest, glm::dot(glm::normalize(glm::cross(b - a, c - a)), a));
    }
    // A little more than needed, for the rounding of radius times vertex.
    for (auto& v : mesh.vertices) v *= 1.0001F / nearest;
    return mesh;
}

constexpr gl::VertexBinding kSphereBinding{.binding = 0, .stride_bytes = sizeof(glm::vec3)};

}  // namespace

DrawShapes::DrawShapes() : empty_({}, {}, "no attributes") {
    const SphereMesh mesh = make_enclosing_sphere(1);
    sphere_index_count_ = static_cast<uint32_t>(mesh.indices.size());
    sphere_vertices_ = gl::Buffer(std::as_bytes(std::span(mesh.vertices)), "sphere vertices");
    sphere_indices_ = gl::Buffer(std::as_bytes(std::span(mesh.indices)), "sphere indices");
    const gl::VertexAttribute position{shared::kPositionAttribute, 0, 3, 0};
    sphere_array_ = gl::VertexArray(std::span(&kSphereBinding, 1), std::span(&position, 1), "sphere");
    sphere_array_.set_buffer(kSphereBinding, sphere_vertices_);
    sphere_array_.set_indices(sphere_indices_);
}

void DrawShapes::draw_full_screen() const {
    empty_.bind();
    gl::draw_triangles(3);
}

void DrawShapes::bind_sphere() const { sphere_array_.bind(); }

void DrawShapes::draw_sphere() const { gl::draw_indexed({.index_count = sphere_index_count_}); }

void Recorder::use_stage(size_t index) {
    stage_ = index;
    stages_[index].program.use();
    gl::apply(stages_[index].state);
}

template <class Draw>
void Recorder::counted(Draw draw) {
    if (!counting_ || stage_ + 1 != stages_.size()) {
        draw();
        return;
    }
    queries_.emplace_back();
    queries_.back().begin();
    draw();
    queries_.back().end();
}

uint64_t Recorder::samples() const {
    uint64_t sum = 0;
    for (const auto& query : queries_) sum += query.wait_count();
    return sum;
}

void Recorder::draw_visible_meshes() {
    input_.buffers.bind(input_.scene);
    for (const DrawCall& draw : input_.frame.draws) {
        const Batch& batch = input_.scene.batches()[draw.batch];
        gl::apply_faces(batch.double_sided ? gl::Cull::none : gl::Cull::back, batch.mirrored);
        input_.scene.bind_material(batch.material);
        counted([&] {
            gl::draw_indexed({.first_index = batch.first_index,
                              .index_count = batch.index_count,
                              .instance_count = draw.instance_count,
                              .first_instance = draw.first_visible});
        });
    }
}

void Recorder::draw_full_screen() {
    counted([&] { input_.shapes.draw_full_screen(); });
}

void Recorder::draw_light_volume(uint32_t light) {
    stages_[stage_].program.set_uint(shared::kLightIndexUniform, light);
    counted([&] { input_.shapes.draw_sphere(); });
}

void draw_visible_meshes(Recorder& recorder) { recorder.draw_visible_meshes(); }
void draw_full_screen(Recorder& recorder) { recorder.draw_full_screen(); }

}  // namespace lightsweep
