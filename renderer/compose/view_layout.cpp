#include "renderer/compose/view_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

// Base, exaggeration and level ground, from the ground in the wedge.
bool raise(const CoarseGround& ground, ViewShape& view, double lone, const LayoutGiven& given) {
  const Grid<float>& relief = ground.local_relief_m(0.05 * view.far_m);
  std::vector<double> altitude, rugged;
  for (const WedgePoint& p : wedge_points(view)) {
    const GroundCell* c = ground.at(p.position);
    if (c == nullptr || !c->known) continue;
    altitude.push_back(static_cast<double>(c->altitude_m));
    rugged.push_back(
        static_cast<double>(relief[static_cast<std::size_t>(c - ground.cells.data())]));
  }
  constexpr std::size_t fewest = 40;
  if (altitude.size() < fewest) return false;
  view.base_m = given.base_m.value_or(percentile(altitude, 0.10));
  // The share of the picture's height that the relief around a point takes at middle distance: as
  // in painted panoramas.
  constexpr double usual = 1.55, usual_share = 0.085, yields = 0.35;
  const double share =
      percentile(rugged, 0.70) / (0.5 * (view.near_m + view.far_m) * picture_height(view));
  const double found = std::clamp(usual * exact::pow(usual_share / std::max(share, 1e-3), yields),
                                  1.2, 2.0 - 0.5 * lone);
  view.exaggeration = given.exaggeration.value_or(found);
  view.level_m = view.exaggeration * (percentile(altitude, 0.40) - view.base_m);
  return true;
}

}  // namespace

std::vector<WedgePoint> wedge_points(const ViewShape& view) {
  constexpr int rows = 14;
  const bool full = view.field_of_view_deg >= 359.0;
  const int columns = full ? 36 : view.field_of_view_deg > 90.0 ? 25 : 13;
  const double half = to_radians(0.5 * view.field_of_view_deg);
  std::vector<WedgePoint> out;
  out.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int j = 0; j < rows; ++j) {
    const double depth = static_cast<double>(j) / (rows - 1);
    const double distance = view.near_m + (view.far_m - view.near_m) * depth;
    const double wider = full ? 1.0 : 1.16 - 0.14 * depth;
    for (int i = 0; i < columns; ++i) {
      const double across = full ? (2.0 * i + 1.0) / columns - 1.0 : 2.0 * i / (columns - 1) - 1.0;
      const exact::Turn turn = exact::turn(to_radians(view.azimuth_deg) + across * wider * half);
      out.push_back({view.viewer + distance * glm::dvec2(turn.sine, turn.cosine), depth});
    }
  }
  return out;
}

bool fits_data(const CoarseGround& ground, const ViewShape& view) {
  constexpr double nearer = 0.6, off_the_rim = 0.015;
  int near = 0, near_inside = 0, all = 0, inside = 0;
  for (const WedgePoint& p : wedge_points(view)) {
    const GroundCell* c = ground.at(p.position);
    const double rim = c == nullptr ? 0.0 : static_cast<double>(c->rim_m);
    ++all;
    if (rim > 0.0) ++inside;
    if (p.depth >= nearer) continue;
    ++near;
    if (rim > off_the_rim * view.far_m) ++near_inside;
  }
  return near_inside >= 0.99 * near && inside >= 0.93 * all;
}

std::optional<ViewShape> lay_out(const CoarseGround& ground, ViewShape view, double lone,
                                 const LayoutParameters& parameters, const LayoutGiven& given) {
  if (!raise(ground, view, lone, given)) return std::nullopt;
  const double height = picture_height(view);
  const double near = view.near_m, far = view.far_m, crest = view.crest_m;
  const std::vector<glm::dvec2> directions =
      fan_directions(view.field_of_view_deg, view.cylinder, parameters.columns);
  const std::vector<double> distances = growing_distances(0.7 * near, 1.12 * far, parameters.steps);
  // Heights are sampled once; each round only bends them.
  constexpr double unknown = std::numeric_limits<double>::infinity();
  Grid<double> raised(parameters.steps, parameters.columns, unknown);
  for (int k = 0; k < parameters.columns; ++k) {
    const glm::dvec2 direction = to_map(directions[static_cast<std::size_t>(k)], view.azimuth_deg);
    for (int i = 0; i < parameters.steps; ++i) {
      const GroundCell* c =
          ground.at(view.viewer + distances[static_cast<std::size_t>(i)] * direction);
      if (c != nullptr && c->known)
        raised(i, k) = view.raised_m(static_cast<double>(c->altitude_m));
    }
  }
  const double min_over = parameters.over_summit - 0.025 * lone;
  const double steepest =
      view.cylinder ? 3.0
                    : 1.2;  // of the lower edge: no picture is tilted further than a map on a desk
  double top = -0.15 * height;  // depression of the upper edge; an angle, of a cylinder its tangent
  const double rise = far * far - crest * crest;
  const auto drop_m = [&](double distance) {
    return given.drop_m ? given.drop_m(distance) : view.drop_m(distance);
  };
  const auto lay = [&] {
    const double bottom = view.cylinder ? std::min(top + height, steepest)
                                        : tangent(std::min(top + height, steepest));
    double radius = (rise + square(near - crest)) / (2.0 * near * std::max(bottom, 1e-3));
    if (given.eye_m) {
      view.eye_m = given.eye_m(view);
      radius = rise / (2.0 * std::max(view.eye_m - view.base_m - view.level_m, 1.0));
    }
    view.radius_m = std::clamp(radius, 0.25 * far, 12.0 * far);
    if (!given.eye_m)  // with a given bend, level ground at `near` is on the lower edge too
      view.eye_m = view.base_m + view.level_m +
                   (given.drop_m ? near * bottom - drop_m(near) : rise / (2.0 * view.radius_m));
    if (given.pitch_deg) {
      view.pitch_deg = given.pitch_deg(view);
      top = (view.cylinder ? tangent(to_radians(-view.pitch_deg)) : to_radians(-view.pitch_deg)) -
            0.5 * height;
    } else {
      view.pitch_deg = view.cylinder ? -to_degrees(exact::atan2(top + 0.5 * height, 1.0))
                                     : -to_degrees(top + 0.5 * height);
    }
  };
  for (int round = 0; round < parameters.rounds; ++round) {
    lay();
    const ComposedPicture picture(view);
    std::vector<double> drop(distances.size());
    for (std::size_t i = 0; i < drop.size(); ++i) drop[i] = view.eye_m + drop_m(distances[i]);
    std::vector<double> skyline;
    for (int k = 0; k < parameters.columns; ++k) {
      double min = unknown;
      for (int i = 0; i < parameters.steps; ++i) {
        const double z = raised(i, k);
        if (z == unknown) continue;
        min = std::min(
            min, (drop[static_cast<std::size_t>(i)] - z) / distances[static_cast<std::size_t>(i)]);
      }
      if (min == unknown) continue;
      const glm::dvec2 at = picture.position(directions[static_cast<std::size_t>(k)], min);
      if (at.x >= 0.0 && at.x <= 1.0) skyline.push_back(at.y);
    }
    if (skyline.size() < 4) return std::nullopt;
    const double max = percentile(skyline, parameters.max_share_of_skyline) - parameters.sky;
    const double highest = *std::min_element(skyline.begin(), skyline.end()) - min_over;
    if (!given.pitch_deg) top += std::min(max, highest) * height;
  }
  lay();
  return view;
}

}  // namespace belvedere
