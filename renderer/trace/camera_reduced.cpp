#include "renderer/trace/camera_reduced.h"

#include <fmt/core.h>

#include "base/error.h"

namespace belvedere {
namespace {

class ReducedCamera final : public Camera {
 public:
  ReducedCamera(const Camera& whole, int factor) : whole_(whole), factor_(factor) {}
  Ray ray(glm::dvec2 pixel) const override {
    return whole_.ray(pixel * static_cast<double>(factor_));
  }
  std::optional<glm::dvec2> project(glm::dvec3 point) const override {
    std::optional<glm::dvec2> position = whole_.project(point);
    if (position) *position /= static_cast<double>(factor_);
    return position;
  }
  glm::dvec3 eye() const override { return whole_.eye(); }
  glm::ivec2 size() const override { return (whole_.size() + factor_ - 1) / factor_; }

 private:
  const Camera& whole_;
  int factor_;
};

}  // namespace

std::unique_ptr<const Camera> make_reduced_camera(const Camera& whole, int factor) {
  if (factor < 1)
    throw Error(ErrorKind::bug, "reduced camera", fmt::format("a factor of {}", factor),
                "1 or more");
  return std::make_unique<ReducedCamera>(whole, factor);
}

}  // namespace belvedere
