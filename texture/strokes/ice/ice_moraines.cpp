#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "texture/strokes/class_strokes.h"
#include "texture/strokes/ice/ice_ground.h"
#include "texture/strokes/ice/ice_plan.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float moraine_step = 4.F;       // units between positions
constexpr int moraine_steps = 220;        // at most
constexpr std::size_t shortest_way = 10;  // positions of a line on its own
constexpr float joins_within = 3.F;       // units
constexpr float beside_within = 9.F;      // lines that long stay so near are one …
constexpr float beside_share = 0.35F;     // … for this share of their way
constexpr float widest_half = 7.F;        // units, seen from afar
constexpr float widest_near = 10.F;       // units, seen from near
constexpr float full_m = 15.F;       // metres per unit from which on moraines keep their size …
constexpr float max_grown = 2.6F;    // … and how much broader than that they are near, at most
constexpr float firn_until = 0.35F;  // share of the way that may lie in firn

// Where the ice leaves a rib of rock above a position: from there the rubble of two streams runs
// down as one line. With ice on both sides: else it is the glacier's margin.
std::optional<glm::vec2> end_of_rib(const StrokeScene& scene, const IceFlow& flow,
                                    glm::vec2 position, std::size_t i) {
  const float scale = scene.scale();
  const glm::vec2 down = flow.at(position / scale);
  const glm::vec2 across{-down.y, down.x};
  const auto class_near = [&](glm::vec2 there) -> std::optional<LandCoverClass> {
    if (!scene.on_canvas(there)) return std::nullopt;
    const std::size_t k = scene.pixel(there);
    if (!same_ice_surface(scene, k, i)) return std::nullopt;
    return scene.class_at(k);
  };
  for (const float side : {-16.F, -10.F, 10.F, 16.F}) {
    const auto id = class_near(position + across * (side * scale));
    if (!id || !is_ice(*id)) return std::nullopt;
  }
  glm::vec2 start = position;
  for (float up = 1.F; up <= 10.F; up += 1.F) {
    const glm::vec2 there = position - down * (up * scale);
    const auto id = class_near(there);
    if (!id) return std::nullopt;
    if (*id == rock || *id == scree) {
      // Both streams come down beside it.
      const glm::vec2 above = there - down * (14.F * scale);
      for (const float way : {-1.F, 1.F}) {
        bool ice = false;
        for (float aside = 8.F; aside <= 50.F && !ice; aside += 2.F) {
          const auto beside = class_near(above + across * (way * aside * scale));
          ice = beside && is_ice(*beside);
        }
        if (!ice) return std::nullopt;
      }
      return start;
    }
    if (*id != glacier) return std::nullopt;
    start = there;
  }
  return std::nullopt;
}

// Whether ice that ends after its last position ends on ground, at the sheet's border or behind
// another range: not in firn.
bool ends_on_ground(const StrokeScene& scene, const IceFlow& flow,
                    const std::vector<glm::vec2>& way) {
  const glm::vec2 last = way.back();
  const std::size_t i = scene.pixel(last);
  for (const float ahead : {moraine_step, 2.F * moraine_step}) {
    const glm::vec2 there = last + flow.at(last / scene.scale()) * (ahead * scene.scale());
    if (!scene.on_canvas(there)) return true;
    const std::size_t k = scene.pixel(there);
    if (!same_ice_surface(scene, k, i) || !is_ice(scene.class_at(k))) return true;
    if (scene.class_at(k) == snow) return false;
  }
  return false;
}

struct Line {
  IceWay way;
  std::vector<glm::vec2> positions;  // px
  bool joined = false;
};

// Where a line first comes to another of the same ice, and where on that; both as positions.
std::optional<std::pair<std::size_t, std::size_t>> meeting(const Line& line, const Line& other,
                                                           float within) {
  for (std::size_t k = 3; k < line.way.positions.size(); ++k)
    for (std::size_t j = 1; j < other.way.positions.size(); ++j)
      if (glm::distance(line.way.positions[k], other.way.positions[j]) < within &&
          std::abs(line.way.depth_m[k] / other.way.depth_m[j] - 1.F) < same_ice_depth)
        return std::pair(k, j);
  return std::nullopt;
}

float share_beside(const Line& line, const Line& other) {
  std::size_t near = 0;
  for (const glm::vec2 a : line.way.positions)
    near += std::any_of(other.way.positions.begin(), other.way.positions.end(),
                        [&](glm::vec2 b) { return glm::distance(a, b) < beside_within; })
                ? 1
                : 0;
  return static_cast<float>(near) / static_cast<float>(line.way.positions.size());
}

void cut_after(Line& line, std::size_t count) {
  line.positions.resize(count);
  line.way.positions.resize(count);
  line.way.depth_m.resize(count);
}

void measure(const StrokeScene& scene, const IceFlow& flow, Line& line, float width) {
  IceWay& way = line.way;
  const std::size_t count = way.positions.size();
  for (std::size_t k = 0; k < count; ++k) {
    way.across.push_back(across_flow(scene, line.positions[k], flow.at(way.positions[k])));
    const float units = moraine_step * static_cast<float>(k);
    // At the tongue it spreads.
    const float left = moraine_step * static_cast<float>(count - 1 - k);
    const float spread = line.joined ? 1.F : 1.F + 0.9F * std::max(0.F, 1.F - left / 36.F);
    // Near, they are as broad as on the ground, and they swell and thin.
    const float grown =
        std::clamp(full_m / scene.metres_per_unit(scene.pixel(line.positions[k])), 1.F, max_grown);
    const float swells =
        std::clamp(1.F + 0.38F * sheet_noise(scene, line.positions[k], Stream::rubble_places, 19.0),
                   0.45F, 1.8F);
    way.half_width.push_back(
        std::min(widest_near,
                 grown * std::min(widest_half, width * (0.65F + units / 55.F) * spread * swells)));
  }
}

}  // namespace

std::vector<IceWay> plan_moraines(const StrokeScene& scene, const IceFlow& flow, Stream stream) {
  std::vector<Line> found = sow<Line>(
      scene, 6.F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Line>& out) {
        if (scene.class_at(i) != glacier) return;
        const auto start = end_of_rib(scene, flow, position, i);
        if (!start) return;
        Line line;
        line.positions =
            trace_ice(scene, flow, *start, moraine_step * scene.scale(), moraine_steps);
        if (line.positions.size() < shortest_way || !ends_on_ground(scene, flow, line.positions))
          return;
        const auto in_firn = static_cast<float>(
            std::count_if(line.positions.begin(), line.positions.end(), [&](glm::vec2 at) {
              return share_around(scene, at, 26.F,
                                  [&](std::size_t k) { return scene.class_at(k) == snow; }) > 0.3F;
            }));
        if (in_firn > firn_until * static_cast<float>(line.positions.size())) return;
        line.way = way_along(scene, stream, seed, line.positions);
        out.push_back(std::move(line));
      });
  // The longest first; others join it, or give way where they would run beside it.
  std::stable_sort(found.begin(), found.end(), [](const Line& a, const Line& b) {
    return a.positions.size() > b.positions.size();
  });
  std::vector<Line> kept;
  std::vector<IceWay> ways;
  for (Line& line : found) {
    StrokeSeed draws(stream_seed(scene.parameters.seed, stream, 5000), line.way.cell.x,
                     line.way.cell.y);
    const float width = draws.between(0.9F, 1.8F);
    std::size_t first = line.positions.size();
    const Line* into = nullptr;
    std::size_t at = 0;
    for (const Line& other : kept)
      if (const auto met = meeting(line, other, joins_within); met && met->first < first) {
        first = met->first;
        into = &other;
        at = met->second;
      }
    if (into != nullptr) {
      cut_after(line, first);
      line.joined = true;
      // On to the other line's own position.
      if (at + 1 < into->positions.size()) {
        line.positions.push_back(into->positions[at + 1]);
        line.way.positions.push_back(into->way.positions[at + 1]);
        line.way.depth_m.push_back(into->way.depth_m[at + 1]);
        line.way.lowest = glm::min(line.way.lowest, line.way.positions.back());
        line.way.highest = glm::max(line.way.highest, line.way.positions.back());
      }
      if (line.positions.size() < 6) continue;
    }
    const bool beside = std::any_of(kept.begin(), kept.end(), [&](const Line& other) {
      return share_beside(line, other) > beside_share;
    });
    if (beside) continue;
    measure(scene, flow, line, width);
    if (into != nullptr) {
      // From there on the other is broader by the rubble of both.
      Line& receiver = kept[static_cast<std::size_t>(into - kept.data())];
      const float more = line.way.half_width.back();
      for (std::size_t k = at; k < receiver.way.half_width.size(); ++k) {
        float& own = receiver.way.half_width[k];
        own = std::min(widest_near, std::sqrt(own * own + more * more));
      }
    }
    kept.push_back(std::move(line));
  }
  ways.reserve(kept.size());
  for (Line& line : kept) ways.push_back(std::move(line.way));
  return ways;
}

namespace {

constexpr float begins_over = 9.F;   // positions
constexpr float widest_dirt = 20.F;  // dirty ice around a moraine, units

// Rubble on ice between two positions of a moraine: dabs, dense in its middle, with the light of a
// low ridge.
void strew_rubble(const StrokeScene& scene, const IceWay& way, std::size_t k, std::size_t here,
                  StrokeSeed& seed, std::vector<Stroke>& out) {
  const float scale = scene.scale();
  const glm::vec2 from = way_place(scene, way, k);
  const glm::vec2 along = way_place(scene, way, k + 1) - from;
  const glm::vec2 across = way.across[k];
  const float half = way.half_width[k];
  // Seen at a grazing angle there is room for few stones; the first ones lie far apart.
  const float room = std::clamp(1.4F * glm::length(across), 0.35F, 1.F);
  const float begun = std::min(1.F, (static_cast<float>(k) + 1.F) / begins_over);
  const float sun = scene.sun_side(here);
  const float right = across.x >= 0.F ? 1.F : -1.F;
  // Where it is broad it lies in strands that part and join, each of them in heaps.
  const int strands = 1 + static_cast<int>(std::min(3.F, half / 2.2F));
  for (int strand = 0; strand < strands; ++strand) {
    const float slot =
        2.F * (static_cast<float>(strand) + 0.5F) / static_cast<float>(strands) - 1.F;
    const glm::vec2 apart = from + glm::vec2(900.F * scale * static_cast<float>(strand), 0.F);
    const float wander = sheet_noise(scene, apart, Stream::rubble_places, 16.0);
    const float middle = strands > 1 ? 0.66F * slot + 0.36F * wander : 0.12F * wander;
    const float spread = strands > 1 ? 0.38F : 1.1F;
    const float heap = std::clamp(
        0.65F + 0.75F * sheet_noise(scene, apart, Stream::rubble_places, 7.0) + 0.25F * wander, 0.F,
        1.4F);
    const int count = static_cast<int>(
        heap * room * begun * (3.F + 4.2F * half) / static_cast<float>(strands) + 0.5F);
    for (int n = 0; n < count; ++n) {
      const float a = seed.between(-1.F, 1.F);
      const float b = seed.uniform();
      const float aside = middle + spread * a * (0.3F + 1.1F * b * b);
      const float ahead = seed.uniform();
      const float size = seed.between(0.8F, 2.0F);
      const float length = seed.between(0.9F, 2.2F) * size;
      const float turn = 0.45F * seed.normal();
      const float grey = 0.03F + 0.055F * seed.normal();
      const glm::vec2 at = from + along * ahead + across * (aside * half * scale);
      // On its own ground: seen at a grazing angle the next is far away.
      if (!scene.on_canvas(at)) continue;
      const std::size_t own = scene.pixel(at);
      if (scene.class_at(own) != way.land_cover) continue;
      Stroke dab = ice_stroke(scene, own, seed);
      const glm::vec2 way_of = turned(glm::normalize(along), turn_by(turn));
      set_line(dab, at - way_of * (0.5F * length * scale), at + way_of * (0.5F * length * scale),
               size * scale, 0.7F * size * scale);
      const float edge = std::abs(aside - middle) / spread;
      dab.alpha = std::max(0.10F, 0.50F - 0.32F * edge) * (0.4F + 0.6F * begun);
      // The side that faces the sun is light.
      const float ridge = std::min(1.F, half / 2.F) * 0.10F * aside * right * sun;
      dab.colour = through_air(scene, own,
                               by_tone(moraine_paint, scene.guidance.tone[own]) + grey +
                                   ridge * glm::vec3(1.F, 0.95F, 0.85F));
      out.push_back(dab);
    }
  }
}

}  // namespace

std::vector<Stroke> glacier_moraines(const StrokeScene& scene, Stream stream) {
  std::vector<Stroke> out;
  along_ways(scene, stream, [&](const IceWay& way) {
    const std::size_t count = way.positions.size();
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const auto here = way_pixel(scene, way, k);
      if (!here) continue;
      StrokeSeed seed = way_seed(scene, way, 1 + k);
      // Dirty ice under it, broader the farther down.
      if (k % 2 == 0 && k + 3 < count) {
        Stroke band = ice_stroke(scene, *here, seed);
        band.point_count = 4;
        for (std::size_t j = 0; j < 4; ++j) band.points[j] = way_place(scene, way, k + j);
        const float seen = glm::length(way.across[k]);
        const float dirty = 0.06F + 0.09F * std::min(1.F, static_cast<float>(k) / 25.F);
        take_brush(band, scene, std::clamp(3.6F * way.half_width[k] * seen, 1.2F, widest_dirt),
                   {.taper = 0.95F,
                    .alpha = dirty,
                    .bristle = 0.1F,
                    .wetness = 0.02F,
                    .load = 0.4F,
                    .edge = 0.15F});
        band.colour = through_air(scene, *here, by_tone(moraine_paint, scene.guidance.tone[*here]));
        out.push_back(band);
      }
      // In winter a line of stones remains.
      if (scene.parameters.winter && seed.uniform() < 0.6F) continue;
      strew_rubble(scene, way, k, *here, seed, out);
    }
  });
  return out;
}

}  // namespace belvedere
