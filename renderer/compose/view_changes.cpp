#include "renderer/compose/view_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "base/progress.h"
#include "renderer/compose/view_shape.h"
#include "terrain/generalize/widen_valleys.h"

namespace belvedere {

CoarseGround widened_ground(const CoarseGround& ground, double width_m) {
  Grid<float> altitude(ground.cells.width(), ground.cells.height());
  Grid<std::uint8_t> lakes(altitude.width(), altitude.height(), 0);
  for (std::size_t i = 0; i < altitude.size(); ++i) {
    altitude[i] = ground.cells[i].altitude_m;
    lakes[i] = ground.cells[i].water ? 1 : 0;
  }
  WidenValleysParameters parameters;
  parameters.width_m = static_cast<float>(width_m);
  Raster<float> raster{
      widen_valleys(altitude, lakes, {}, ground.cell_m, parameters, silent_progress()).altitude_m,
      ground.transform, ground.crs};
  for (std::size_t i = 0; i < altitude.size(); ++i)
    if (!ground.cells[i].known) raster.cells[i] = std::numeric_limits<float>::quiet_NaN();
  CoarseGround out = make_coarse_ground(std::move(raster), ground.source_cell_m);
  for (std::size_t i = 0; i < altitude.size(); ++i) {
    out.cells[i].water = ground.cells[i].water;
    out.cells[i].rim_m = ground.cells[i].rim_m;
  }
  out.side_m = ground.side_m;
  out.void_share = ground.void_share;
  out.low_m = ground.low_m;
  out.upper_m = ground.upper_m;
  out.relief_m = ground.relief_m;
  out.plateau = ground.plateau;
  return out;
}

CoarseGround raised_ground(const CoarseGround& ground,
                           const std::vector<SummitExaggeration>& summits) {
  DeformParameters change;
  change.summits = summits;
  const Deformation deformation(change, {0.0, 0.0});
  CoarseGround out = ground;
  parallel_rows(out.cells.height(), [&](int y) {
    for (int x = 0; x < out.cells.width(); ++x) {
      GroundCell& cell = out.cells(x, y);
      const auto before = static_cast<double>(cell.altitude_m);
      const double rise = deformation.rearranged({out.transform.to_crs(x, y), before}).z - before;
      cell.altitude_m = static_cast<float>(before + rise);
      cell.above_m = static_cast<float>(static_cast<double>(cell.above_m) + rise);
    }
  });
  return out;
}

namespace {

// Points of the score, of about 15, that a change must gain.
constexpr double wide_wins = 0.20;
constexpr double summit_wins = 0.25;
constexpr double widest_m = 2000.0;

std::vector<SummitExaggeration> raised(const ViewChanges& changes) {
  std::vector<SummitExaggeration> out;
  for (const RaisedSummit& summit : changes.summits) out.push_back(summit.by);
  return out;
}

// The region's anchors, with their changed heights.
Massifs raised_anchors(const Massifs& massifs, const ViewChanges& changes) {
  Massifs out = massifs;
  for (const RaisedSummit& summit : changes.summits) {
    Anchor& anchor = out.anchors[static_cast<std::size_t>(summit.anchor)];
    const double more =
        (summit.by.factor - 1.0) * std::max(0.0, anchor.altitude_m - summit.by.base_m);
    anchor.altitude_m += more;
    anchor.stands_m += more;
  }
  return out;
}

std::optional<Candidate> judge_changed(const ViewSearch& search, const CoarseGround& ground,
                                       const ViewChanges& changes, const ViewPlan& plan) {
  const Massifs massifs = raised_anchors(search.massifs, changes);
  std::optional<Candidate> out = judge({ground, massifs, search.request}, plan);
  if (out) out->changes = changes;
  return out;
}

// The summits of a view that may be raised: the first of the region that are in the picture.
std::vector<int> summits_in(const ViewSearch& search, const Candidate& view) {
  constexpr std::size_t max = 3;
  std::vector<int> out;
  for (std::size_t i = 0; i < search.massifs.anchors.size() && out.size() < max; ++i)
    if (search.massifs.anchors[i].kind == AnchorKind::summit && view.measures.anchors[i].inside)
      out.push_back(static_cast<int>(i));
  return out;
}

bool is_raised(const Candidate& view, int anchor) {
  const std::vector<RaisedSummit>& done = view.changes.summits;
  return std::any_of(done.begin(), done.end(),
                     [&](const RaisedSummit& s) { return s.anchor == anchor; });
}

// The view with the one more summit that gains most, or unchanged.
Candidate with_a_summit(const ViewSearch& search, const CoarseGround& ground,
                        const Candidate& from) {
  Candidate best = from;
  for (const int anchor : summits_in(search, from)) {
    if (is_raised(from, anchor)) continue;
    const Anchor& summit = search.massifs.anchors[static_cast<std::size_t>(anchor)];
    for (const double factor : {1.15, 1.3}) {
      ViewChanges changes = from.changes;
      changes.summits.push_back(
          {.anchor = anchor, .by = raise_of(summit, from.view, factor), .gain = {}});
      std::optional<Candidate> next =
          judge_changed(search, raised_ground(ground, raised(changes)), changes, from.plan);
      if (!next || next->score < from.score + summit_wins || next->score <= best.score) continue;
      best = std::move(*next);
      best.changes.summits.back().gain = {.merit = best.merit - from.merit,
                                          .words = describe_gains(from.terms, best.terms)};
    }
  }
  return best;
}

}  // namespace

SummitExaggeration raise_of(const Anchor& summit, const ViewShape& view, double factor) {
  constexpr double reach = 0.10, upper_part = 0.3;
  return {.centre = {std::round(summit.position.x), std::round(summit.position.y)},
          .radius_m = rounded_m(reach * view.far_m),
          .factor = factor,
          .base_m = std::round(view.base_m + upper_part * (summit.altitude_m - view.base_m))};
}

std::vector<WideGround> widen_grounds(const CoarseGround& ground) {
  std::vector<WideGround> out;
  for (const double share : {0.006, 0.012}) {  // of the side
    const double width_m =
        std::min(std::max(1.0, std::round(share * ground.side_m / 50.0)) * 50.0, widest_m);
    out.push_back({width_m, widened_ground(ground, width_m)});
  }
  return out;
}

Candidate with_changes(const ViewSearch& search, const std::vector<WideGround>& wide,
                       const Candidate& from) {
  Candidate best = from;
  const CoarseGround* ground = &search.ground;
  for (const WideGround& tried : wide) {
    ViewChanges changes = from.changes;
    changes.widen_valleys_m = tried.width_m;
    std::optional<Candidate> next = judge_changed(search, tried.ground, changes, from.plan);
    if (!next || next->score < from.score + wide_wins || next->score <= best.score) continue;
    best = std::move(*next);
    best.changes.widened = {.merit = best.merit - from.merit,
                            .words = describe_gains(from.terms, best.terms)};
    ground = &tried.ground;
  }
  constexpr int max_summits = 2;
  for (int k = 0; k < max_summits; ++k) best = with_a_summit(search, *ground, best);
  ViewChanges changes = best.changes;
  if (changes.widen_valleys_m == 0.0 && changes.summits.empty()) return best;
  // On the changed ground a slightly different view may be better.
  const CoarseGround changed = raised_ground(*ground, raised(changes));
  const Massifs massifs = raised_anchors(search.massifs, changes);
  Candidate out = resolve({changed, massifs, search.request}, best);
  (changes.widen_valleys_m > 0.0 ? changes.widened : changes.summits.back().gain).merit +=
      out.merit - best.merit;
  out.changes = std::move(changes);
  return out;
}

std::string describe_changes(const ViewSearch& search, const Candidate& candidate) {
  std::vector<std::string> out;
  const ViewChanges& changes = candidate.changes;
  if (changes.widen_valleys_m > 0.0)
    out.push_back(fmt::format("valleys {:.0f} m wider improve {}", changes.widen_valleys_m,
                              changes.widened.words));
  for (const RaisedSummit& summit : changes.summits)
    out.push_back(fmt::format(
        "{} raised by {:.2f} improves {}",
        describe_anchor(search.massifs.anchors[static_cast<std::size_t>(summit.anchor)]),
        summit.by.factor, summit.gain.words));
  return fmt::format("{}", fmt::join(out, "; "));
}

}  // namespace belvedere
