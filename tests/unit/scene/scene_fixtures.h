// Files and checks that the scene tests share.
#pragma once

#include "renderer/base/error.h"
#include "renderer/scene/geometry.h"
#include "tests/unit/report/input_error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace lightsweep {

/// A folder that is gone with the test.
class TempFolder {
  public:
    TempFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "lightsweep_scene_XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
        path_ = name;
    }
    ~TempFolder() { std::filesystem::remove_all(path_); }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    /// Writes a file and returns its path.
    std::string write(const std::string& name, std::string_view content) const {
        std::ofstream(path_ / name, std::ios::binary) << content;
        return (path_ / name).string();
    }

  private:
    std::filesystem::path path_;
};

/// Unit normals, unit tangents across them, a handedness of 1 or -1, and triangles whose front is where their normals
/// point. Normals of curved surfaces differ from their triangles', so only the side is compared.
inline void expect_sound_frames(const std::vector<Vertex>& vertices, const std::vector<uint32_t>& indices) {
    for (const Vertex& v : vertices) {
        ASSERT_NEAR(glm::length(v.normal), 1.0, 1e-5);
        ASSERT_NEAR(glm::length(glm::vec3(v.tangent)), 1.0, 1e-5);
        ASSERT_NEAR(glm::dot(v.normal, glm::vec3(v.tangent)), 0.0, 1e-5);
        ASSERT_EQ(std::abs(v.tangent.w), 1.0F);
    }
    ASSERT_EQ(indices.size() % 3, 0U);
    for (size_t i = 0; i < indices.size(); i += 3) {
        const Vertex& a = vertices.at(indices[i]);
        const Vertex& b = vertices.at(indices[i + 1]);
        const Vertex& c = vertices.at(indices[i + 2]);
        const glm::dvec3 front = glm::cross(glm::dvec3(b.position) - glm::dvec3(a.position),
                                            glm::dvec3(c.position) - glm::dvec3(a.position));
        ASSERT_GT(glm::dot(front, glm::dvec3(a.normal) + glm::dvec3(b.normal) + glm::dvec3(c.normal)), 0.0)
            << "triangle " << i / 3;
    }
}

}  // namespace lightsweep
