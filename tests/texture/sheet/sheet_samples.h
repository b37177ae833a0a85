#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/texture/synthesis/synthetic_land.h"
#include "texture/sheet/synthesis_tile.h"
#include "texture/synthesis/synthesize.h"

// A synthetic land, its painting, and views and windows of it: the input of tests of plans and
// tiles.
namespace belvedere::sheet_samples {

using test::smooth_noise;

inline GuideStack land(int width, int height, std::uint64_t seed, int guides = 1) {
  GuideStack stack;
  stack.label = Grid<std::uint8_t>(width, height);
  for (int g = 0; g < guides; ++g)
    stack.guides.push_back({"guide " + std::to_string(g), Grid<std::uint8_t>(width, height)});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int g = 0; g < guides; ++g)
        stack.guides[static_cast<std::size_t>(g)].values(x, y) =
            smooth_noise(seed + static_cast<std::uint64_t>(g), x, y, 40 - 5 * g);
      const int altitude = stack.guides[0].values(x, y);
      stack.label(x, y) = altitude < 100 ? 3 : altitude < 150 ? 7 : 9;
    }
  }
  return stack;
}

inline Exemplar painting(int width, int height, std::uint64_t seed, int guides = 1) {
  Exemplar exemplar;
  exemplar.name = "painting " + std::to_string(seed);
  exemplar.guides = land(width, height, seed, guides);
  exemplar.picture = Grid<Rgb8>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int label = exemplar.guides.label(x, y);
      const int streak = test::streak_of(label, x, y, seed + 20);
      const auto bright = [&](int of) {
        return static_cast<std::uint8_t>(streak + 40 + (label == of ? 90 : 0));
      };
      exemplar.picture(x, y) = {bright(9), bright(7), bright(3)};
    }
  }
  return exemplar;
}

inline GuideStack window_of(const GuideStack& stack, const PixelRect& rect) {
  GuideStack out;
  out.label = part_of(stack.label, rect);
  for (const Guide& guide : stack.guides)
    out.guides.push_back({guide.name, part_of(guide.values, rect)});
  if (!stack.depth_m.empty()) out.depth_m = part_of(stack.depth_m, rect);
  return out;
}

// Every 2^level-th pixel.
inline GuideStack small_view(const GuideStack& stack, const SynthesisSheet& sheet) {
  GuideStack out;
  const auto thin = [&](const auto& grid) {
    auto thinned = grid;
    thinned = std::decay_t<decltype(grid)>(sheet.plan_width(), sheet.plan_height());
    for (int y = 0; y < sheet.plan_height(); ++y)
      for (int x = 0; x < sheet.plan_width(); ++x)
        thinned(x, y) = grid(x << sheet.level, y << sheet.level);
    return thinned;
  };
  out.label = thin(stack.label);
  for (const Guide& guide : stack.guides) out.guides.push_back({guide.name, thin(guide.values)});
  if (!stack.depth_m.empty()) out.depth_m = thin(stack.depth_m);
  return out;
}

inline SynthesisPlan plan_of(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                             const SynthesisSheet& sheet,
                             const SynthesisParameters& parameters = {}) {
  return plan_synthesis(exemplars, small_view(target, sheet), sheet, parameters, silent_progress());
}

inline MatchField tile_of(SynthesisPlan& plan, const GuideStack& stack, const PixelRect& tile) {
  return synthesize_tile(plan, window_of(stack, synthesis_window(plan.sheet(), tile)), tile,
                         silent_progress());
}

// All tiles of a sheet, from the last to the first if requested.
inline MatchField all_tiles(SynthesisPlan& plan, const GuideStack& stack, bool backwards = false) {
  const SynthesisSheet sheet = plan.sheet();
  MatchField field(sheet.width, sheet.height);
  const int count = sheet.columns() * sheet.rows();
  for (int i = 0; i < count; ++i) {
    const int nth = backwards ? count - 1 - i : i;
    const PixelRect tile = sheet.tile(nth % sheet.columns(), nth / sheet.columns());
    const MatchField part = tile_of(plan, stack, tile);
    for (int y = 0; y < tile.height(); ++y)
      for (int x = 0; x < tile.width(); ++x) field(tile.x0 + x, tile.y0 + y) = part(x, y);
  }
  return field;
}

}  // namespace belvedere::sheet_samples
