#include "texture/strokes/base_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

double hash_at(int stream, int x, int y) {
  return random_uniform(static_cast<std::uint64_t>(stream), x, y);
}

// Ground on the left in close view, where there is no ice.
bool is_close(int u, int v) { return u < 20 && v >= 32 && v < 160; }

// A brook that runs diagonally over a wall.
bool is_brook(double u, double v) {
  return u >= 122.0 && u < 158.0 && std::abs(v - 40.0 - (u - 122.0)) < 1.2;
}

// The class at a position of the sheet, units: above, blocks of all classes; below, a long glacier
// with ribs of rock and snow in it.
LandCoverClass class_on(int u, int v, int ice_from) {
  const int row = v / 16;
  const int column = u / 20;
  if (v >= ice_from) {
    if (u % 40 > 12 && u % 40 < 22 && v % 60 > 20 && v % 60 < 29 &&
        hash_at(4, u / 40, v / 60) < 0.5)
      return rock;
    return column % 5 == 4 ? snow : glacier;
  }
  if (is_close(u, v)) return row < 5 ? scree : alpine_grass;
  if (u >= 84 && u < 118 && v >= 60 && v < 96)
    return water;  // a lake: streaks keep away from its shores
  if (column == 2) return row % 4 == 0 ? forest : row % 4 == 1 ? pasture : settlement;
  if (column == 3) return row % 3 == 0 ? rock : row % 3 == 1 ? forest : snow;
  const auto& classes = land_cover_classes();
  return classes[random_index(static_cast<std::uint32_t>(classes.size()), 3, column, row)].id;
}

// A sheet on which every pixel differs from its neighbours, so that a missing or moved stroke is
// always visible.
Picture make_sheet(int width_units, int height_units, double pixels_per_unit) {
  const int width = static_cast<int>(width_units * pixels_per_unit);
  const int height = static_cast<int>(height_units * pixels_per_unit);
  const int ice_from = std::min(160, height_units / 2);
  Picture p = plain_picture(rock, width, height);
  p.parameters.pixels_per_unit = pixels_per_unit;
  p.parameters.leaves = {{0.5F, 0.3F, 0.1F}, {0.6F, 0.5F, 0.2F}};
  p.parameters.leaf_share = 0.5;
  p.parameters.wind = 2.0;
  p.parameters.foam = true;
  p.parameters.surf_units = 2.0;
  p.parameters.sea_level_m = 900.0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = x / pixels_per_unit;
      const double v = y / pixels_per_unit;
      const auto noise = [&](std::uint64_t seed, double sigma) {
        return static_cast<float>(gaussian_noise(seed, u, v, sigma));
      };
      const auto grain = [&](int stream) { return static_cast<float>(hash_at(stream, x, y)); };
      const int row = static_cast<int>(v) / 16;
      const int column = static_cast<int>(u) / 20;
      const bool brook = is_brook(u, v);
      const LandCoverClass id =
          brook ? water : class_on(static_cast<int>(u), static_cast<int>(v), ice_from);
      const bool ice_below = v >= ice_from;
      p.guidance.land_cover(x, y) = id;
      const float range = !ice_below && hash_at(5, column, row) < 0.2 ? 1.2F : 1.F;
      p.guidance.depth_m(x, y) = id == sky ? std::numeric_limits<float>::infinity()
                                           : 8000.F * range * (1.F + 0.003F * noise(6, 8.0));
      p.guidance.fall_line(x, y) = glm::normalize(
          glm::vec2((ice_below ? 0.3F : 0.8F) * noise(7, 10.0), 1.F + 0.3F * noise(8, 10.0)));
      p.guidance.tone(x, y) = std::clamp(0.6F + 0.1F * noise(9, 6.0) + 0.1F * grain(9), 0.F, 1.F);
      p.guidance.position_m(x, y) =
          glm::vec3(12.0 * u, -12.0 * v, id == water ? 900.F : 900.F + 100.F * noise(10, 30.0));
      if (id == water && row % 2 == 1)
        p.guidance.position_m(x, y).z -= static_cast<float>(5.0 * (v - 16.0 * row));
      if (brook) p.guidance.position_m(x, y).z -= static_cast<float>(12.0 * v);
      p.guidance.slope_deg(x, y) = (ice_below ? id == snow : column % 4 == 1) ? 42.F
                                   : row % 2 == 0                             ? 5.F
                                                                              : 20.F;
      p.guidance.footprint_m(x, y) = static_cast<float>(15.0 / pixels_per_unit);
      p.guidance.relief_s_m(x, y) = 22.F + 10.F * noise(11, 12.0);
      p.guidance.built(x, y) = std::clamp(0.55F + 0.25F * noise(12, 6.0), 0.F, 1.F);
      p.guidance.grain(x, y) = glm::vec2(noise(13, 60.0), noise(14, 60.0)) * 0.3F;
      if (!ice_below && is_close(static_cast<int>(u), static_cast<int>(v))) {
        p.guidance.footprint_m(x, y) = static_cast<float>(0.3 / pixels_per_unit);
        p.guidance.position_m(x, y) = glm::vec3(0.3 * u, -0.3 * v, 900.0);
      }
      p.ground.colour(x, y) =
          glm::vec3(0.4F + 0.2F * grain(15), 0.4F + 0.2F * grain(16), 0.4F + 0.2F * grain(17));
      p.ground.darker(x, y) = p.ground.colour(x, y) - 0.1F - 0.05F * grain(18);
      p.ground.lighter(x, y) = p.ground.colour(x, y) + 0.1F + 0.05F * grain(19);
      p.ground.accent(x, y) = 2.F * grain(20) - 1.F;
      p.ground.tree_density(x, y) =
          hash_at(21, column, 2 * row + (static_cast<int>(u) / 10) % 2) < 0.6 ? 0.9F : 0.02F;
      p.ground.haze(x, y) = 0.3F * grain(22);
    }
  return p;
}

template <class T>
Grid<T> cut(const Grid<T>& grid, const PixelRect& rect) {
  Grid<T> part(rect.width(), rect.height());
  for (const auto [x, y] : test::cells(rect.width(), rect.height()))
    part(x, y) = grid(rect.x0 + x, rect.y0 + y);
  return part;
}

Picture cut(const Picture& whole, const PixelRect& r) {
  Picture p;
  p.parameters = whole.parameters;
  const GuidanceBuffers& g = whole.guidance;
  p.guidance.origin_m = g.origin_m;
  p.guidance.depth_m = cut(g.depth_m, r);
  p.guidance.land_cover = cut(g.land_cover, r);
  p.guidance.fall_line = cut(g.fall_line, r);
  p.guidance.tone = cut(g.tone, r);
  p.guidance.position_m = cut(g.position_m, r);
  p.guidance.slope_deg = cut(g.slope_deg, r);
  p.guidance.footprint_m = cut(g.footprint_m, r);
  p.guidance.relief_s_m = cut(g.relief_s_m, r);
  p.guidance.built = cut(g.built, r);
  p.guidance.grain = cut(g.grain, r);
  p.ground = {cut(whole.ground.colour, r),       cut(whole.ground.darker, r),
              cut(whole.ground.lighter, r),      cut(whole.ground.accent, r),
              cut(whole.ground.tree_density, r), cut(whole.ground.haze, r)};
  return p;
}

// A rectangle of the sheet, with the window that contains it and `margin_px` around, as far as the
// sheet extends.
struct Part {
  PixelRect inner;
  PixelRect held;
  SheetWindow window;
};

Part part_of(const Picture& whole, const PixelRect& inner, int margin_px, bool asks) {
  const int width = whole.guidance.width();
  const int height = whole.guidance.height();
  Part part;
  part.inner = inner;
  part.held = {std::max(0, inner.x0 - margin_px), std::max(0, inner.y0 - margin_px),
               std::min(width, inner.x1 + margin_px), std::min(height, inner.y1 + margin_px)};
  part.window = {{part.held.x0, part.held.y0}, {width, height}, {}};
  const PixelRect& held = part.held;
  if (asks)
    part.window.asked = {inner.x0 - held.x0, inner.y0 - held.y0, inner.x1 - held.x0,
                         inner.y1 - held.y0};
  return part;
}

// Corners and edges of the sheet, and positions with strokes, including single pixels.
std::vector<PixelRect> rectangles(const Painting& whole, const Grid<glm::vec3>& canvas, int count) {
  const int width = whole.picture.width();
  const int height = whole.picture.height();
  std::vector<PixelRect> all = {
      {0, 0, 1, 1}, {width - 40, height - 30, width, height}, {0, height / 2, 17, height / 2 + 23}};
  std::vector<int> painted;
  for (std::size_t i = 0; i < canvas.size(); ++i)
    if (whole.picture[i] != canvas[i]) painted.push_back(static_cast<int>(i));
  for (int k = static_cast<int>(all.size()); k < count; ++k) {
    const int longest = k % 3 == 0 ? 1 : 64;
    const int w = 1 + static_cast<int>((longest - 1) * hash_at(30, k, 0));
    const int h = 1 + static_cast<int>((longest - 1) * hash_at(30, k, 1));
    const int i =
        painted[static_cast<std::size_t>(static_cast<double>(painted.size()) * hash_at(30, k, 2))];
    const int x = std::min(i % width, width - w);
    const int y = std::min(i / width, height - h);
    all.push_back({x, y, x + w, y + h});
  }
  return all;
}

// Pixels of the part's inner rectangle that differ from the whole; `farthest_px` is raised to the
// farthest source.
int count_differences(const Painting& whole, const Painting& window, const Part& part,
                      int& farthest_px) {
  int different = 0;
  const auto position = [](std::uint32_t i, int width) {
    return glm::ivec2(static_cast<int>(i) % width, static_cast<int>(i) / width);
  };
  const glm::ivec2 origin = part.window.origin_px;
  for (const auto [x, y] : test::cells(part.inner)) {
    const std::size_t a = whole.picture.index(x, y);
    const std::size_t b = window.picture.index(x - origin.x, y - origin.y);
    const glm::ivec2 source = position(whole.sources[a], whole.picture.width());
    const glm::ivec2 under = position(whole.under[a], whole.picture.width());
    const bool same = whole.picture[a] == window.picture[b] &&
                      whole.under_share[a] == window.under_share[b] &&
                      source == origin + position(window.sources[b], window.picture.width()) &&
                      under == origin + position(window.under[b], window.picture.width());
    different += same ? 0 : 1;
    for (const glm::ivec2 from : {source, under})
      farthest_px = std::max({farthest_px, std::abs(from.x - x), std::abs(from.y - y)});
  }
  return different;
}

Painting paint_kind(const StrokeKind& kind, const Picture& p, const SheetWindow& window) {
  const StrokeScene scene{p.guidance, p.ground, p.parameters, window,
                          stroke_margin_px(kind, p.parameters)};
  Painting painting = begin_painting(p.ground.colour);
  paint_in_order(painting, p.guidance, kind.grow(scene, kind.stream), p.parameters.pixels_per_unit,
                 silent_progress(), window);
  return painting;
}

// Differences of a kind's windows, with `share` of its declared margin.
int kind_differences(const StrokeKind& kind, const Picture& p, int windows, double share) {
  const IcePlan ice = kind.on_ice ? plan_ice(p.guidance, p.parameters) : IcePlan{};
  const Painting whole = paint_kind(kind, p, {.ice = &ice});
  EXPECT_GT(whole.stroke_count, 0U) << kind.name << ": nothing grows here";
  if (whole.stroke_count == 0) return 0;
  const int margin = static_cast<int>(share * stroke_margin_px(kind, p.parameters));
  int different = 0;
  int farthest = 0;
  bool asks = false;
  for (const PixelRect& inner : rectangles(whole, p.ground.colour, windows)) {
    Part part = part_of(p, inner, margin, asks);
    part.window.ice = &ice;
    asks = !asks;
    different +=
        count_differences(whole, paint_kind(kind, cut(p, part.held), part.window), part, farthest);
  }
  EXPECT_LE(farthest, paint_source_reach_px(kind, p.parameters)) << kind.name;
  return different;
}

struct Sheet {
  double pixels_per_unit;
  int width_units, height_units;
};
// The long ones contain the longest moraine.
constexpr Sheet sheets[] = {{0.7, 170, 1000}, {1.0, 170, 1000}, {3.0, 125, 460}};

const Picture& picture_of(const Sheet& sheet) {
  static const std::vector<Picture> pictures = [] {
    std::vector<Picture> all;
    for (const Sheet& each : sheets)
      all.push_back(make_sheet(each.width_units, each.height_units, each.pixels_per_unit));
    return all;
  }();
  return pictures[static_cast<std::size_t>(&sheet - sheets)];
}

TEST(SheetWindow, EachKindPaintsInAWindowWhatItPaintsOnTheWhole) {
  for (const Sheet& sheet : sheets) {
    const Picture& p = picture_of(sheet);
    for (const StrokeKind& kind : stroke_kinds())
      EXPECT_EQ(kind_differences(kind, p, 10, 1.0), 0)
          << kind.name << " at " << sheet.pixels_per_unit;
  }
}

// All layers, and those that are painted as a draft of copied ground.
TEST(SheetWindow, LayersTogetherEqualTheWhole) {
  for (const Sheet& sheet : sheets) {
    const Picture& p = picture_of(sheet);
    const IcePlan ice = plan_ice(p.guidance, p.parameters);
    const StrokeLayers draft{.sky = false, .breaks = false, .upright = false};
    for (const StrokeLayers& layers : {StrokeLayers{}, draft}) {
      const Painting whole = paint_strokes(p.ground.colour, p.guidance, p.ground, layers,
                                           p.parameters, silent_progress());
      const int margin = stroke_margin_px(layers, p.parameters);
      int different = 0;
      int farthest = 0;
      bool asks = true;
      for (const PixelRect& inner : rectangles(whole, p.ground.colour, 12)) {
        Part part = part_of(p, inner, margin, asks);
        part.window.ice = &ice;
        const Picture held = cut(p, part.held);
        const Painting window =
            paint_strokes(held.ground.colour, held.guidance, held.ground, layers, held.parameters,
                          silent_progress(), part.window);
        different += count_differences(whole, window, part, farthest);
        asks = !asks;
      }
      EXPECT_EQ(different, 0) << "at " << sheet.pixels_per_unit;
      EXPECT_LE(farthest, paint_source_reach_px(layers, p.parameters));
      EXPECT_GT(farthest, paint_source_reach_px(layers, p.parameters) / 6);
    }
  }
}

// No kind has a large reach: pieces of a print are painted from inputs within 2 cm, 4 cm where the
// sky is painted.
TEST(SheetWindow, NothingLooksFar) {
  for (const StrokeKind& kind : stroke_kinds())
    EXPECT_LE(kind.reach.seen_units, kind.layer == &StrokeLayers::sky ? 63.0 : 45.0) << kind.name;
}

// Declared margins are not much larger than needed: with an eighth of it windows of every kind
// fail.
TEST(SheetWindow, MarginsAreNeeded) {
  const Picture& p = picture_of(sheets[1]);
  std::string idle;
  for (const StrokeKind& kind : stroke_kinds())
    if (kind_differences(kind, p, 64, 0.125) == 0) idle += std::string(kind.name) + ", ";
  EXPECT_EQ(idle, "");
}

TEST(SheetWindow, AskedPixelsAloneArePainted) {
  const Picture p = make_sheet(170, 400, 1.0);
  const SheetWindow window{{0, 0}, {170, 400}, {40, 60, 71, 200}};
  const Painting whole =
      paint_strokes(p.ground.colour, p.guidance, p.ground, {}, p.parameters, silent_progress());
  const Painting part = paint_strokes(p.ground.colour, p.guidance, p.ground, {}, p.parameters,
                                      silent_progress(), window);
  for (const auto [x, y] : test::cells(170, 400)) {
    const bool is_asked = x >= 40 && x < 71 && y >= 60 && y < 200;
    ASSERT_EQ(part.picture(x, y), is_asked ? whole.picture(x, y) : p.ground.colour(x, y));
  }
  EXPECT_LT(part.stroke_count, whole.stroke_count);
}

TEST(SheetWindow, MarginsGrowWithTheSheetAndWithWhatIsPainted) {
  const StrokeLayers draft{.sky = false, .breaks = false, .upright = false};
  const StrokeLayers none{
      .sky = false, .ground = false, .accents = false, .breaks = false, .upright = false};
  const StrokeParameters small;
  StrokeParameters large;
  large.pixels_per_unit = 8.0;
  EXPECT_EQ(stroke_margin_px(none, small), 0);
  EXPECT_LT(stroke_margin_px(draft, small), stroke_margin_px(StrokeLayers{}, small));
  EXPECT_NEAR(stroke_margin_px(draft, large), 8 * stroke_margin_px(draft, small), 50);
  EXPECT_LE(paint_source_reach_px(draft, small), stroke_margin_px(draft, small));
  EXPECT_LT(paint_source_reach_px(StrokeLayers{}, small), stroke_margin_px(StrokeLayers{}, small));
}

// A plan of the ice serves every window of its sheet; a window cannot make one.
TEST(SheetWindow, PaintsNoIceWithoutThePlan) {
  const Picture p = plain_picture(glacier, 8, 6);
  const StrokeLayers upright{
      .sky = false, .ground = false, .accents = false, .breaks = false, .upright = true};
  const auto paint = [&](const StrokeLayers& layers, const SheetWindow& window) {
    return paint_strokes(p.ground.colour, p.guidance, p.ground, layers, p.parameters,
                         silent_progress(), window);
  };
  const IcePlan ice;
  EXPECT_THROW(paint({}, {.origin_px = {2, 4}, .sheet_px = {10, 10}}), Error);
  EXPECT_NO_THROW(paint({}, {.origin_px = {2, 4}, .sheet_px = {10, 10}, .ice = &ice}));
  EXPECT_NO_THROW(paint(upright, {.origin_px = {2, 4}, .sheet_px = {10, 10}}));
  EXPECT_NO_THROW(paint({}, {.sheet_px = {8, 6}}));
}

TEST(SheetWindow, RefusesWindowsBesideTheSheet) {
  const Picture p = plain_picture(rock, 8, 6);
  const IcePlan ice;
  const auto paint = [&](SheetWindow window) {
    window.ice = &ice;
    return paint_strokes(p.ground.colour, p.guidance, p.ground, {}, p.parameters, silent_progress(),
                         window);
  };
  EXPECT_NO_THROW(paint({{2, 4}, {10, 10}, {0, 0, 8, 6}}));
  EXPECT_THROW(paint({{3, 4}, {10, 10}, {}}), Error);
  EXPECT_THROW(paint({{-1, 0}, {10, 10}, {}}), Error);
  EXPECT_THROW(paint({{2, 4}, {}, {}}), Error);
  EXPECT_THROW(paint({{2, 4}, {10, 10}, {0, 0, 9, 6}}), Error);
}

}  // namespace
}  // namespace belvedere
