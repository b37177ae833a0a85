#include "texture/strokes/ice/ice_plan.h"

#include <cmath>
#include <glm/common.hpp>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// Ice breaks up where its bed steepens, where it is steep and in bends; 0 … 1. It occurs in fields,
// with intact ice between; firn seldom breaks up, and ice on a wall is thin and intact.
float torn(const StrokeScene& scene, const IceFlow& flow, glm::vec2 position) {
  constexpr float apart_units = 9.F;
  const glm::vec2 units = position / scene.scale();
  const glm::vec2 down = flow.at(units);
  const float slope_deg = ice_slope_deg(scene, flow, position);
  const auto slope_at = [&](float ahead_units) {
    const glm::vec2 there = position + down * (ahead_units * scene.scale());
    if (!scene.on_canvas(there)) return slope_deg;
    const std::size_t k = scene.pixel(there);
    return is_ice(scene.class_at(k)) && same_ice_surface(scene, k, scene.pixel(position))
               ? ice_slope_deg(scene, flow, there)
               : slope_deg;
  };
  const float moving = std::clamp((slope_deg - 4.F) / 5.F, 0.F, 1.F) *
                       std::clamp((35.F - slope_deg) / 6.F, 0.F, 1.F);
  if (moving <= 0.F) return 0.F;
  const float steepens = slope_at(apart_units) - slope_at(-apart_units);
  const float edge = std::clamp((steepens - 2.5F) / 7.F, 0.F, 1.F);
  const float steep = std::clamp((slope_deg - 9.F) / 13.F, 0.F, 1.F);
  const float over_edge = std::clamp(scene.relief_m(scene.pixel(position)) / 25.F, -0.3F, 0.4F);
  const glm::vec2 before = flow.at(units - down * 14.F);
  const glm::vec2 after = flow.at(units + down * 14.F);
  const float bend = std::min(1.F, 1.6F * std::abs(before.x * after.y - before.y * after.x));
  const float firn =
      share_around(scene, position, 26.F, [&](std::size_t k) { return scene.class_at(k) == snow; });
  const float whole = 1.F - 0.8F * std::clamp(4.F * firn, 0.F, 1.F);
  return moving * whole *
         std::clamp(0.50F * steep + 0.70F * edge + 0.7F * over_edge + 0.25F * bend +
                        0.45F * sheet_noise(scene, position, Stream::torn_ice, 34.0) - 0.50F,
                    0.F, 1.F);
}

std::vector<IceWay> flow_lines(const StrokeScene& scene, const IceFlow& flow, Stream stream) {
  return sow<IceWay>(
      scene, 17.F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<IceWay>& out) {
        if (scene.class_at(i) != glacier || scene.slope_deg(i) > 30.F) return;
        // Level trunks of ice have bands even between firn.
        const float trunk = std::clamp((12.F - scene.slope_deg(i)) / 5.F, 0.F, 1.F);
        if (seed.uniform() > 0.15F + std::max(0.85F * on_tongue(scene, position), 0.5F * trunk))
          return;
        const int steps = 3 * (2 + static_cast<int>(seed.uniform() * 4.F));
        const std::vector<glm::vec2> positions =
            trace_ice(scene, flow, position, 7.F * scene.scale(), steps);
        if (positions.size() > 3) out.push_back(way_along(scene, stream, seed, positions));
      });
}

// A field of arcs, one below the other, the longest in its centre.
IceWay crevasse_field(const StrokeScene& scene, const IceFlow& flow, Stream stream,
                      StrokeSeed& seed, glm::vec2 position, float share) {
  constexpr float falls_from_deg = 25.F;
  constexpr float falls_from = 0.66F;
  const std::size_t i = scene.pixel(position);
  const int count = 4 + static_cast<int>(seed.uniform() * (2.F + 7.F * share));
  const float u = seed.uniform();
  const float longest_units = 24.F + 16.F * u * std::min(1.F, 0.45F + share);
  const bool falls = share > falls_from && ice_slope_deg(scene, flow, position) > falls_from_deg;
  // Cliffs of an icefall are as high as they are apart.
  const float gap_units = (falls ? 1.7F : 1.F) * seed.between(4.4F, 6.6F);
  // Its centre is at the position.
  glm::vec2 centre = position;
  for (int k = 0; k < count / 2; ++k) {
    const glm::vec2 down = flow.at(centre / scene.scale());
    const glm::vec2 above =
        centre - down * (gap_units * (0.45F + 0.55F * std::abs(down.x)) * scene.scale());
    if (!scene.on_canvas(above) || scene.class_at(scene.pixel(above)) != glacier ||
        !same_ice_surface(scene, scene.pixel(above), i))
      break;
    centre = above;
  }
  std::vector<glm::vec2> centres;
  std::vector<glm::vec2> across;
  for (int k = 0; k < count && scene.on_canvas(centre); ++k) {
    const std::size_t here = scene.pixel(centre);
    if (scene.class_at(here) != glacier || !same_ice_surface(scene, here, i)) break;
    const glm::vec2 down = flow.at(centre / scene.scale());
    centres.push_back(centre);
    across.push_back(across_flow(scene, centre, down));
    // Foreshortened as the ice is.
    const float gap = gap_units * (0.45F + 0.55F * std::abs(down.x)) * seed.between(0.8F, 1.25F);
    centre += down * (gap * scene.scale());
    centre += across.back() * (0.05F * seed.normal() * longest_units * scene.scale());
  }
  IceWay way = way_along(scene, stream, seed, centres);
  way.strength = share;
  way.size_units = longest_units;
  way.is_icefall = falls;
  way.across = std::move(across);
  return way;
}

// Few fields, where the ice is most torn: none reaches into another.
std::vector<IceWay> crevasses(const StrokeScene& scene, const IceFlow& flow, Stream stream) {
  constexpr float torn_from = 0.40F;
  constexpr float apart_units = 25.F;
  struct Place {
    StrokeSeed seed;
    glm::vec2 position;
    float share;
  };
  std::vector<Place> places =
      sow<Place>(scene, 9.F, stream,
                 [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Place>& out) {
                   if (scene.class_at(i) != glacier) return;
                   const float share = torn(scene, flow, position);
                   if (share > torn_from) out.push_back({seed, position, share});
                 });
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.share > b.share; });
  std::vector<IceWay> fields;
  std::vector<glm::vec2> taken;
  for (Place& place : places) {
    const bool near = std::any_of(taken.begin(), taken.end(), [&](glm::vec2 other) {
      const glm::vec2 offset = (other - place.position) / scene.scale();
      return offset.x * offset.x + 1.6F * offset.y * offset.y < apart_units * apart_units;
    });
    if (near) continue;
    taken.push_back(place.position);
    if (place.seed.uniform() > 4.F * (place.share - torn_from) + 0.55F) continue;
    fields.push_back(crevasse_field(scene, flow, stream, place.seed, place.position, place.share));
  }
  return fields;
}

// Kinds of strokes that follow paths, by their random streams.
struct WayKind {
  Stream stream;
  std::vector<IceWay> (*find)(const StrokeScene& scene, const IceFlow& flow, Stream stream);
};
constexpr WayKind way_kinds[] = {{Stream::glacier_flow_lines, flow_lines},
                                 {Stream::glacier_moraines, plan_moraines},
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

const IcePlan& ice_of(const StrokeScene& scene) {
  if (scene.window.ice == nullptr)
    throw Error(ErrorKind::bug, "strokes", "ice is to be painted, but the scene has no ice plan");
  return *scene.window.ice;
}

glm::vec2 ice_direction(const StrokeScene& scene, glm::vec2 position) {
  return ice_of(scene).flow.at(position / scene.scale());
}

void lay_flow(Stroke& stroke, const StrokeScene& scene, glm::vec2 position, float length_px,
              float aside_rad) {
  const glm::vec2 turn = turn_by(aside_rad);
  const auto heading = [&](glm::vec2 at) { return turned(ice_direction(scene, at), turn); };
  const float step = length_px / 3.F;
  stroke.point_count = 4;
  // From the centre half a step in each direction, then a whole one with the heading at half the
  // distance.
  const glm::vec2 centre = heading(position);
  stroke.points[1] = position - centre * (0.5F * step);
  stroke.points[2] = position + centre * (0.5F * step);
  stroke.points[0] = stroke.points[1] - heading(stroke.points[1] - centre * (0.5F * step)) * step;
  stroke.points[3] = stroke.points[2] + heading(stroke.points[2] + centre * (0.5F * step)) * step;
}

Stroke ice_stroke(const StrokeScene& scene, std::size_t i, StrokeSeed& seed) {
  Stroke stroke = ground_stroke(scene, i, seed);
  stroke.gate = StrokeGate::same_class;
  stroke.depth_tolerance = same_ice_depth;
  lay_on_top(stroke);
  return stroke;
}

void lay_bow(Stroke& stroke, glm::vec2 centre, glm::vec2 across, glm::vec2 down, float length_px,
             float sag_px) {
  constexpr float positions[Stroke::max_points] = {-0.5F, -0.18F, 0.18F, 0.5F};
  stroke.point_count = Stroke::max_points;
  for (std::size_t k = 0; k < stroke.points.size(); ++k)
    stroke.points[k] = centre + across * (positions[k] * length_px) +
                       down * (sag_px * (1.F - 4.F * positions[k] * positions[k]));
}

StrokeSeed way_seed(const StrokeScene& scene, const IceWay& way, std::size_t part) {
  // Part 0 of the stream seeded the path itself.
  return {stream_seed(scene.parameters.seed, way.stream, part + 1), way.cell.x, way.cell.y};
}

std::optional<std::size_t> way_pixel(const StrokeScene& scene, const IceWay& way, std::size_t k) {
  const glm::vec2 position = way_place(scene, way, k);
  const PixelRect near = scene.seeded();
  const bool wanted =
      position.x >= static_cast<float>(near.x0) && position.y >= static_cast<float>(near.y0) &&
      position.x < static_cast<float>(near.x1) && position.y < static_cast<float>(near.y1);
  if (!wanted) return std::nullopt;
  const std::size_t here = scene.pixel(position);
  const bool other_surface =
      std::abs(scene.guidance.depth_m[here] / way.depth_m[k] - 1.F) > same_ice_depth;
  if (scene.class_at(here) != way.land_cover || other_surface) return std::nullopt;
  return here;
}

}  // namespace belvedere
