#include "renderer/compose/complete_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "renderer/compose/massifs.h"
#include "renderer/compose/view_measures.h"
#include "renderer/compose/view_score.h"

namespace belvedere {
namespace {

constexpr double crest_share = 0.80;  // of the horizon's distance, for the first try of views

// How far the data extend in the directions of a view: the median.
double reach_m(const CoarseGround& ground, const ViewShape& view) {
  constexpr int columns = 25, steps = 300;
  std::vector<double> reach;
  for (const glm::dvec2 direction :
       fan_directions(view.field_of_view_deg, view.cylinder, columns)) {
    const glm::dvec2 on_map = to_map(direction, view.azimuth_deg);
    double last = 0.0;
    for (int k = 1; k <= steps; ++k) {
      const double distance = 3.0 * ground.side_m * k / steps;
      const GroundCell* c = ground.at(view.viewer + distance * on_map);
      if (c != nullptr && c->known) last = distance;
    }
    reach.push_back(last);
  }
  std::sort(reach.begin(), reach.end());
  return reach[reach.size() / 2];
}

void set_distances(ViewShape& view, double far_m, double near_share) {
  view.far_m = far_m;
  view.near_m = near_share * far_m;
  view.crest_m = crest_share * far_m;
}

// The largest view that the data fill; if none does, one to the end of the data.
bool choose_distances(const CoarseGround& ground, ViewShape& view) {
  const FormatLimits limits = limits_of({view.aspect, view.field_of_view_deg >= 359.0});
  // For a viewer far outside, the data begin at some distance; for one inside, they may end close
  // by.
  const std::array near_shares = {limits.near_share, 0.5 * (limits.near_share + limits.max_near),
                                  limits.max_near, limits.min_near};
  constexpr int sizes = 24;
  constexpr double largest = 1.9, smallest = 0.25;  // of the side
  const std::vector<double> shares = growing_distances(smallest, largest, sizes);
  for (int s = sizes; s-- > 0;)
    for (const double near_share : near_shares) {
      set_distances(view, shares[static_cast<std::size_t>(s)] * ground.side_m, near_share);
      if (fits_data(ground, view)) return true;
    }
  const double reach = reach_m(ground, view);
  if (reach <= 0.0) return false;
  set_distances(view, reach, limits.near_share);
  return true;
}

std::optional<ViewShape> complete(const CoarseGround& ground, const GivenView& given,
                                  double azimuth_deg, double lone) {
  ViewShape view;
  view.viewer = given.viewer;
  view.azimuth_deg = azimuth_deg;
  view.field_of_view_deg = given.field_of_view_deg;
  view.aspect = given.aspect;
  view.cylinder = given.cylinder;
  if (!choose_distances(ground, view)) return std::nullopt;
  return lay_out(ground, view, lone, {}, given.resolved);
}

}  // namespace

std::optional<ViewShape> complete_view(const CoarseGround& ground, const GivenView& given) {
  const Massifs massifs = find_massifs(ground);
  if (given.azimuth_deg) return complete(ground, given, *given.azimuth_deg, massifs.lone);
  constexpr int directions = 24;
  constexpr MeasureParameters quick{.columns = 61, .steps = 130};
  std::optional<ViewShape> best;
  double max = 0.0;
  for (int k = 0; k < directions; ++k) {
    const std::optional<ViewShape> view =
        complete(ground, given, 360.0 * k / directions, massifs.lone);
    if (!view) continue;
    const ViewMeasures measures = measure_view(ground, *view, massifs.anchors, quick);
    ScoreContext context{
        .lone = massifs.lone, .plateau = ground.plateau, .main = -1, .anchors = massifs.anchors};
    // A direction with a leading subject is preferred to one without.
    constexpr double leads = 100.0;
    double score = 0.0;
    if (std::any_of(measures.anchors.begin(), measures.anchors.end(),
                    [](const AnchorSight& a) { return a.inside; })) {
      context.main = leading_anchor(measures, context);
      score = leads;
    }
    score += total(score_terms(measures, context));
    if (!best || score > max) best = view, max = score;
  }
  return best;
}

}  // namespace belvedere
