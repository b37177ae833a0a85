#include "renderer/compose/view_score.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"

namespace belvedere {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

// What is good of the place of the anchor in the picture, by its kind.
struct AnchorPlaces {
  Plateau off_middle;  // |x - ½|
  Plateau down;        // y
  Plateau size;
};

AnchorPlaces places_of(AnchorKind kind, double lone) {
  const double want = 0.18 + 0.14 * lone;
  switch (kind) {
    case AnchorKind::canyon:
      return {{-0.06, -0.01, 0.18, 0.40}, {0.08, 0.28, 0.66, 0.90}, {0.03, 0.12, 0.5, 0.8}};
    case AnchorKind::shore:
      return {{-0.06, -0.01, 0.26, 0.45}, {0.12, 0.30, 0.75, 0.95}, {0.04, 0.14, 0.5, 0.8}};
    case AnchorKind::summit:
      break;
  }
  return {{-0.06, 0.08, 0.22, 0.40}, {0.0, 0.05, 0.30, 0.55}, {0.06, want, 0.5, 0.8}};
}

// How much a picture of the anchor is worth beyond what is measured: mountains of mountains, canyons of plateaus.
double worth_of(AnchorKind kind, const ScoreContext& context) {
  switch (kind) {
    case AnchorKind::canyon:
      return 0.6 + 4.4 * context.plateau;
    case AnchorKind::shore:
      return 1.6;
    case AnchorKind::summit:
      break;
  }
  return 2.5 + 4.0 * context.lone - 1.5 * context.plateau;
}

}  // namespace

double plateau(double x, const Plateau& p) {
  if (!(x > p.a) || !(x < p.d)) return 0.0;
  if (x < p.b) return (x - p.a) / (p.b - p.a);
  if (x > p.c) return (p.d - x) / (p.d - p.c);
  return 1.0;
}

double ScoreTerm::points() const {
  if (kind == TermKind::told) return 0.0;
  if (kind == TermKind::plateau) return weight * plateau(value, good);
  return -weight * (std::max(0.0, good.b - value) + std::max(0.0, value - good.c));
}

std::string_view ScoreTerm::advice() const {
  if (weight == 0.0 && kind != TermKind::told) return {};
  // Half way up a ramp is good enough to be left alone; so is a hundredth outside of what costs by its excess.
  constexpr double slack = 0.5, slight = 0.01;
  const double below = kind != TermKind::excess ? good.b - slack * (good.b - good.a) : good.b - slight;
  const double above = kind != TermKind::excess ? good.c + slack * (good.d - good.c) : good.c + (unit == TermUnit::share ? slight : 0.0);
  if (value < below) return too_low;
  if (value > above) return too_high;
  return {};
}

std::vector<ScoreTerm> score_terms(const ViewMeasures& m, const ScoreContext& context) {
  const double lone = context.lone;
  const double alone = unit(2.0 * lone - 1.0);  // of those that are, not of the first among others
  const bool known = context.main >= 0 && static_cast<std::size_t>(context.main) < m.anchors.size();
  const AnchorKind kind = known ? context.anchors[static_cast<std::size_t>(context.main)].kind : AnchorKind::summit;
  const AnchorSight main = known ? m.anchors[static_cast<std::size_t>(context.main)] : AnchorSight{};
  const AnchorPlaces places = places_of(kind, lone);
  const bool summit = kind == AnchorKind::summit;
  const double hidden_share = 0.18;
  const double seen = main.inside ? hidden_share + (1.0 - hidden_share) * std::min(1.0, main.seen / (summit ? 1.0 : 0.7)) : 0.0;
  double tops = 0.0, all = 0.0;
  for (std::size_t i = 0; i < m.anchors.size() && i < context.anchors.size(); ++i) {
    if (context.anchors[i].kind != AnchorKind::summit) continue;
    all += context.anchors[i].rank;
    if (m.anchors[i].inside && m.anchors[i].seen > 0.5) tops += context.anchors[i].rank;
  }
  const double rank = known ? context.anchors[static_cast<std::size_t>(context.main)].rank : 0.0;
  const double place = plateau(std::abs(main.place.x - 0.5), places.off_middle) * plateau(main.place.y, places.down);

  using enum TermKind;
  using enum TermUnit;
  // clang-format off
  return {
      // name, weight, kind, good, unit, measure, meaning, what to say of too little, what of too much. Ramps beside the plateaus are wide, so
      // that a search does not stop as soon as a term is full.
      // A mountain that stands alone breaks the skyline: there is sky to both sides of it, down to its foot.
      {"sky", 8.0, excess, {0, 0.10, 0.19 + 0.08 * alone, 1}, share, m.skyline.mean, "of the picture is above the skyline",
       "little sky: raise the view (camera.tilt_deg above 0)", "much sky: lower the view (camera.tilt_deg below 0) or bend the ground more"},
      {"skyline", 0.8, plateau, {0.0, 0.03, 0.06, 0.13}, share, m.skyline.deviation, "rise and fall of the skyline",
       "the skyline is a straight line: look towards higher mountains", "the skyline falls off: aim at the middle of the mountains"},
      {"hump", 1.2, excess, {0, 0, 0, 1}, share, m.skyline.hump, "how much the skyline is one hump without peaks",
       "", "the skyline is one hump: look at mountains that stand apart, or narrow the view"},
      {"level", 8.0, excess, {0, 0, 0.205 + 0.18 * alone, 1}, share, m.skyline.low, "from the top down to the skyline's lowest places",
       "", "the world falls off at a corner: the data end too near there, or the view is too wide"},
      {"main", 2.2, plateau, {0, 1, 1, never}, share, place * seen, "how well the main subject is placed",
       "the main subject is hidden, at the edge or outside: a summit's place is a third from a side, in the upper third", ""},
      {"subject", worth_of(kind, context), plateau, {0, 1, 1, never}, share, rank, "rank of the main subject in its region",
       "the picture is about a lesser mountain", ""},
      {"size", 1.5 + (summit ? 1.5 * lone : 0.0), plateau, places.size, share, main.inside ? main.size : 0.0, "height of the main subject in the picture",
       "the main subject is small: go nearer, narrow the view or exaggerate more", "the main subject fills the picture: go farther away"},
      {"along", kind == AnchorKind::canyon ? 1.2 + 2.0 * context.plateau : 0.0, plateau, {0.6, 0.95, 1.01, 2.0}, number, main.along,
       "how far the view looks along the canyon", "the view crosses the canyon: look along it", ""},
      {"stands", summit ? 0.8 : 0.0, plateau, {-0.06, 0.05, never, never}, share, m.skyline.median - main.place.y, "of the main summit above the skyline",
       "the main summit does not stand out of the skyline", ""},
      {"tops", 1.0, plateau, {0, 1, 1, never}, share, all > 0.0 ? tops / all : 1.0, "of the region's great summits are seen", "", ""},
      {"forms", 2.0, plateau, {0.02, 0.14, 0.24, 0.45}, share, m.forms, "height of forms in the picture",
       "the land looks flat: exaggerate more, or go nearer", "forms are steeper than painters draw them: exaggerate less"},
      {"ground", 1.5, plateau, {0.20, 0.75, 1.01, 1.3}, share, m.visible_ground, "of the ground in view is seen",
       "mountains hide much ground: bend it more, or look from higher", ""},
      {"floor", 1.0, plateau, {0, 1, never, never}, share, m.floor.visible * std::min(1.0, m.floor.share / 0.02), "of the valley floors in view is open", "", ""},
      // A picture without any is a slope: the first third counts once more, and only what lacks there is told. That ranges hide the valleys
      // behind them is no fault.
      {"valley", 0.5, plateau, {0, 0.3, never, never}, share, m.floor.visible * std::min(1.0, m.floor.share / 0.02), "of the valley floors in view is open",
       "valley floors are hidden: look along a valley, from higher, or bend the ground more", ""},
      {"depth", 0.8, plateau, {0, 1, never, never}, share, m.floor.depth_spread, "valley floor at all distances", "", ""},
      {"across", 0.5, plateau, {0, 1, never, never}, share, m.floor.width_spread, "valley floor from left to right", "", ""},
      {"water", 0.7, plateau, {0.0, 0.02, 0.16, 0.45}, share, m.water, "of the picture is water", "", ""},
      {"ranges", 1.0, plateau, {0.4, 2.0, 4.5, 8.0}, number, m.ranges, "ranges one behind the other",
       "no range stands before another: look across the ridges, or bend the ground less", "too many edges to read: look from higher"},
      {"rise", 1.0, plateau, {-0.3, 0.25, 1.2, 2.5}, number, m.rise, "how much higher the far land is than the near, in reliefs",
       "the land falls away from the viewer: look the other way", ""},
      {"area", 1.6, plateau, {0.02, 0.34 - 0.2 * lone, 1.4, 2.5}, number, m.area, "of the region is in view", "", ""},
      {"angle", 1.0, plateau, {8, 28, 46, 62}, degrees, m.lower_edge.angle_deg, "on the ground at the lower edge",
       "the foreground is seen flat: bend it towards the viewer", "the foreground is seen like a map: bend it less"},
      {"cut", 6.0, excess, {0, 0, 0.04, 1}, share, m.lower_edge.cut, "of the lower edge cuts mountains",
       "", "the lower edge cuts through mountains: let it lie over a valley"},
      {"flat", 2.0, excess, {0, 0, 0.35, 1}, share, m.flat, "of the picture is low ground", "", "much of the picture is plain"},
      // What proposals have by their layout is judged in scenes of other hands alone.
      {"haze", 0.0, told, {0.0, 0.10, 0.40, 0.8}, share, m.haze, "of the air's colour over the land, on the mean",
       "no air between near and far: air.from_m or air.scale_m is too large for this region",
       "the land drowns in haze: air.from_m or air.scale_m is too small for this region"},
      {"empty", 10.0, excess, {0, 0, 0, 1}, share, m.lower_edge.empty, "of the lower edge has no ground", "", "there are no data at the lower edge"},
      {"rim", 6.0, excess, {0, 0, 0.02, 1}, share, m.rim.share, "of the picture lies where the data end", "", "the end of the data is seen"},
      {"rim near", 15.0, excess, {0, 0, 0, 1}, share, m.rim.near_share, "of the picture lies where the data end, near by",
       "", "the data end in the foreground"},
      {"cells", 0.10, excess, {0, 0, 14, 1}, pixels, m.lower_edge.cell_px, "a cell of the data at the lower edge, of a picture 2400 px wide",
       "", "cells of the data will be seen in the foreground: go farther away, or take finer data"},
  };
  // clang-format on
}

double total(const std::vector<ScoreTerm>& terms) {
  double sum = 0.0;
  for (const ScoreTerm& term : terms) sum += term.points();
  return sum;
}

std::string describe_gains(const std::vector<ScoreTerm>& before, const std::vector<ScoreTerm>& after) {
  struct Gain {
    std::size_t term;
    double points;
  };
  std::vector<Gain> gains;
  for (std::size_t i = 0; i < before.size() && i < after.size(); ++i) gains.push_back({i, after[i].points() - before[i].points()});
  std::stable_sort(gains.begin(), gains.end(), [](const Gain& a, const Gain& b) { return a.points > b.points; });
  std::string out;
  constexpr std::size_t most = 2;
  constexpr double least_points = 0.02;
  for (std::size_t k = 0; k < std::min(most, gains.size()) && gains[k].points > least_points; ++k) {
    const ScoreTerm& was = before[gains[k].term];
    const ScoreTerm& is = after[gains[k].term];
    const double unit = is.unit == TermUnit::share ? 100.0 : 1.0;
    const int digits = is.unit == TermUnit::number ? 2 : 0;
    out += fmt::format("{}{} {:.{}f} to {:.{}f}{}", out.empty() ? "" : ", ", is.name, unit * was.value, digits, unit * is.value, digits,
                       is.unit == TermUnit::share     ? " %"
                       : is.unit == TermUnit::degrees ? "°"
                       : is.unit == TermUnit::pixels  ? " px"
                                                      : "");
  }
  return out.empty() ? "a little of everything" : out;
}

int leading_anchor(const ViewMeasures& measures, ScoreContext context) {
  int best = 0;
  double most = -never;
  for (std::size_t i = 0; i < context.anchors.size() && i < measures.anchors.size(); ++i) {
    if (!measures.anchors[i].inside) continue;
    context.main = static_cast<int>(i);
    if (const double points = total(score_terms(measures, context)); points > most) most = points, best = context.main;
  }
  return best;
}

double merit(const std::vector<ScoreTerm>& terms, const ScoreContext& context) {
  // The most that a picture of the region can have, whatever it is about; so that figures of two views can be compared.
  double most = 0.0;
  for (const AnchorKind kind : {AnchorKind::summit, AnchorKind::canyon, AnchorKind::shore}) {
    ViewMeasures any;
    any.anchors.resize(1);
    ScoreContext about = context;
    about.main = 0;
    about.anchors.assign(1, Anchor{.kind = kind});
    double points = 0.0;
    for (const ScoreTerm& term : score_terms(any, about)) points += term.most();
    most = std::max(most, points);
  }
  return std::clamp(10.0 * total(terms) / most, 0.0, 10.0);
}

}  // namespace belvedere
