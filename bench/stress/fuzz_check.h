// Whether a cell of any scene shows what it must: every value finite, the control's G-buffer what exact geometry says,
// and the picture what double precision makes of the surfaces that its shader read, within a bound of its own. What a
// format cannot hold is told as a limit, with a number.
#pragma once

#include "bench/plan/cell.h"
#include "bench/stress/fuzz_compare.h"
#include "bench/stress/judge.h"
#include "bench/stress/workbench.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lightsweep {

/// Shader text with a planted defect, by file below shaders/.
using PlantedText = std::map<std::string, std::string>;

struct CellCheck {
    StressVerdict verdict = StressVerdict::pass;  ///< skipped: the device or the layout refuses the cell
    std::string reason;                           ///< of a failure or a refusal: one line
    /// What a format could not hold ("layout=oct8", "hdr=rgba16f"), and by how much, in words.
    std::map<std::string, std::string> limits;
};

/// One scene in one size. What its cells have in common is drawn and computed once.
class FuzzStage {
  public:
    FuzzStage(Workbench& bench, Scene scene, int width, int height);

    /// Of `cell`, size, scene and light count do not matter.
    CellCheck check(const CellParams& cell, const PlantedText& planted = {});

  private:
    // What is seen with one depth format. `torn`: two surfaces at one depth; which is shown is nobody's promise.
    struct Seen {
        Visibility visible;
        std::vector<ReferenceSurface> surfaces;
        std::vector<bool> torn;
    };
    // What shading reads, and what it must make of that where `judged`.
    struct Expected {
        std::vector<ReferenceSurface> surfaces;
        BoundedRadiance exact;
        std::vector<bool> judged;
        std::string fault;  // of the surfaces themselves
    };
    struct Drawn {
        Image picture;
        int roundings = 1;  // how many times a pixel's sum is stored
    };

    CellCheck check_cell(const CellParams& cell, const PlantedText& planted);
    Drawn draw(const CellParams& cell, const PlantedText& planted);
    const Seen& seen(const Layout& layout);
    const Expected& of_layout(const std::string& key);
    const Expected& of_light_prepass(const std::string& key);
    const Expected& rebuilt();
    Expected expected(std::vector<ReferenceSurface> surfaces, std::vector<SurfaceStep> steps,
                      const std::vector<bool>& torn) const;
    std::string surface_fault(const Seen& seen, const std::vector<DecodedSurface>& decoded, bool is_control) const;
    std::vector<bool> overflowing(const std::vector<ReferenceSurface>& surfaces, double most) const;

    Workbench* bench_;
    std::unique_ptr<Scene> scene_;  // GpuScene keeps its address
    std::unique_ptr<GpuScene> gpu_scene_;
    Subject subject_;
    std::vector<Light> lights_;  // as shaders get them
    std::map<std::pair<gl::Format, DepthConvention>, Seen> seen_;
    std::map<std::string, Expected> expected_;
};

}  // namespace lightsweep
