#include "texture/strokes/stroke_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/random.h"
#include "texture/strokes/ice/ice_plan.h"

namespace belvedere {
namespace {

constexpr float far_from_haze = 0.34F;
constexpr float far_to_haze = 0.66F;
constexpr float far_missing = 0.50F;  // share of strokes left out …
constexpr float far_broader = 0.60F;  // … and how much broader the others are

constexpr double broadest_units = 11.0;  // of the kinds in stroke_table.cpp
static_assert(0.54 * static_cast<double>(far_broader) * broadest_units <= far_reach_units);

float farness_of(const Stroke& stroke, const BasePicture& base) {
  return smoothstep(far_from_haze, far_to_haze, base.haze[stroke.source]);
}

// Strokes of one small area of the sheet share one random number.
bool is_missing(glm::ivec2 position_px, double pixels_per_unit, float far) {
  constexpr double cell_units = 2.0;
  const auto cell = [&](int px) {
    return static_cast<std::int64_t>(std::floor((px + 0.5) / (cell_units * pixels_per_unit)));
  };
  return random_uniform(0x5eedULL, cell(position_px.x), cell(position_px.y), 0) <
         static_cast<double>(far_missing * far);
}

}  // namespace

std::vector<Stroke> broaden_far(std::vector<Stroke> strokes, const BasePicture& base,
                                glm::ivec2 origin_px, double pixels_per_unit) {
  const int width = base.haze.width();
  std::size_t kept = 0;
  for (Stroke& stroke : strokes) {
    const float far = farness_of(stroke, base);
    if (far > 0.F) {
      const int source = static_cast<int>(stroke.source);
      if (is_missing(origin_px + glm::ivec2(source % width, source / width), pixels_per_unit, far))
        continue;
      stroke.start_width *= 1.F + far_broader * far;
      stroke.end_width *= 1.F + far_broader * far;
    }
    strokes[kept++] = stroke;
  }
  strokes.resize(kept);
  return strokes;
}

namespace {

// Edges of strokes are soft over a pixel, and positions and steps are rounded to whole pixels.
constexpr int rounding_px = 4;

// The maximum over the painted kinds, 0 if none is painted.
template <class Reach>
int max_of(const StrokeLayers& layers, Reach&& reach) {
  int max = 0;
  for (const StrokeKind& kind : stroke_kinds())
    if (is_painted(kind, layers)) max = std::max(max, reach(kind));
  return max;
}

// Pixels that strokes reach, or read, according to the table.
int to_px(double units, const StrokeParameters& parameters) {
  return static_cast<int>(std::ceil((units + far_reach_units) * parameters.pixels_per_unit)) +
         rounding_px;
}

bool is_whole(const SheetWindow& window, int width, int height) {
  return window.origin_px == glm::ivec2(0) &&
         (window.sheet_px == glm::ivec2(0) || window.sheet_px == glm::ivec2(width, height));
}

// A plan for a whole sheet that has none yet, if it will be needed.
std::optional<IcePlan> missing_plan(const GuidanceBuffers& guidance, const StrokeLayers& layers,
                                    const StrokeParameters& parameters, const SheetWindow& window) {
  const std::span<const StrokeKind> kinds = stroke_kinds();
  const bool asked = std::any_of(kinds.begin(), kinds.end(), [&](const StrokeKind& kind) {
    return kind.on_ice && is_painted(kind, layers);
  });
  if (!asked || window.ice != nullptr) return std::nullopt;
  if (!is_whole(window, guidance.width(), guidance.height()))
    throw Error(ErrorKind::bug, "paint_strokes", "a window of the sheet has no ice plan");
  return plan_ice(guidance, parameters);
}

void check_window(const SheetWindow& window, int width, int height) {
  const bool whole = window.sheet_px == glm::ivec2(0) && window.origin_px == glm::ivec2(0);
  const bool inside = window.origin_px.x >= 0 && window.origin_px.y >= 0 &&
                      window.origin_px.x + width <= window.sheet_px.x &&
                      window.origin_px.y + height <= window.sheet_px.y;
  if (!whole && !inside)
    throw Error(ErrorKind::bug, "paint_strokes", "the window is outside the sheet");
  const PixelRect& asked = window.asked;
  const bool held =
      asked == PixelRect{} || (asked.x0 >= 0 && asked.y0 >= 0 && asked.x0 < asked.x1 &&
                               asked.y0 < asked.y1 && asked.x1 <= width && asked.y1 <= height);
  if (!held)
    throw Error(ErrorKind::bug, "paint_strokes", "the requested pixels are outside the window");
}

// Removes strokes that start on cleared ground, and marks the rest as standing.
void stand_beside(std::vector<Stroke>& strokes, const Grid<std::uint8_t>& cleared) {
  std::erase_if(strokes, [&](const Stroke& stroke) { return cleared[stroke.source] != 0; });
  for (Stroke& stroke : strokes) stroke.standing = true;
}

// Standing objects in mist are as transparent as the mist in front of their foot makes them; fully
// hidden ones are removed.
void veil_strokes(std::vector<Stroke>& strokes, const Grid<float>& veil) {
  constexpr float hidden = 0.97F;
  std::erase_if(strokes, [&](const Stroke& stroke) { return veil[stroke.source] >= hidden; });
  for (Stroke& stroke : strokes) {
    const float left = 1.F - veil[stroke.source];
    stroke.alpha *= left;
    stroke.bristle *= left;
  }
}

void check_sizes(const Grid<glm::vec3>& canvas, const GuidanceBuffers& guidance,
                 const BasePicture& base) {
  using B = GuidanceBuffers;
  require_channels(guidance,
                   {&B::depth_m, &B::position_m, &B::land_cover, &B::tone, &B::fall_line,
                    &B::slope_deg, &B::footprint_m, &B::relief_s_m, &B::built, &B::grain},
                   "strokes");
  const bool same = canvas.same_size(guidance.depth_m) && canvas.same_size(base.colour) &&
                    canvas.same_size(base.darker) && canvas.same_size(base.lighter) &&
                    canvas.same_size(base.accent) && canvas.same_size(base.tree_density) &&
                    canvas.same_size(base.haze);
  if (!same)
    throw Error(ErrorKind::bug, "paint_strokes",
                "canvas, guidance and base picture have different sizes");
}

}  // namespace

Painting paint_strokes(Grid<glm::vec3> canvas, const GuidanceBuffers& guidance,
                       const BasePicture& base, const StrokeLayers& layers,
                       const StrokeParameters& parameters, Progress& progress,
                       const SheetWindow& given, PaintParts* parts) {
  check_sizes(canvas, guidance, base);
  check_window(given, guidance.width(), guidance.height());
  const std::optional<IcePlan> own_plan = missing_plan(guidance, layers, parameters, given);
  SheetWindow window = given;
  if (own_plan) window.ice = &*own_plan;
  if (window.mapped != nullptr && !window.mapped->cleared.same_size(guidance.depth_m))
    throw Error(ErrorKind::bug, "paint_strokes",
                "the cleared mask and the guidance have different sizes");
  if (window.veil != nullptr && !window.veil->same_size(guidance.depth_m))
    throw Error(ErrorKind::bug, "paint_strokes", "mist and guidance have different sizes");
  const bool overhead = window.mapped != nullptr && !window.mapped->overhead_m.empty();
  if (overhead && !window.mapped->overhead_m.same_size(guidance.depth_m))
    throw Error(ErrorKind::bug, "paint_strokes",
                "overhead distances and guidance have different sizes");
  Painting painting = begin_painting(std::move(canvas), window.recorded);
  if (window.mapped != nullptr)
    painting.seen_ground = Grid<float>(guidance.width(), guidance.height(), 1.F);
  if (overhead) painting.seen_overhead = painting.seen_ground;
  const auto paint = [&](std::vector<Stroke> strokes) {
    // Far away, air evens out the variation of loads of paint.
    for (Stroke& stroke : strokes)
      stroke.load *= 1.F - 0.8F * std::clamp(base.haze[stroke.source], 0.F, 1.F);
    if (window.veil != nullptr) veil_strokes(strokes, *window.veil);
    if (!strokes.empty())
      paint_in_order(painting, guidance, std::move(strokes), parameters.pixels_per_unit, progress,
                     window, parts);
  };

  std::vector<Stroke> body;
  for (const StrokeKind& kind : stroke_kinds()) {
    if (!is_painted(kind, layers)) continue;
    const StrokeScene scene{guidance, base, parameters, window, stroke_margin_px(kind, parameters)};
    std::vector<Stroke> strokes = kind.grow(scene, kind.stream);
    if (window.mapped != nullptr && kind.layer == &StrokeLayers::upright)
      stand_beside(strokes, window.mapped->cleared);
    if (kind.layer != &StrokeLayers::sky)
      strokes = broaden_far(std::move(strokes), base, window.origin_px, parameters.pixels_per_unit);
    for (Stroke& stroke : strokes) stroke.part = part_of(kind);
    if (kind.alone)
      paint(std::move(strokes));
    else
      body.insert(body.end(), strokes.begin(), strokes.end());
  }
  if (window.mapped != nullptr)
    body.insert(body.end(), window.mapped->besides.begin(), window.mapped->besides.end());
  paint(std::move(body));
  return painting;
}

int stroke_margin_px(const StrokeKind& kind, const StrokeParameters& parameters) {
  return to_px(kind.reach.seen_units, parameters);
}

int stroke_margin_px(const StrokeLayers& layers, const StrokeParameters& parameters) {
  return max_of(layers, [&](const StrokeKind& kind) { return stroke_margin_px(kind, parameters); });
}

int paint_source_reach_px(const StrokeKind& kind, const StrokeParameters& parameters) {
  return to_px(kind.reach.source_units, parameters);
}

int paint_source_reach_px(const StrokeLayers& layers, const StrokeParameters& parameters) {
  return max_of(layers,
                [&](const StrokeKind& kind) { return paint_source_reach_px(kind, parameters); });
}

}  // namespace belvedere
