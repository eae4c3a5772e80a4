// Where the rays through the pixel centres go, in double precision; the camera's eye is the origin. Knows no scene.
#pragma once

#include "renderer/scene/scene.h"

#include <cmath>

namespace lightsweep {

class View {
  public:
    /// `width`, `height`: the picture's size in pixels; pixels are square.
    View(const Camera& camera, int width, int height) : width_(width), height_(height) {
        forward_ = glm::normalize(camera.target - camera.eye);
        right_ = glm::normalize(glm::cross(forward_, camera.up));
        up_ = glm::cross(right_, forward_);
        pixels_per_tangent_ = 0.5 * height / std::tan(0.5 * glm::radians(camera.fov_y_deg));
    }

    int width() const { return width_; }
    int height() const { return height_; }

    /// Through the centre of pixel (x, y), row 0 on top. Not unit: one unit along the view axis.
    glm::dvec3 ray(int x, int y) const {
        return forward_ + right_ * ((x + 0.5 - 0.5 * width_) / pixels_per_tangent_) +
               up_ * ((0.5 * height_ - y - 0.5) / pixels_per_tangent_);
    }

    /// Distance of a point along the view axis; positive in front of the eye.
    double distance(const glm::dvec3& point) const { return glm::dot(point, forward_); }

    /// Where a point in front of the eye is seen, in pixels from the picture's top left corner.
    glm::dvec2 window(const glm::dvec3& point) const {
        const double scale = pixels_per_tangent_ / distance(point);
        return {0.5 * width_ + glm::dot(point, right_) * scale, 0.5 * height_ - glm::dot(point, up_) * scale};
    }

  private:
    int width_, height_;
    glm::dvec3 right_, up_, forward_;  // unit
    double pixels_per_tangent_;
};

}  // namespace lightsweep
