#include "renderer/pass/recorder.h"

#include "renderer/base/check.h"
#include "renderer/pass/volume_meshes.h"
#include "shaders/shared/slots.h"

#include <set>

namespace lightsweep {
namespace {

constexpr gl::VertexBinding kVolumeBinding{.binding = 0, .stride_bytes = sizeof(glm::vec3)};

// 1 to 255; the stencil is 0 where nothing is drawn.
uint8_t material_number(uint32_t material) { return static_cast<uint8_t>(material % 255 + 1); }

}  // namespace

DrawShapes::DrawShapes() : empty_({}, {}, "no attributes") {
    VolumeMesh mesh = make_enclosing_sphere();
    const VolumeMesh cone = make_enclosing_cone();
    sphere_.index_count = static_cast<uint32_t>(mesh.indices.size());
    cone_ = {.first_index = sphere_.index_count, .index_count = static_cast<uint32_t>(cone.indices.size())};
    const auto first_vertex = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), cone.vertices.begin(), cone.vertices.end());
    for (const uint32_t index : cone.indices) mesh.indices.push_back(first_vertex + index);

    volume_vertices_ = gl::Buffer(std::as_bytes(std::span(mesh.vertices)), "light volume vertices");
    volume_indices_ = gl::Buffer(std::as_bytes(std::span(mesh.indices)), "light volume indices");
    const gl::VertexAttribute position{shared::kPositionAttribute, 0, 3, 0};
    volumes_ = gl::VertexArray(std::span(&kVolumeBinding, 1), std::span(&position, 1), "light volumes");
    volumes_.set_buffer(kVolumeBinding, volume_vertices_);
    volumes_.set_indices(volume_indices_);
}

void DrawShapes::bind_full_screen() const { empty_.bind(); }

void DrawShapes::draw_full_screen() const { gl::draw_triangles(3); }

void DrawShapes::bind_volumes() const { volumes_.bind(); }

std::vector<shared::LightBounds> Recorder::light_bounds() const {
    std::vector<shared::LightBounds> bounds;
    lightsweep::light_bounds(input_.frame, position_error_, bounds);
    return bounds;
}

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
    if (queries_.size() == kMostQueries) {
        counted_ = samples();
        queries_.clear();
    }
    queries_.emplace_back();
    queries_.back().begin();
    draw();
    queries_.back().end();
}

uint64_t Recorder::samples() const {
    uint64_t sum = counted_;
    for (const auto& query : queries_) sum += query.wait_count();
    return sum;
}

void Recorder::bind_drawn() {
    if (unwritten_instances_ != nullptr) unwritten_instances_->write_items<uint32_t>(drawn_->instances);
    input_.scene.bind(*drawn_instances_);
}

void Recorder::draw_visible_meshes() {
    bind_drawn();
    for (const DrawCall& draw : drawn_->draws) {
        bind_batch(draw.batch);
        draw_batch(draw);
    }
}

void Recorder::draw_visible_meshes_marking_materials() {
    bind_drawn();
    for (const DrawCall& draw : drawn_->draws) {
        gl::apply_stencil_reference(material_number(input_.scene.batches()[draw.batch].material));
        bind_batch(draw.batch);
        draw_batch(draw);
    }
}

void Recorder::bind_instances(std::span<const uint32_t> instances) {
    instances_ = gl::Buffer(std::as_bytes(instances), "instances of this pass");
    input_.scene.bind(instances_);
}

void Recorder::bind_batch(uint32_t batch_index) {
    const Batch& batch = input_.scene.batches()[batch_index];
    gl::apply_faces(batch.double_sided || !culls_back_faces_ ? gl::Cull::none : gl::Cull::back, batch.mirrored);
    input_.scene.bind_material(batch.material);
}

void Recorder::draw_batch(const DrawCall& draw) {
    const Batch& batch = input_.scene.batches()[draw.batch];
    counted([&] {
        gl::draw_indexed({.first_index = batch.first_index,
                          .index_count = batch.index_count,
                          .instance_count = draw.instance_count,
                          .first_instance = draw.first_visible});
    });
}

void Recorder::draw_full_screen() {
    bind_full_screen();
    counted([&] { input_.shapes.draw_full_screen(); });
}

void Recorder::draw_full_screen_per_material() {
    std::set<uint32_t> materials;
    for (const DrawCall& draw : drawn_->draws) materials.insert(input_.scene.batches()[draw.batch].material);
    input_.scene.bind_geometry();
    bind_full_screen();
    for (const uint32_t material : materials) {
        input_.scene.bind_material(material);
        gl::apply_stencil_reference(material_number(material));
        counted([&] { input_.shapes.draw_full_screen(); });
    }
}

void Recorder::build_light_lists() {
    CHECK(light_lists_ != nullptr);
    light_lists_->build(input_.frame, tile_depth_);
}

void Recorder::find_hidden() {
    CHECK(occlusion_ != nullptr);
    occlusion_->find_hidden(*occluder_depth_);
}

void Recorder::set_scissor(const PixelRect& rect) {
    gl::set_scissor(rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0);
}

void Recorder::set_light(uint32_t light) { stages_[stage_].program.set_uint(shared::kLightIndexUniform, light); }

void Recorder::draw_light_screen(uint32_t light) {
    set_light(light);
    counted([&] { input_.shapes.draw_full_screen(); });
}

void Recorder::draw_light_instances(uint32_t light, const DrawCall& draw) {
    set_light(light);
    draw_batch(draw);
}

void Recorder::draw_light_volume(uint32_t light) {
    set_light(light);
    const bool spot = input_.frame.lights[light].spot_scale > 0.0F;
    counted([&] { spot ? input_.shapes.draw_cone() : input_.shapes.draw_sphere(); });
}

void draw_visible_meshes(Recorder& recorder) { recorder.draw_visible_meshes(); }
void draw_full_screen(Recorder& recorder) { recorder.draw_full_screen(); }
void build_lists(Recorder& recorder) { recorder.build_light_lists(); }
void find_hidden_instances(Recorder& recorder) { recorder.find_hidden(); }

}  // namespace lightsweep
