#include "renderer/features/drawn_houses.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace belvedere {
namespace {

constexpr double usual_length_m = 13.0;
constexpr double usual_width_m = 10.0;
constexpr double eaves = 0.55;      // height of walls, relative to the width
constexpr double ridge = 0.42;      // height of the roof above them, relative to the width
constexpr double overhang = 1.12;   // of the roof
constexpr double max_units = 24.0;  // of 0.5 mm: longer houses are drawn with this length

// A point as a house: its ridge points down the slope, so that snow slides off to the sides; on
// level ground it runs east to west.
Footprint usual_house(const GroundSight& sight, glm::dvec2 position) {
  const double step = 20.0;
  const auto height = [&](glm::dvec2 at) {
    const auto ground = sight.ground(at);
    return ground ? ground->z : 0.0;
  };
  glm::dvec2 fall{
      height(position - glm::dvec2(step, 0.0)) - height(position + glm::dvec2(step, 0.0)),
      height(position - glm::dvec2(0.0, step)) - height(position + glm::dvec2(0.0, step))};
  fall = glm::length(fall) > 0.06 * step ? glm::normalize(fall) : glm::dvec2(1.0, 0.0);
  return {position, 0.5 * usual_length_m * fall, 0.5 * usual_width_m * perpendicular(fall)};
}

// The footprint of a house as rectangles.
std::vector<Footprint> wings_for(const GroundSight& sight, const Feature& feature) {
  if (feature.shape == MapShape::point) return {usual_house(sight, feature.parts.front().front())};
  std::vector<Footprint> wings = wings_of(feature.parts);
  if (wings.size() > 1) return wings;
  // A wall of no length has no direction; a very narrow shed would be a line.
  Footprint& foot = wings.front();
  if (glm::length(foot.along) < 1e-6) foot = usual_house(sight, feature.parts.front().front());
  if (glm::length(foot.across) < 0.35 * glm::length(foot.along))
    foot.across = 0.35 * glm::length(foot.along) * glm::normalize(perpendicular(foot.along));
  return wings;
}

class Builder {
 public:
  // `centre` on the floor; walls of all wings of a house have the same height. The roof of a wing
  // ends at its walls, where another may begin.
  Builder(const HouseMaking& making, glm::dvec3 centre, const Footprint& foot, double scale,
          double wall_m, bool is_wing)
      : making_(making),
        centre_(centre),
        along_(scale * foot.along, 0.0),
        across_(scale * foot.across, 0.0),
        beyond_(is_wing ? 1.0 : overhang) {
    wall_ = {0.0, 0.0, wall_m};
    top_ = {0.0, 0.0, wall_m + ridge * 2.0 * glm::length(across_)};
  }

  // Faces visible from the eye, in painting order.
  std::vector<HouseFace> faces() {
    std::vector<HouseFace> all;
    // Walls with their gables, the farther one first.
    for (const double side : {-1.0, 1.0}) {
      wall(side * across_, along_, all);
      if (wall(side * along_, across_, all)) gable(side, all);
    }
    std::array<double, 2> facing{};
    for (const int k : {0, 1})
      facing[static_cast<std::size_t>(k)] = towards_eye(roof_normal(k == 0 ? -1.0 : 1.0));
    const double first = facing[0] < facing[1] ? -1.0 : 1.0;
    roof(first, all);
    roof(-first, all);
    return all;
  }

  double reach_px(glm::dvec2 foot) const { return reach_of(foot); }

 private:
  std::optional<glm::vec2> project(glm::dvec3 offset) const {
    const auto pixel = making_.sight.pixel(centre_ + offset);
    return pixel ? std::optional(glm::vec2(*pixel)) : std::nullopt;
  }

  double towards_eye(glm::dvec3 normal) const {
    const auto pixel = making_.sight.pixel(centre_);
    return pixel ? glm::dot(normal, -making_.sight.sight_at(*pixel)) : 0.0;
  }

  // From the edge a … b to the edge d … c.
  void add_face(const std::array<glm::dvec3, 4>& positions, glm::dvec3 normal, bool is_roof,
                std::vector<HouseFace>& all) {
    HouseFace face;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const auto pixel = project(positions[k]);
      if (!pixel) return;
      face.corners[k] = *pixel;
    }
    face.light = static_cast<float>(std::max(0.0, glm::dot(glm::normalize(normal), making_.sun)));
    face.roof = is_roof;
    all.push_back(face);
  }

  bool wall(glm::dvec3 out, glm::dvec3 beside, std::vector<HouseFace>& all) {
    if (towards_eye(glm::normalize(out)) <= 0.0) return false;
    add_face({out - beside, out + beside, out + beside + wall_, out - beside + wall_}, out, false,
             all);
    return true;
  }

  void gable(double side, std::vector<HouseFace>& all) {
    const glm::dvec3 out = side * along_;
    add_face({out - across_ + wall_, out + across_ + wall_, out + 0.05 * across_ + top_,
              out - 0.05 * across_ + top_},
             out, false, all);
  }

  glm::dvec3 roof_normal(double side) const {
    const double width = glm::length(across_);
    const double rise = top_.z - wall_.z;
    return glm::normalize(side * across_ / width * rise + glm::dvec3(0.0, 0.0, width));
  }

  void roof(double side, std::vector<HouseFace>& all) {
    const glm::dvec3 normal = roof_normal(side);
    if (towards_eye(normal) <= 0.0) return;
    const glm::dvec3 edge = overhang * side * across_ + wall_ -
                            glm::dvec3(0.0, 0.0, (overhang - 1.0) * (top_.z - wall_.z));
    add_face({edge - beyond_ * along_, edge + beyond_ * along_, beyond_ * along_ + top_,
              -beyond_ * along_ + top_},
             normal, true, all);
  }

  double reach_of(glm::dvec2 foot) const {
    double reach = 0.0;
    for (const double a : {-1.2, 1.2})
      for (const double b : {-1.2, 1.2})
        for (const glm::dvec3& up : {glm::dvec3(0.0), top_})
          if (const auto pixel = making_.sight.pixel(centre_ + a * along_ + b * across_ + up))
            reach = std::max(reach, glm::length(*pixel - foot));
    return reach + 3.0;
  }

  const HouseMaking& making_;
  glm::dvec3 centre_;
  glm::dvec3 along_;
  glm::dvec3 across_;
  glm::dvec3 wall_{0.0};
  glm::dvec3 top_{0.0};
  double beyond_;  // in half lengths: end of the roof
};

}  // namespace

void draw_house(const HouseMaking& making, const Feature& feature, std::vector<DrawnHouse>& houses,
                DrawnCount& count) {
  const FeatureKind& kind = making.kind;
  ++count.features;
  const std::vector<Footprint> wings = wings_for(making.sight, feature);
  const Footprint foot = wings.size() == 1 ? wings.front() : footprint_of(feature.parts.front());
  const auto ground = making.sight.ground(foot.centre);
  if (!ground) {
    ++count.outside_terrain;
    return;
  }
  std::vector<LineSample> asked(1);
  const auto pixel = making.sight.pixel(*ground);
  const glm::dvec2 size = making.sight.size();
  if (!pixel || !(pixel->x > -0.1 * size.x && pixel->y > -0.1 * size.y && pixel->x < 1.1 * size.x &&
                  pixel->y < 1.1 * size.y)) {
    ++count.outside_picture;
    return;
  }
  LineSample& sample = asked.front();
  sample.map = foot.centre;
  sample.point = *ground;
  sample.pixel = *pixel;
  sample.distance_m = making.sight.distance_m(*ground, *pixel);
  sample.on_terrain = sample.projected = sample.in_picture = true;
  const PointLook look = look_at(making.sight, sample.point, sample.pixel, kind, feature.width_mm,
                                 0.0, making.px_per_mm, making.foreground_m_per_px);
  if (look.too_far) {
    ++count.too_far;
    return;
  }
  find_seen(making.sight, asked, making.px_per_mm);
  if (!sample.seen) {
    ++count.hidden;
    return;
  }
  const double m_per_px = making.sight.metres_per_px(sample.point, sample.pixel);
  const double own_px = 2.0 * glm::length(foot.along) / m_per_px;
  const double max_px = 0.5 * max_units * making.px_per_mm;
  const double scale = std::min(std::max(own_px, 2.0 * look.half_px), max_px) / own_px;
  DrawnHouse house;
  house.kind = feature.kind;
  house.foot = glm::vec2(sample.pixel);
  house.distance_m = static_cast<float>(sample.distance_m);
  const double wall_m = eaves * 2.0 * scale * glm::length(wings.front().across);
  const glm::dvec2 level{making.sun.x, making.sun.y};
  const double flat = std::max(0.35, making.sun.z / std::max(1e-3, glm::length(level)));
  struct Placed {
    const Footprint* wing;
    glm::dvec3 centre;
    double distance_m;
  };
  std::vector<Placed> order;
  for (const Footprint& wing : wings) {
    const glm::dvec3 centre = sample.point + glm::dvec3(scale * (wing.centre - foot.centre), 0.0);
    order.push_back({&wing, centre, making.sight.distance_m(centre, sample.pixel)});
  }
  // The farther wing first.
  std::stable_sort(order.begin(), order.end(),
                   [](const Placed& a, const Placed& b) { return a.distance_m > b.distance_m; });
  for (const Placed& placed : order) {
    Builder builder(making, placed.centre, *placed.wing, scale, wall_m, wings.size() > 1);
    const std::vector<HouseFace> faces = builder.faces();
    house.faces.insert(house.faces.end(), faces.begin(), faces.end());
    house.reach_px = std::max(house.reach_px, static_cast<float>(builder.reach_px(sample.pixel)));
    const double height_m = wall_m + ridge * scale * glm::length(placed.wing->across);
    const glm::dvec2 away =
        glm::length(level) > 1e-6 ? -glm::normalize(level) * (height_m / flat) : glm::dvec2(0.0);
    const auto begin = making.sight.pixel(placed.centre);
    const auto end = making.sight.pixel(placed.centre + glm::dvec3(away, 0.0));
    if (!begin || !end) continue;
    const HouseShade shade{
        .from = glm::vec2(*begin),
        .to = glm::vec2(*end),
        .width = static_cast<float>(2.0 * scale * glm::length(placed.wing->across) / m_per_px)};
    house.reach_px = std::max({house.reach_px, glm::length(shade.from - house.foot) + shade.width,
                               glm::length(shade.to - house.foot) + shade.width});
    house.shades.push_back(shade);
  }
  ++count.drawn;
  houses.push_back(std::move(house));
}

}  // namespace belvedere
