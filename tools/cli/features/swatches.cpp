#include "tools/cli/features/swatches.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/noise.h"
#include "base/progress.h"
#include "renderer/features/drawn_features.h"
#include "renderer/features/house_strokes.h"
#include "renderer/features/paint_features.h"
#include "texture/strokes/brush.h"

namespace belvedere::tools {
namespace {

constexpr int width_px = 200;
constexpr int height_px = 88;
constexpr int gap_px = 8;
constexpr double px_per_mm = 8.0;
constexpr glm::vec3 meadow{0.60F, 0.68F, 0.44F};
constexpr glm::vec3 snow{0.93F, 0.95F, 0.99F};

// A slope of 240 m across that an eye looks down on, with a few swells.
struct Slope {
  static constexpr int cells = 161;
  static constexpr double cell_m = 4.0;
  GeoTransform transform{-0.5 * cells * cell_m, 0.5 * cells* cell_m, cell_m, cell_m};
  DeformedSurface surface;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<Tracer> tracer;

  Slope() {
    CameraParameters view;
    view.width = width_px;
    view.height = height_px;
    view.eye = {0.0, -260.0, 170.0};
    view.pitch_deg = -33.0;
    view.field_of_view_deg = 42.0;
    surface.origin = {view.eye.x, view.eye.y, 0.0};
    surface.vertices_m = Grid<glm::vec3>(cells, cells);
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        const glm::dvec2 place = transform.to_crs(x, y);
        surface.vertices_m(x, y) = glm::vec3(glm::dvec3(place, altitude_m(place)) - surface.origin);
      }
    camera = make_camera(view);
    tracer = std::make_unique<Tracer>(surface);
  }
  static double altitude_m(glm::dvec2 place) { return 0.12 * place.y + 3.0 * gaussian_noise(5, place.x, place.y, 45.0); }
};

struct Ground {
  GuidanceBuffers guidance;
  BasePicture base;
};

// Its depth, and a light from the upper left.
Ground look_at_slope(const Slope& slope, bool winter) {
  Ground ground;
  GuidanceBuffers& g = ground.guidance;
  g.depth_m = Grid<float>(width_px, height_px, std::numeric_limits<float>::infinity());
  g.tone = Grid<float>(width_px, height_px, 0.8F);
  g.land_cover = Grid<LandCoverClass>(width_px, height_px, winter ? LandCoverClass::snow : LandCoverClass::pasture);
  ground.base.colour = Grid<glm::vec3>(width_px, height_px);
  ground.base.haze = Grid<float>(width_px, height_px, 0.F);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const Ray ray = slope.camera->ray({x + 0.5, y + 0.5});
      Hit hit;
      slope.tracer->intersect(std::span(&ray, 1), std::span(&hit, 1));
      if (hit.found) {
        g.depth_m(x, y) = static_cast<float>(hit.distance_m);
        const double light = glm::dot(hit.facet_normal(), glm::normalize(glm::dvec3(-0.6, 0.2, 0.75)));
        g.tone(x, y) = static_cast<float>(std::clamp(0.78 + 2.2 * (light - 0.77), 0.0, 1.0));
      }
      const auto hand = static_cast<float>(0.02 * gaussian_noise(9, x, y, 2.5));
      ground.base.colour(x, y) = (winter ? snow : meadow) * (0.74F + 0.30F * g.tone(x, y)) + hand;
    }
  return ground;
}

std::vector<Feature> examples(const FeatureStyle& style, int kind) {
  const FeatureKind& look = style.kinds[static_cast<std::size_t>(kind)];
  Feature feature;
  feature.kind = kind;
  feature.width_mm = static_cast<float>(look.width_mm);
  feature.real_m = 0.F;  // as on a sheet of a wide view
  std::vector<Feature> all;
  if (look.draw == FeatureDraw::building) {
    feature.shape = MapShape::area;
    for (const glm::dvec2 at : {glm::dvec2(-55.0, -10.0), glm::dvec2(0.0, 12.0), glm::dvec2(52.0, -6.0)}) {
      const glm::dvec2 u = glm::normalize(glm::dvec2(1.0, 0.02 * at.x));
      const glm::dvec2 v{-u.y, u.x};
      feature.parts = {{at - 14.0 * u - 9.0 * v, at + 14.0 * u - 9.0 * v, at + 14.0 * u + 9.0 * v, at - 14.0 * u + 9.0 * v}};
      all.push_back(feature);
    }
    return all;
  }
  feature.shape = MapShape::line;
  if (look.draw == FeatureDraw::cable) {
    feature.parts = {{{-85.0, -45.0}, {80.0, 60.0}}};
  } else {
    feature.parts.emplace_back();
    for (int k = 0; k <= 60; ++k) {
      const double t = k / 30.0 - 1.0;
      feature.parts[0].emplace_back(190.0 * t, 22.0 * t * (t * t - 0.65) * 4.0);
    }
  }
  all.push_back(feature);
  return all;
}

Grid<glm::vec3> paint_half(const FeatureStyle& style, int kind, bool winter) {
  const Slope slope;
  const GroundSight sight(slope.transform, slope.surface, *slope.camera, *slope.tracer);
  FeatureSet set{.style = style, .features = examples(style, kind), .readings = std::vector<SourceReading>(1)};
  const DrawnFeatures drawn =
      draw_features(set, sight, {.winter = winter, .px_per_mm = px_per_mm, .seed = 3, .sun = glm::normalize(glm::dvec3(-0.7, -0.2, 0.7))});
  const Ground ground = look_at_slope(slope, winter);
  StrokeParameters parameters;
  parameters.pixels_per_unit = 0.5 * px_per_mm;
  parameters.winter = winter;
  Painting painting = begin_painting(ground.base.colour);
  painting.seen_ground = Grid<float>(width_px, height_px, 1.F);
  paint_in_order(painting, ground.guidance, house_strokes(drawn, {ground.guidance, ground.base, parameters}), parameters.pixels_per_unit,
                 silent_progress());
  const PixelRect all{0, 0, width_px, height_px};
  paint_features(painting.picture, drawn, {ground.guidance, ground.base.colour, ground.base.haze, painting.seen_ground, {}}, all, all);
  return painting.picture;
}

}  // namespace

Grid<glm::vec3> make_swatch(const FeatureStyle& style, int kind) {
  switch (style.kinds.at(static_cast<std::size_t>(kind)).draw) {
    case FeatureDraw::river:
    case FeatureDraw::area:
    case FeatureDraw::coast:
    case FeatureDraw::town:
      return {};
    case FeatureDraw::line:
    case FeatureDraw::band:
    case FeatureDraw::cable:
    case FeatureDraw::building:
      break;
  }
  Grid<glm::vec3> swatch(2 * width_px + gap_px, height_px, glm::vec3(1.F));
  for (const bool winter : {false, true}) {
    const Grid<glm::vec3> half = paint_half(style, kind, winter);
    for (int y = 0; y < height_px; ++y) std::copy_n(half.row(y), width_px, swatch.row(y) + (winter ? width_px + gap_px : 0));
  }
  return swatch;
}

}  // namespace belvedere::tools
