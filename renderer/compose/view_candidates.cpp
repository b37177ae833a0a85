#include "renderer/compose/view_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
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

namespace {

constexpr double off_request_deg = 15.0;  // tolerance of a requested azimuth

double turned(double degrees) { return degrees - 360.0 * std::floor(degrees / 360.0); }
double azimuth_difference_deg(double a, double b) {
  return std::abs(turned(a - b + 180.0) - 180.0);
}

// A place that a user wants in the picture, as an anchor: a summit's top is visible or hidden.
Anchor anchor_of(const CoarseGround& ground, const ViewRequest::Place& position) {
  return {.kind = AnchorKind::summit,
          .position = position.position,
          .altitude_m = ground.altitude_m(position.position) + 30.0,
          .stands_m = 0.0,
          .rank = 0.0,
          .along = glm::dvec2(0.0)};
}

bool allowed(const ViewSearch& search, const ViewPlan& plan) {
  const FormatLimits limits = limits_of(search.request.format);
  constexpr double slack = 1e-9;
  if (search.request.towards_deg &&
      azimuth_difference_deg(plan.azimuth_deg, *search.request.towards_deg) >
          off_request_deg + slack)
    return false;
  return plan.field_of_view_deg >= limits.min_field_deg - slack &&
         plan.field_of_view_deg <= limits.max_field_deg + slack &&
         plan.near_share >= limits.min_near - slack && plan.near_share <= limits.max_near + slack &&
         plan.crest_share >= 0.66 - slack && plan.crest_share <= 0.95 + slack &&
         plan.anchor_share > 0.35 && plan.anchor_share < 0.98 && plan.across > 0.2 &&
         plan.across < 0.8;
}

// A value of a plan and the first step along it. A factor is changed by ratios.
struct Step {
  double ViewPlan::*value;
  double by;
  bool factor;
};

}  // namespace

ViewShape shape_of(const ViewSearch& search, const ViewPlan& plan) {
  const FormatLimits limits = limits_of(search.request.format);
  ViewShape view;
  view.azimuth_deg = plan.azimuth_deg;
  view.field_of_view_deg = plan.field_of_view_deg;
  view.aspect = search.request.format.aspect;
  view.cylinder = limits.cylinder;
  view.far_m = plan.far_m;
  view.near_m = plan.near_share * plan.far_m;
  view.crest_m = plan.crest_share * plan.far_m;
  if (search.request.from) {
    view.viewer = *search.request.from;
    return view;
  }
  // The line of sight to the anchor is off the centre by the angle that puts the anchor at its
  // position across.
  const double half = to_radians(0.5 * plan.field_of_view_deg);
  const double off = 2.0 * plan.across - 1.0;
  double turn = off * half;
  if (!limits.cylinder) {
    const exact::Turn edge = exact::turn(half);
    turn = exact::atan2(off * edge.sine / edge.cosine, 1.0);
  }
  const exact::Turn sight = exact::turn(to_radians(plan.azimuth_deg) + turn);
  const glm::dvec2 anchor = search.massifs.anchors[static_cast<std::size_t>(plan.anchor)].position;
  view.viewer = anchor - plan.anchor_share * plan.far_m * glm::dvec2(sight.sine, sight.cosine);
  return view;
}

std::optional<Candidate> judge(const ViewSearch& search, const ViewPlan& plan,
                               const MeasureParameters& measure) {
  const ViewShape shape = shape_of(search, plan);
  if (!fits_data(search.ground, shape)) return std::nullopt;
  const std::optional<ViewShape> view = lay_out(search.ground, shape, search.massifs.lone);
  if (!view) return std::nullopt;
  Candidate out;
  out.plan = plan;
  out.view = *view;
  std::vector<Anchor> anchors = search.massifs.anchors;
  for (const ViewRequest::Place& position : search.request.include)
    anchors.push_back(anchor_of(search.ground, position));
  out.measures = measure_view(search.ground, *view, anchors, measure);
  ScoreContext context{.lone = search.massifs.lone,
                       .plateau = search.ground.plateau,
                       .main = plan.anchor,
                       .anchors = search.massifs.anchors};
  // With a given viewpoint the picture is about the leading subject that is visible from there.
  if (search.request.from) context.main = out.plan.anchor = leading_anchor(out.measures, context);
  out.terms = score_terms(out.measures, context);
  out.score = total(out.terms);
  out.merit = merit(out.terms, context);
  // Places that the user wants to see outweigh all other terms.
  for (std::size_t i = search.massifs.anchors.size(); i < anchors.size(); ++i) {
    const AnchorSight& sight = out.measures.anchors[i];
    constexpr double outside = 40.0, hidden = 6.0, edge = 2.0;
    if (!sight.inside) out.score -= outside;
    if (sight.inside && sight.seen < 0.5) out.score -= hidden;
    if (sight.inside && (std::abs(sight.position.x - 0.5) > 0.44 || sight.position.y > 0.94))
      out.score -= edge;
  }
  return out;
}

std::vector<Candidate> first_candidates(const ViewSearch& search) {
  const FormatLimits limits = limits_of(search.request.format);
  const std::vector<Anchor>& anchors = search.massifs.anchors;
  // The first three summits, and each canyon and shore.
  std::vector<ViewPlan> starts;
  int summits = 0;
  for (std::size_t k = 0; k < anchors.size(); ++k) {
    if (anchors[k].kind == AnchorKind::summit && ++summits > 3) continue;
    if (search.request.from && k > 0) break;  // only direction and size are left
    for (int a = 0; a < 24; ++a) {
      double azimuth = 15.0 * a;
      if (search.request.towards_deg) {
        if (a > 2) break;
        azimuth = turned(*search.request.towards_deg + 10.0 * (a - 1));
      }
      const bool low =
          anchors[k].kind != AnchorKind::summit;  // canyons and shores lie in the middle distance
      for (const double share : low ? std::array{0.55, 0.66, 0.78} : std::array{0.62, 0.76, 0.90})
        for (const double across : {0.35, 0.5, 0.65}) {
          if (search.request.from && (share > 0.62 || across != 0.5)) continue;
          starts.push_back({.anchor = static_cast<int>(k),
                            .azimuth_deg = azimuth,
                            .field_of_view_deg = limits.field_of_view_deg,
                            .far_m = 0.0,
                            .near_share = limits.near_share,
                            .crest_share = 0.80,
                            .anchor_share = share,
                            .across = across});
        }
    }
  }
  constexpr int sizes = 14;
  constexpr double largest = 1.9, smallest = 0.35;  // of the side
  const std::vector<double> shares = growing_distances(smallest, largest, sizes);
  constexpr MeasureParameters quick{.columns = 61, .steps = 130};
  // The largest that fits, and two more, each at most .7 of the previous one.
  std::vector<std::vector<Candidate>> found(starts.size());
  parallel_ranges(starts.size(), std::size_t{4}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double last = 1e300;
      for (int s = sizes; s-- > 0 && found[i].size() < 3;) {
        ViewPlan plan = starts[i];
        plan.far_m = shares[static_cast<std::size_t>(s)] * search.ground.side_m;
        if (plan.far_m > 0.7 * last) continue;
        std::optional<Candidate> candidate = judge(search, plan, quick);
        if (!candidate) continue;
        last = plan.far_m;
        found[i].push_back(std::move(*candidate));
      }
    }
  });
  std::vector<Candidate> out;
  for (std::vector<Candidate>& of_one : found)
    for (Candidate& candidate : of_one) out.push_back(std::move(candidate));
  return out;
}

namespace {

// Half as far as the first ones.
std::vector<Step> later_steps() {
  return {{&ViewPlan::near_share, 0.04, false},       {&ViewPlan::crest_share, 0.04, false},
          {&ViewPlan::field_of_view_deg, 3.0, false}, {&ViewPlan::far_m, 1.06, true},
          {&ViewPlan::anchor_share, 0.03, false},     {&ViewPlan::azimuth_deg, 4.0, false}};
}

// Steps from a candidate along each value while they improve it, halved after each round.
Candidate climb(const ViewSearch& search, Candidate from, std::vector<Step> steps, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (const Step& step : steps)
      for (const int sign : {-1, 1}) {
        ViewPlan plan = from.plan;
        plan.*step.value = step.factor ? plan.*step.value * (sign > 0 ? step.by : 1.0 / step.by)
                                       : plan.*step.value + sign * step.by;
        plan.azimuth_deg = turned(plan.azimuth_deg);
        if (!allowed(search, plan)) continue;
        std::optional<Candidate> next = judge(search, plan);
        constexpr double better = 0.005;
        if (next && next->score > from.score + better) from = std::move(*next);
      }
    for (Step& step : steps) step.by = step.factor ? std::sqrt(step.by) : 0.5 * step.by;
  }
  return from;
}

}  // namespace

Candidate refine(const ViewSearch& search, Candidate from) {
  if (std::optional<Candidate> again = judge(search, from.plan)) from = std::move(*again);
  from = climb(search, std::move(from),
               {{&ViewPlan::azimuth_deg, 8.0, false},
                {&ViewPlan::field_of_view_deg, 6.0, false},
                {&ViewPlan::near_share, 0.06, false},
                {&ViewPlan::crest_share, 0.06, false},
                {&ViewPlan::far_m, 1.12, true},
                {&ViewPlan::anchor_share, 0.06, false},
                {&ViewPlan::across, 0.05, false}},
               4);
  // Values depend on each other, so a second pass in another order improves what the first one
  // left.
  return climb(search, std::move(from), later_steps(), 3);
}

Candidate resolve(const ViewSearch& search, Candidate from) {
  return climb(search, std::move(from), later_steps(), 2);
}

namespace {

// Two fifths of the ground with data between two distances in view, or of all of it, are lower.
double level_of(const CoarseGround& ground, const CameraParameters& camera, glm::dvec2 viewer,
                double near_m, double far_m) {
  std::vector<float> altitudes;
  if (far_m > near_m) {
    ViewShape view;
    view.viewer = viewer;
    view.azimuth_deg = camera.azimuth_deg;
    view.field_of_view_deg = camera.field_of_view_deg;
    view.near_m = near_m;
    view.far_m = far_m;
    for (const WedgePoint& p : wedge_points(view))
      if (const GroundCell* c = ground.at(p.position); c != nullptr && c->known)
        altitudes.push_back(c->altitude_m);
  }
  constexpr std::size_t fewest = 40;
  if (altitudes.size() < fewest) {
    altitudes.clear();
    for (const GroundCell& c : ground.cells)
      if (c.known) altitudes.push_back(c.altitude_m);
  }
  return static_cast<double>(value_at_rank(altitudes, altitudes.size() * 2 / 5));
}

// The farthest ground, at the centre of the directions.
double farthest_m(const CoarseGround& ground, const std::vector<glm::dvec2>& directions,
                  glm::dvec2 viewer, double azimuth_deg) {
  constexpr int steps = 400;
  std::vector<double> reach;
  for (const glm::dvec2& direction : directions) {
    double last = 0.0;
    for (int k = 1; k <= steps; ++k) {
      const double d = 3.0 * ground.side_m * k / steps;
      const GroundCell* c = ground.at(viewer + d * to_map(direction, azimuth_deg));
      if (c != nullptr && c->known) last = d;
    }
    reach.push_back(last);
  }
  std::sort(reach.begin(), reach.end());
  return reach.empty() ? 0.0 : reach[reach.size() / 2];
}

}  // namespace

CameraPicture::CameraPicture(const CameraParameters& parameters)
    : camera_(make_camera(parameters)), azimuth_deg_(parameters.azimuth_deg) {}

glm::dvec2 CameraPicture::position(glm::dvec2 direction, double depression) const {
  constexpr double away_m = 10000.0;
  const glm::dvec2 on_map = to_map(direction, azimuth_deg_);
  const auto at = camera_->project(camera_->eye() + away_m * glm::dvec3(on_map, -depression));
  if (!at) return {0.5 + 1e6 * direction.x, 1e6};
  return *at / glm::dvec2(camera_->size());
}

std::vector<glm::dvec2> camera_directions(const CameraParameters& camera, int columns) {
  return fan_directions(camera.field_of_view_deg, camera.projection != "perspective", columns);
}

ViewReach find_reach(const CoarseGround& ground, const Deformation& deformation,
                     const CameraParameters& camera) {
  const glm::dvec2 viewer = deformation.viewer_xy();
  const std::vector<glm::dvec2> directions = camera_directions(camera, MeasureParameters{}.columns);
  const double farthest = farthest_m(ground, directions, viewer, camera.azimuth_deg);
  if (farthest <= 0.0) return {};
  // Parallel lines of sight have no horizon: such a view ends where the data do.
  const Projection* projection = find_projection(camera.projection);
  if (projection == nullptr || projection->widest_deg <= 0.0) return {0.5 * farthest, farthest};

  const CameraPicture picture(camera);
  const double base = deformation.parameters().exaggeration_base_m;
  const double smallest = std::max(10.0, 0.001 * ground.side_m);
  ViewReach reach;
  // The horizon determines which ground is in view, and that ground the level of the horizon.
  for (int round = 0; round < 2; ++round) {
    const double level_m = level_of(ground, camera, viewer, reach.near_m, reach.far_m);
    const auto depression = [&](double d) {
      const double z = base + deformation.exaggeration(d) * (level_m - base);
      return (camera.eye.z - z + deformation.drop_m(d)) / d;
    };
    constexpr int steps = 600;
    const std::vector<double> distances =
        growing_distances(smallest, std::max(2.0 * smallest, farthest), steps);
    reach = {0.0, farthest};
    std::size_t highest = 0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      const double t = depression(distances[i]);
      if (reach.near_m == 0.0 && picture.position({0.0, 1.0}, t).y <= 1.0)
        reach.near_m = distances[i];
      if (t < depression(distances[highest])) highest = i;
    }
    // Interpolated between its neighbours, in thirds.
    double from = distances[highest == 0 ? 0 : highest - 1];
    double to = distances[std::min(highest + 1, distances.size() - 1)];
    for (int third = 0; third < 40; ++third) {
      const double a = from + (to - from) / 3.0, b = to - (to - from) / 3.0;
      (depression(a) <= depression(b) ? to : from) = depression(a) <= depression(b) ? b : a;
    }
    reach.far_m = 0.5 * (from + to);
    if (reach.near_m == 0.0 || reach.near_m > 0.98 * reach.far_m) reach.near_m = 0.5 * reach.far_m;
  }
  return reach;
}

}  // namespace belvedere
