#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "base/guidance_buffers.h"
#include "renderer/features/drawn_features.h"
#include "renderer/features/paint_features.h"
#include "tests/grids.h"

namespace belvedere::test {

// Ground of 10 m cells, 4 × 4 km around (0, 0), viewed from the south: its altitude is a function
// of the position.
struct TestGround {
  static constexpr double cell_m = 10.0;
  static constexpr int cells = 401;
  GeoTransform transform{-0.5 * cell_m * cells, 0.5 * cell_m* cells, cell_m, cell_m};
  DeformedSurface surface;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<Tracer> tracer;

  Grid<glm::vec2> goes_to;  // as for widened valleys; empty: nothing moved
  explicit TestGround(const std::function<double(glm::dvec2)>& altitude_m,
                      glm::dvec3 eye = {0.0, -3000.0, 1500.0}, int width = 400, int height = 300) {
    surface.origin = {eye.x, eye.y, 0.0};
    surface.vertices_m = Grid<glm::vec3>(cells, cells);
    for (const auto [x, y] : test::cells(cells, cells)) {
      const glm::dvec2 position = transform.to_crs(x, y);
      surface.vertices_m(x, y) =
          glm::vec3(glm::dvec3(position, altitude_m(position)) - surface.origin);
    }
    const CameraParameters parameters{
        .width = width, .height = height, .eye = eye, .pitch_deg = -27.0};
    camera = make_camera(parameters);
    tracer = std::make_unique<Tracer>(surface);
  }

  GroundSight sight() const { return {transform, surface, *camera, *tracer, goes_to}; }
  glm::dvec2 pixel(glm::dvec3 point) const { return *camera->project(point); }
  PixelRect sheet() const { return {0, 0, camera->size().x, camera->size().y}; }

  // Depth of each pixel's centre, and even light.
  GuidanceBuffers guidance() const {
    GuidanceBuffers out;
    const int width = camera->size().x;
    const int height = camera->size().y;
    out.depth_m = Grid<float>(width, height, std::numeric_limits<float>::infinity());
    out.tone = Grid<float>(width, height, 1.F);
    out.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::sky);
    for (const auto [x, y] : test::cells(width, height)) {
      const Ray ray = camera->ray({x + 0.5, y + 0.5});
      Hit hit;
      tracer->intersect(std::span(&ray, 1), std::span(&hit, 1));
      if (!hit.found) continue;
      out.depth_m(x, y) = static_cast<float>(hit.distance_m);
      out.land_cover(x, y) = LandCoverClass::pasture;
    }
    return out;
  }
};

inline Feature line_feature(int kind, std::vector<glm::dvec2> positions,
                            const FeatureStyle& style) {
  Feature feature;
  feature.kind = kind;
  feature.shape = MapShape::line;
  feature.parts = {std::move(positions)};
  feature.width_mm = static_cast<float>(style.kinds[static_cast<std::size_t>(kind)].width_mm);
  feature.real_m = static_cast<float>(style.kinds[static_cast<std::size_t>(kind)].real_m);
  return feature;
}

inline FeatureSet set_of(FeatureStyle style, std::vector<Feature> features) {
  FeatureSet set;
  set.style = std::move(style);
  set.features = std::move(features);
  set.readings.resize(1);
  return set;
}

// A picture of plain grey ground with the features painted on it.
inline Grid<glm::vec3> painted(const TestGround& ground, const DrawnFeatures& drawn, PixelRect rect,
                               PixelRect asked, float seen = 1.F,
                               const Grid<float>& seen_overhead = {}, PaintParts* parts = nullptr) {
  const GuidanceBuffers all = ground.guidance();
  const int width = rect.width();
  const int height = rect.height();
  GuidanceBuffers part;
  part.depth_m = Grid<float>(width, height);
  part.tone = Grid<float>(width, height);
  part.land_cover = Grid<LandCoverClass>(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    part.depth_m(x, y) = all.depth_m(rect.x0 + x, rect.y0 + y);
    part.tone(x, y) = all.tone(rect.x0 + x, rect.y0 + y);
    part.land_cover(x, y) = all.land_cover(rect.x0 + x, rect.y0 + y);
  }
  Grid<glm::vec3> picture(width, height, glm::vec3(0.4F));
  const Grid<glm::vec3> base = picture;
  const Grid<float> haze(width, height, 0.F);
  const Grid<float> ground_seen(width, height, seen);
  paint_features(picture, drawn, {part, base, haze, ground_seen, seen_overhead}, rect, asked,
                 parts);
  return picture;
}
inline Grid<glm::vec3> painted(const TestGround& ground, const DrawnFeatures& drawn,
                               float seen = 1.F) {
  return painted(ground, drawn, ground.sheet(), ground.sheet(), seen);
}

}  // namespace belvedere::test
