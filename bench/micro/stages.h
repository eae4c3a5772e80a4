// The CPU's share of the work, stage by stage, as ordinary Google Benchmark timings.
#pragma once

#include <string>
#include <string_view>

namespace lightsweep {

/// Lights, layouts, image files, metrics, reports, statistics. None needs a GL context.
void add_cpu_stages();

/// The reference picture: surfaces, shading, display values, and the processor's arithmetic peak to hold them against.
/// No GL context either.
void add_reference_stages();

/// Culling lights, and listing them for tiles and clusters. No GL context either.
void add_light_list_stages();

/// Culling instances against the view and against what hides them, and ordering them. No GL context either.
void add_culling_stages();

/// Building a frame (culling) and uploading it. They need a current context, since a scene is culled where it was
/// uploaded.
void add_frame_stages();

/// Whether the benchmark `name` is one of add_frame_stages().
bool is_frame_stage(std::string_view name);

}  // namespace lightsweep
