#include "texture/sheet/synthesis_tile.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/sheet/plan_data.h"
#include "texture/synthesis/synth_level.h"
#include "texture/synthesis/synthesize.h"

// One tile of a plan: corners, lines and the tile itself, level by level.
namespace belvedere {

namespace {

PixelRect cut(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

int coarser(int pixels, int level) { return (pixels + (1 << level) - 1) >> level; }

// A rectangle of the sheet at a level, extended by so many of the level's pixels on each side,
// within the sheet.
PixelRect at_level(const SynthesisSheet& sheet, const PixelRect& rect, int level, int more_x,
                   int more_y) {
  return cut({(rect.x0 >> level) - more_x, (rect.y0 >> level) - more_y,
              coarser(rect.x1, level) + more_x, coarser(rect.y1, level) + more_y},
             {0, 0, coarser(sheet.width, level), coarser(sheet.height, level)});
}

PixelRect fixed_part(const SynthesisSheet& sheet, const SynthesisArea& area, int level) {
  return at_level(sheet, area.rect, level, fixed_px, fixed_px);
}

PixelRect made_part(const SynthesisSheet& sheet, const SynthesisArea& area, int level) {
  return at_level(sheet, area.rect, level, fixed_px + (area.across_x ? around_px : 0),
                  fixed_px + (area.across_y ? around_px : 0));
}

// The guides of a tile's window and their coarser levels. Halving reads one pixel beyond, so those
// of a level equal the sheet's except for a border within the margin.
struct Guides {
  PixelRect window;
  std::vector<synth::Plane> planes;
  std::vector<Grid<float>> depths;  // empty: no silhouettes
};

Guides make_guides(const synth::Setup& setup, const GuideStack& stack, const PixelRect& window,
                   int levels) {
  Guides guides{window, {}, {}};
  guides.planes.push_back(synth::target_plane(stack, setup));
  if (!stack.depth_m.empty()) guides.depths.push_back(stack.depth_m);
  for (int level = 1; level < levels; ++level) {
    guides.planes.push_back(synth::halve(guides.planes.back()));
    if (!guides.depths.empty())
      guides.depths.push_back(synth::halve_depth(
          guides.depths.back(), guides.planes[guides.planes.size() - 2], guides.planes.back()));
  }
  return guides;
}

synth::Plane cut_plane(const synth::Plane& plane, int x0, int y0, int width, int height) {
  synth::Plane part = synth::make_plane({{width, height}}, plane.guide_count, plane.margin);
  const std::size_t guides = static_cast<std::size_t>(plane.guide_count);
  for (int y = 0; y < height; ++y) {
    const std::size_t from = plane.index(0, x0, y0 + y);
    const std::size_t to = part.index(0, 0, y);
    const std::size_t count = static_cast<std::size_t>(width);
    std::copy_n(plane.words.data() + from, count, part.words.data() + to);
    std::copy_n(plane.guides.data() + from * guides, count * guides,
                part.guides.data() + to * guides);
  }
  synth::pad(part);
  return part;
}

Grid<float> cut_grid(const Grid<float>& grid, int x0, int y0, int width, int height) {
  Grid<float> part(width, height);
  for (int y = 0; y < height; ++y) std::copy_n(grid.row(y0 + y) + x0, width, part.row(y));
  return part;
}

// Resets the plan's use counts when work on a level ends, for any reason.
class UsesOfOneWindow {
 public:
  explicit UsesOfOneWindow(synth::LevelState& state) : state_(state) {}
  UsesOfOneWindow(const UsesOfOneWindow&) = delete;
  UsesOfOneWindow& operator=(const UsesOfOneWindow&) = delete;
  ~UsesOfOneWindow() { synth::forget_uses_of(state_); }

 private:
  synth::LevelState& state_;
};

LevelMatches make_level(const SynthesisPlanData& plan, const Guides& guides,
                        const SynthesisArea& area, int level, const LevelMatches& coarse,
                        const std::vector<const MadeArea*>& fixed, Progress& progress) {
  const std::size_t l = static_cast<std::size_t>(level);
  const PixelRect rect = made_part(plan.sheet, area, level);
  const int x0 = rect.x0 - (guides.window.x0 >> level);
  const int y0 = rect.y0 - (guides.window.y0 >> level);
  synth::Plane target = cut_plane(guides.planes[l], x0, y0, rect.width(), rect.height());
  std::vector<std::uint8_t> links;
  if (!guides.depths.empty())
    links =
        synth::make_links(cut_grid(guides.depths[l], x0, y0, rect.width(), rect.height()), target,
                          synth::depth_ratio(level), plan.setup.parameters.patch_radius());
  synth::LevelSettings settings = plan.setup.settings(level);
  // Different areas draw different numbers.
  settings.seed = random_bits(random_bits(settings.seed, area.rect.x0, area.rect.y0), area.rect.x1,
                              area.rect.y1);
  synth::LevelState state(settings, plan.sources[l], target, std::move(links));

  const std::uint32_t free = state.exemplars.nowhere();
  if (!fixed.empty()) state.fixed.assign(target.words.size(), free);
  for (const MadeArea* made : fixed) {
    const PixelRect part = cut(rect, fixed_part(plan.sheet, made->area, level));
    for (int y = part.y0; y < part.y1; ++y)
      for (int x = part.x0; x < part.x1; ++x)
        state.fixed[target.index(0, x - rect.x0, y - rect.y0)] = made->levels[l].at(x, y);
  }

  // The coarser matches below the window, and around it as far as child pixels may inherit from.
  const synth::Plane& coarse_exemplars = plan.exemplars[l + 1];
  const synth::Plane below =
      synth::make_plane({{(rect.width() + 1) / 2, (rect.height() + 1) / 2}}, 0, target.margin);
  std::vector<std::uint32_t> coarse_match(below.words.size(), coarse_exemplars.nowhere());
  for (int y = -1; y <= below.parts[0].height; ++y) {
    for (int x = -1; x <= below.parts[0].width; ++x) {
      const int coarse_x = rect.x0 / 2 + x;
      const int coarse_y = rect.y0 / 2 + y;
      const std::int64_t at = static_cast<std::int64_t>(below.parts[0].origin) +
                              static_cast<std::int64_t>(y) * below.stride + x;
      if (coarse.contains(coarse_x, coarse_y))
        coarse_match[static_cast<std::size_t>(at)] = coarse.at(coarse_x, coarse_y);
    }
  }

  const UsesOfOneWindow uses(state);
  synth::start_from_coarser(state, coarse_exemplars, below, coarse_match);
  synth::improve(state, progress);
  LevelMatches out{rect, {}};
  out.texels.reserve(static_cast<std::size_t>(rect.width()) *
                     static_cast<std::size_t>(rect.height()));
  target.for_each([&](std::uint32_t at) { out.texels.push_back(state.match[at]); });
  return out;
}

// Hash of all guides that a corner or a line is made with.
std::uint64_t digest_of(const SynthesisSheet& sheet, const Guides& guides,
                        const SynthesisArea& area) {
  std::uint64_t digest = random_bits(area.rect.x0, area.rect.y0, area.rect.x1, area.rect.y1);
  for (int level = 0; level < sheet.level; ++level) {
    const std::size_t l = static_cast<std::size_t>(level);
    const synth::Plane& plane = guides.planes[l];
    const std::size_t each = static_cast<std::size_t>(plane.guide_count);
    const PixelRect rect = moved(made_part(sheet, area, level), -(guides.window.x0 >> level),
                                 -(guides.window.y0 >> level));
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x) {
        const std::size_t at = plane.index(0, x, y);
        digest = mix_bits(digest ^ plane.words[at]);
        for (std::size_t g = 0; g < each; ++g)
          digest = digest * 1099511628211ULL + plane.guides[at * each + g];
        if (!guides.depths.empty())
          digest = mix_bits(digest ^ std::bit_cast<std::uint32_t>(guides.depths[l](x, y)));
      }
  }
  return digest;
}

MadeArea make_area(const SynthesisPlanData& plan, const Guides& guides,
                   const LevelMatches& coarsest, const SynthesisArea& area,
                   const std::vector<const MadeArea*>& fixed, Progress& progress) {
  MadeArea made{area, 0, std::vector<LevelMatches>(static_cast<std::size_t>(plan.sheet.level))};
  for (int level = plan.sheet.level - 1; level >= 0; --level) {
    const std::size_t l = static_cast<std::size_t>(level);
    made.levels[l] =
        make_level(plan, guides, area, level,
                   level + 1 == plan.sheet.level ? coarsest : made.levels[l + 1], fixed, progress);
  }
  return made;
}

MadeArea make_tile(SynthesisPlanData& plan, const Guides& guides, const LevelMatches& coarsest,
                   const PixelRect& tile, Progress& progress) {
  const auto inner_x = [&](int x) { return x > 0 && x < plan.sheet.width; };
  const auto inner_y = [&](int y) { return y > 0 && y < plan.sheet.height; };
  // Made already for a neighbouring tile, or made now.
  const auto made_once = [&](const SynthesisArea& area, const std::vector<const MadeArea*>& fixed) {
    std::uint64_t digest = digest_of(plan.sheet, guides, area);
    for (const MadeArea* end : fixed) digest = mix_bits(digest ^ end->guides);
    if (std::shared_ptr<const MadeArea> made = plan.between_tiles.find(area.rect, digest))
      return made;
    MadeArea made = make_area(plan, guides, coarsest, area, fixed, silent_progress());
    made.guides = digest;
    plan.between_tiles.keep(std::make_shared<const MadeArea>(std::move(made)));
    return plan.between_tiles.find(area.rect, digest);
  };
  std::vector<std::shared_ptr<const MadeArea>> corners;
  for (const int y : {tile.y0, tile.y1}) {
    for (const int x : {tile.x0, tile.x1}) {
      if (inner_x(x) && inner_y(y)) corners.push_back(made_once({{x, y, x, y}, true, true}, {}));
    }
  }
  std::vector<std::shared_ptr<const MadeArea>> lines;
  const auto make_line = [&](const SynthesisArea& area) {
    std::vector<const MadeArea*> ends;
    for (const std::shared_ptr<const MadeArea>& corner : corners) {
      const PixelRect& at = corner->area.rect;
      if (at.x0 >= area.rect.x0 && at.x0 <= area.rect.x1 && at.y0 >= area.rect.y0 &&
          at.y0 <= area.rect.y1)
        ends.push_back(corner.get());
    }
    lines.push_back(made_once(area, ends));
  };
  for (const int x : {tile.x0, tile.x1})
    if (inner_x(x)) make_line({{x, tile.y0, x, tile.y1}, true, false});
  for (const int y : {tile.y0, tile.y1})
    if (inner_y(y)) make_line({{tile.x0, y, tile.x1, y}, false, true});
  std::vector<const MadeArea*> around;
  for (const std::shared_ptr<const MadeArea>& line : lines) around.push_back(line.get());
  return make_area(plan, guides, coarsest, {tile, false, false}, around, progress);
}

// Progress of the tile's levels, weighted by their pixels, as fractions of 1.
class PartsOfOne : public Progress {
 public:
  PartsOfOne(Progress& outer, double total) : outer_(outer), total_(total) {}
  void advance(double amount) override { outer_.advance(amount / total_); }

 private:
  Progress& outer_;
  double total_;
};

}  // namespace

std::shared_ptr<const MadeArea> MadeBetweenTiles::find(const PixelRect& rect,
                                                       std::uint64_t guides) const {
  const auto found = std::find_if(made_.begin(), made_.end(), [&](const auto& made) {
    return made->area.rect == rect && made->guides == guides;
  });
  return found == made_.end() ? nullptr : *found;
}

void MadeBetweenTiles::keep(std::shared_ptr<const MadeArea> made) {
  // For a sheet made column by column, those of the previous column: three per tile.
  constexpr std::size_t max = 128;
  made_.push_back(std::move(made));
  if (made_.size() > max) made_.pop_front();
}

MatchField synthesize_tile(SynthesisPlan& plan, const GuideStack& guides, const PixelRect& tile,
                           Progress& progress) {
  SynthesisPlanData& data = plan.data();
  const SynthesisSheet& sheet = data.sheet;
  if (tile.x0 < 0 || tile.y0 < 0 ||
      !(sheet.tile(tile.x0 / sheet.tile_px, tile.y0 / sheet.tile_px) == tile) ||
      tile.x0 >= sheet.width || tile.y0 >= sheet.height) {
    throw Error(ErrorKind::usage, "tile of synthesis",
                fmt::format("{},{} … {},{}", tile.x0, tile.y0, tile.x1, tile.y1),
                "a tile of the sheet's division");
  }
  MatchField field(tile.width(), tile.height());
  const auto take = [&](const LevelMatches& matches, const synth::Plane& exemplars) {
    parallel_rows(tile.height(), [&](int y) {
      for (int x = 0; x < tile.width(); ++x) {
        const std::uint32_t texel = matches.at(tile.x0 + x, tile.y0 + y);
        if (texel == exemplars.nowhere()) continue;
        const synth::Plane::Place position = exemplars.position(texel);
        field(x, y) = {static_cast<std::uint16_t>(position.part),
                       static_cast<std::uint16_t>(position.x),
                       static_cast<std::uint16_t>(position.y)};
      }
    });
  };
  if (data.setup.classes.count == 0) return field;
  const PixelRect window = synthesis_window(sheet, tile);
  // The part of the plan below the window and one pixel around.
  LevelMatches coarsest;
  coarsest.rect = at_level(sheet, window, sheet.level, 1, 1);
  for (int y = coarsest.rect.y0; y < coarsest.rect.y1; ++y) {
    const auto row = data.matches.begin() + static_cast<std::ptrdiff_t>(y) * sheet.plan_width();
    coarsest.texels.insert(coarsest.texels.end(), row + coarsest.rect.x0, row + coarsest.rect.x1);
  }
  if (sheet.level == 0) {
    take(coarsest, data.exemplars[0]);
    progress.advance(1.0);
    return field;
  }
  check_guide_stack(guides, "window of a tile");
  if (guides.width() != window.width() || guides.height() != window.height()) {
    throw Error(ErrorKind::usage, "window of a tile",
                fmt::format("guides of {} × {}", guides.width(), guides.height()),
                fmt::format("{} × {}", window.width(), window.height()));
  }
  double passes = 0;
  for (int level = 0; level < sheet.level; ++level) {
    const synth::LevelSettings settings = data.setup.settings(level);
    passes += settings.passes + settings.replacing_passes;
  }
  PartsOfOne parts(progress, passes);
  const MadeArea made =
      make_tile(data, make_guides(data.setup, guides, window, sheet.level), coarsest, tile, parts);
  take(made.levels[0], data.exemplars[0]);
  return field;
}

}  // namespace belvedere
