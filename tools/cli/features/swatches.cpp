#include "tools/cli/features/swatches.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/random.h"
#include "renderer/features/drawn_features.h"
#include "renderer/features/house_strokes.h"
#include "renderer/features/paint_features.h"
#include "renderer/image/image_io.h"
#include "renderer/paint/palette.h"
#include "texture/strokes/stroke_painter.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

constexpr int half_width_px = 200;
constexpr int swatch_height_px = 88;
constexpr int swatch_gap_px = 8;
constexpr double swatch_px_per_mm = 8.0;
constexpr double wood_from = 0.42;  // of the height: houses stand in front of a wood, so that white
                                    // roofs in snow are visible
constexpr double ground_m = 1000.0;  // altitude that the ground's colours are taken at

// A slope of 240 m across, seen from above, with a few swells.
struct Slope {
  static constexpr int cells = 161;
  static constexpr double cell_m = 4.0;
  GeoTransform transform{-0.5 * cells * cell_m, 0.5 * cells* cell_m, cell_m, cell_m};
  DeformedSurface surface;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<Tracer> tracer;

  Slope() {
    CameraParameters view;
    view.width = half_width_px;
    view.height = swatch_height_px;
    view.eye = {0.0, -260.0, 170.0};
    view.pitch_deg = -33.0;
    view.field_of_view_deg = 42.0;
    surface.origin = {view.eye.x, view.eye.y, 0.0};
    surface.vertices_m = Grid<glm::vec3>(cells, cells);
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        const glm::dvec2 position = transform.to_crs(x, y);
        surface.vertices_m(x, y) =
            glm::vec3(glm::dvec3(position, altitude_m(position)) - surface.origin);
      }
    camera = make_camera(view);
    tracer = std::make_unique<Tracer>(surface);
  }
  static double altitude_m(glm::dvec2 position) {
    return 0.12 * position.y + 3.0 * gaussian_noise(5, position.x, position.y, 45.0);
  }
};

struct Ground {
  GuidanceBuffers guidance;
  BasePicture base;
};

glm::vec3 colour_of(const Palette& palette, LandCoverClass id, float tone) {
  const std::vector<ClassPalette::Stop>& stops =
      palette.classes[static_cast<std::size_t>(id)].stops;
  const ClassPalette::Stop* stop = &stops.front();
  for (const ClassPalette::Stop& one : stops)
    if (one.altitude_m <= ground_m) stop = &one;
  std::size_t k = 0;
  while (k + 2 < ramp_tones.size() && tone > static_cast<float>(ramp_tones[k + 1])) ++k;
  const auto from = static_cast<float>(ramp_tones[k]);
  const auto to = static_cast<float>(ramp_tones[k + 1]);
  return glm::mix(stop->ramp[k], stop->ramp[k + 1],
                  std::clamp((tone - from) / (to - from), 0.F, 1.F));
}

// Its view, lit from the upper left: a meadow or snow, with a wood behind where one is asked for.
Ground look_at_slope(const Slope& slope, bool winter, bool with_wood) {
  const Palette palette = read_palette(winter ? "winter" : "summer");
  Ground ground;
  GuidanceBuffers& g = ground.guidance;
  const auto numbers = [](float value) {
    return Grid<float>(half_width_px, swatch_height_px, value);
  };
  g.depth_m = numbers(std::numeric_limits<float>::infinity());
  g.tone = numbers(0.8F);
  g.slope_deg = numbers(8.F);
  g.footprint_m = numbers(1.F);
  g.relief_s_m = g.built = numbers(0.F);
  g.grain = Grid<glm::vec2>(half_width_px, swatch_height_px);
  g.fall_line = Grid<glm::vec2>(half_width_px, swatch_height_px, glm::vec2(0.F, 1.F));
  g.position_m = Grid<glm::vec3>(half_width_px, swatch_height_px);
  g.land_cover = Grid<LandCoverClass>(half_width_px, swatch_height_px,
                                      winter ? LandCoverClass::snow : LandCoverClass::pasture);
  BasePicture& base = ground.base;
  base.colour = base.darker = base.lighter = Grid<glm::vec3>(half_width_px, swatch_height_px);
  base.accent = base.haze = numbers(0.F);
  base.tree_density = numbers(0.95F);
  for (int y = 0; y < swatch_height_px; ++y)
    for (int x = 0; x < half_width_px; ++x) {
      const Ray ray = slope.camera->ray({x + 0.5, y + 0.5});
      Hit hit;
      slope.tracer->intersect(std::span(&ray, 1), std::span(&hit, 1));
      if (hit.found) {
        g.depth_m(x, y) = static_cast<float>(hit.distance_m);
        g.position_m(x, y) = glm::vec3(ray.origin + ray.direction * hit.distance_m);
        const double light =
            glm::dot(hit.facet_normal(), glm::normalize(glm::dvec3(-0.6, 0.2, 0.75)));
        g.tone(x, y) = static_cast<float>(std::clamp(0.78 + 2.2 * (light - 0.77), 0.0, 1.0));
      }
      if (with_wood && y < wood_from * swatch_height_px)
        g.land_cover(x, y) = LandCoverClass::forest;
      const float tone = g.tone(x, y);
      base.colour(x, y) = colour_of(palette, g.land_cover(x, y), tone);
      base.darker(x, y) = colour_of(palette, g.land_cover(x, y), tone - 0.17F);
      base.lighter(x, y) = colour_of(palette, g.land_cover(x, y), tone + 0.17F);
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
    for (const glm::dvec2 at :
         {glm::dvec2(-55.0, -10.0), glm::dvec2(0.0, 12.0), glm::dvec2(52.0, -6.0)}) {
      const glm::dvec2 u = glm::normalize(glm::dvec2(1.0, 0.02 * at.x));
      const glm::dvec2 v{-u.y, u.x};
      feature.parts = {{at - 14.0 * u - 9.0 * v, at + 14.0 * u - 9.0 * v, at + 14.0 * u + 9.0 * v,
                        at - 14.0 * u + 9.0 * v}};
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
  const Grid<glm::vec2> unmoved;
  const GroundSight sight(slope.transform, slope.surface, *slope.camera, *slope.tracer, unmoved);
  FeatureSet set{
      .style = style, .features = examples(style, kind), .readings = std::vector<SourceReading>(1)};
  const DrawnFeatures drawn = draw_features(set, sight,
                                            {.winter = winter,
                                             .px_per_mm = swatch_px_per_mm,
                                             .seed = 3,
                                             .sun = glm::normalize(glm::dvec3(-0.7, -0.2, 0.7))});
  const Ground ground = look_at_slope(
      slope, winter, style.kinds[static_cast<std::size_t>(kind)].draw == FeatureDraw::building);
  StrokeParameters parameters;
  parameters.pixels_per_unit = 0.5 * swatch_px_per_mm;
  parameters.winter = winter;
  const PixelRect all{0, 0, half_width_px, swatch_height_px};
  MappedGround map;
  map.cleared = find_cleared(drawn, ground.guidance.depth_m, all);
  // Only the features and the wood.
  for (std::size_t i = 0; i < map.cleared.size(); ++i)
    if (ground.guidance.land_cover[i] != LandCoverClass::forest) map.cleared[i] = 1;
  map.overhead_m = find_overhead(drawn, all);
  map.besides = house_strokes(drawn, {ground.guidance, ground.base, parameters});
  SheetWindow window;
  window.mapped = &map;
  const StrokeLayers layers{
      .sky = false, .ground = true, .accents = true, .breaks = false, .upright = true};
  Painting painting = paint_strokes(ground.base.colour, ground.guidance, ground.base, layers,
                                    parameters, silent_progress(), window);
  paint_features(painting.picture, drawn,
                 {ground.guidance, ground.base.colour, ground.base.haze, painting.seen_ground,
                  painting.seen_overhead},
                 all, all);
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
  Grid<glm::vec3> swatch(2 * half_width_px + swatch_gap_px, swatch_height_px, glm::vec3(1.F));
  for (const bool winter : {false, true}) {
    const Grid<glm::vec3> half = paint_half(style, kind, winter);
    for (int y = 0; y < swatch_height_px; ++y)
      std::copy_n(half.row(y), half_width_px,
                  swatch.row(y) + (winter ? half_width_px + swatch_gap_px : 0));
  }
  return swatch;
}

namespace {

struct SwatchesOptions {
  std::string style = "classic";
  std::string out;
};

int run(const SwatchesOptions& options) {
  const FeatureStyle style = load_feature_style(options.style);
  const std::filesystem::path folder = options.out;
  for (std::size_t k = 0; k < style.kinds.size(); ++k) {
    const Grid<glm::vec3> swatch = make_swatch(style, static_cast<int>(k));
    if (swatch.empty()) continue;
    const std::string file = (folder / (style.kinds[k].name + ".png")).string();
    write_png8(file, swatch, {});
    print_out(file + "\n");
  }
  return 0;
}

}  // namespace

Action add_features_swatches(CommandOptions& command) {
  const auto options = std::make_shared<SwatchesOptions>();
  command.add_option("--style STYLE", options->style, "classic, ski, or a .toml file")
      .show_default();
  command
      .add_option("--out DIR", options->out,
                  "Folder for a picture of each kind; created if missing")
      .required()
      .files(FileUse::folder);
  command.footer(
      "Paints each kind of a style as in the foreground of a sheet, summer left, winter right, at "
      "8 pixels per mm, to check a style\n"
      "file without rendering a scene.\n"
      "\n"
      "  belvedere features swatches --style my_style.toml --out swatches");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
