#include "texture/strokes/ice_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <iterator>
#include <utility>

#include "texture/strokes/ice_flow.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// The path along positions of the scene's sheet, px; all of them are on the canvas.
IceWay way_along(const StrokeScene& scene, Stream stream, const StrokeSeed& seed,
                 const std::vector<glm::vec2>& positions) {
  IceWay way{.stream = stream,
             .cell = seed.cell(),
             .land_cover = scene.class_at(scene.pixel(positions.front()))};
  way.positions.reserve(positions.size());
  way.depth_m.reserve(positions.size());
  way.lowest = way.highest = positions.front() / scene.scale();
  for (const glm::vec2 position : positions) {
    way.positions.push_back(position / scene.scale());
    way.depth_m.push_back(scene.guidance.depth_m[scene.pixel(position)]);
    way.lowest = glm::min(way.lowest, way.positions.back());
    way.highest = glm::max(way.highest, way.positions.back());
  }
  return way;
}

// Whether a rib of rock ends in the ice just above a position: from there the rubble of two
// glaciers runs down as one line.
bool below_rib(const StrokeScene& scene, const IceFlow& flow, glm::vec2 position, std::size_t i) {
  const float scale = scene.scale();
  const glm::vec2 down = flow.at(position / scale);
  const glm::vec2 across{-down.y, down.x};
  const auto is_rock = [&](glm::vec2 there) {
    if (!scene.on_canvas(there)) return false;
    const std::size_t k = scene.pixel(there);
    return (scene.class_at(k) == rock || scene.class_at(k) == scree) &&
           same_ice_surface(scene, k, i);
  };
  if (!is_rock(position - down * (6.F * scale)) && !is_rock(position - down * (9.F * scale)))
    return false;
  for (const float side : {-10.F, 10.F}) {
    const glm::vec2 there = position + across * (side * scale);
    if (!scene.on_canvas(there) || !is_ice(scene.class_at(scene.pixel(there)))) return false;
  }
  return true;
}

// Whether a position is on a tongue, bare ice between ground without ice, or on the smooth snow
// that feeds it; 0 … 1.
float on_tongue(const StrokeScene& scene, glm::vec2 position) {
  const auto has_none = [&](std::size_t k) {
    return !scene.guidance.is_sky(k) && !is_ice(scene.class_at(k));
  };
  const float near = share_around(scene, position, 11.F, has_none);
  const float far = share_around(scene, position, 26.F, has_none);
  return std::clamp((near + far - 0.1F) / 0.35F, 0.F, 1.F);
}

// Ice breaks up where it is steep, over an edge or round a bend; 0 … 1. It occurs in fields, with
// intact ice between; firn seldom breaks up, and ice on a wall is thin and intact.
float torn(const StrokeScene& scene, const IceFlow& flow, glm::vec2 position, std::size_t i) {
  const float slope_deg = scene.slope_deg(i);
  const float steep = std::clamp((slope_deg - 9.F) / 14.F, 0.F, 1.F);
  const float moving = std::clamp((slope_deg - 4.F) / 5.F, 0.F, 1.F) *
                       std::clamp((38.F - slope_deg) / 8.F, 0.F, 1.F);
  const float over_edge = std::clamp(scene.relief_m(i) / 25.F, -0.3F, 0.5F);
  const glm::vec2 units = position / scene.scale();
  const glm::vec2 down = flow.at(units);
  const glm::vec2 before = flow.at(units - down * 14.F);
  const glm::vec2 after = flow.at(units + down * 14.F);
  const float bend = std::min(1.F, 1.6F * std::abs(before.x * after.y - before.y * after.x));
  const float whole = 1.F - 0.75F * (1.F - on_tongue(scene, position));
  return moving * whole *
         std::clamp(0.50F * steep + over_edge + 0.30F * bend +
                        0.55F * sheet_noise(scene, position, Stream::torn_ice, 24.0) - 0.58F,
                    0.F, 1.F);
}

std::vector<IceWay> flow_lines(const StrokeScene& scene, const IceFlow& flow, Stream stream) {
  return sow<IceWay>(
      scene, 17.F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<IceWay>& out) {
        if (scene.class_at(i) != glacier || scene.slope_deg(i) > 30.F) return;
        if (seed.uniform() > 0.15F + 0.85F * on_tongue(scene, position)) return;
        const int steps = 3 * (2 + static_cast<int>(seed.uniform() * 4.F));
        const std::vector<glm::vec2> positions =
            trace_ice(scene, flow, position, 7.F * scene.scale(), steps);
        if (positions.size() > 3) out.push_back(way_along(scene, stream, seed, positions));
      });
}

std::vector<IceWay> moraines(const StrokeScene& scene, const IceFlow& flow, Stream stream) {
  return sow<IceWay>(
      scene, 6.F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<IceWay>& out) {
        if (scene.class_at(i) != glacier || !below_rib(scene, flow, position, i) ||
            seed.uniform() > 0.30F)
          return;
        const int steps = 3 * (7 + static_cast<int>(seed.uniform() * 12.F));
        const std::vector<glm::vec2> positions =
            trace_ice(scene, flow, position, 5.F * scene.scale(), steps);
        if (positions.size() >= 10) out.push_back(way_along(scene, stream, seed, positions));
      });
}

// A series of arcs, one below the other.
std::vector<IceWay> crevasses(const StrokeScene& scene, const IceFlow& flow, Stream stream) {
  return sow<IceWay>(
      scene, 19.F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<IceWay>& out) {
        if (scene.class_at(i) != glacier) return;
        const float share = torn(scene, flow, position, i);
        if (seed.uniform() > 1.5F * share) return;
        const int count = 2 + static_cast<int>(seed.uniform() * (2.F + 5.F * share));
        const float u = seed.uniform();
        const float longest_units = 7.F + 26.F * u * u * (0.4F + share);
        const float gap_between = seed.between(3.2F, 6.F) * scene.scale();
        std::vector<glm::vec2> centres;
        glm::vec2 centre = position;
        for (int k = 0; k < count && scene.on_canvas(centre); ++k) {
          const std::size_t here = scene.pixel(centre);
          if (scene.class_at(here) != glacier || (k > 0 && !same_ice_surface(scene, here, i)))
            break;
          centres.push_back(centre);
          const glm::vec2 down = flow.at(centre / scene.scale());
          centre += down * (gap_between * seed.between(0.6F, 1.5F));
          const float aside = 0.22F * seed.normal() * longest_units * scene.scale();
          centre += glm::vec2(-down.y, down.x) * aside;
        }
        IceWay way = way_along(scene, stream, seed, centres);
        way.strength = share;
        way.size_units = longest_units;
        out.push_back(std::move(way));
      });
}

// Kinds of strokes that follow paths, by their random streams.
struct WayKind {
  Stream stream;
  std::vector<IceWay> (*find)(const StrokeScene& scene, const IceFlow& flow, Stream stream);
};
constexpr WayKind way_kinds[] = {{Stream::glacier_flow_lines, flow_lines},
                                 {Stream::glacier_moraines, moraines},
                                 {Stream::glacier_crevasses, crevasses}};

}  // namespace

IcePlan plan_ice(const GuidanceBuffers& guidance, const StrokeParameters& parameters) {
  const BasePicture no_paint;
  const StrokeScene scene{guidance, no_paint, parameters};
  IcePlan plan;
  plan.flow = find_ice_flow(scene);
  if (plan.flow.direction.empty()) return plan;
  for (const WayKind& kind : way_kinds) {
    std::vector<IceWay> found = kind.find(scene, plan.flow, kind.stream);
    std::move(found.begin(), found.end(), std::back_inserter(plan.ways));
  }
  return plan;
}

}  // namespace belvedere
