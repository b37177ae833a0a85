#include "renderer/compose/view_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
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

}  // namespace belvedere
