#include "renderer/compose/view_score.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"

namespace belvedere {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

// Good values of the anchor's position in the picture, by its kind.
struct AnchorPlaces {
  Plateau off_centre;  // |x - ½|
  Plateau down;        // y
  Plateau size;
};

AnchorPlaces positions_of(AnchorKind kind, double lone) {
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

// Bonus of a kind of anchor beyond what is measured: mountains in mountainous regions, canyons in
// plateaus.
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
  // Half way up a ramp is good enough to need no advice, and so is 0.01 outside a range with a cost
  // by excess.
  constexpr double slack = 0.5, slight = 0.01;
  const double below =
      kind != TermKind::excess ? good.b - slack * (good.b - good.a) : good.b - slight;
  const double above = kind != TermKind::excess ? good.c + slack * (good.d - good.c)
                                                : good.c + (unit == TermUnit::share ? slight : 0.0);
  if (value < below) return too_low;
  if (value > above) return too_high;
  return {};
}

std::vector<ScoreTerm> score_terms(const ViewMeasures& m, const ScoreContext& context) {
  const double lone = context.lone;
  const double alone = unit(2.0 * lone - 1.0);  // of lone mountains, not of the first among others
  const bool known = context.main >= 0 && static_cast<std::size_t>(context.main) < m.anchors.size();
  const AnchorKind kind =
      known ? context.anchors[static_cast<std::size_t>(context.main)].kind : AnchorKind::summit;
  const AnchorSight main =
      known ? m.anchors[static_cast<std::size_t>(context.main)] : AnchorSight{};
  const AnchorPlaces positions = positions_of(kind, lone);
  const bool summit = kind == AnchorKind::summit;
  const double hidden_share = 0.18;
  const double seen =
      main.inside
          ? hidden_share + (1.0 - hidden_share) * std::min(1.0, main.seen / (summit ? 1.0 : 0.7))
          : 0.0;
  double tops = 0.0, all = 0.0;
  for (std::size_t i = 0; i < m.anchors.size() && i < context.anchors.size(); ++i) {
    if (context.anchors[i].kind != AnchorKind::summit) continue;
    all += context.anchors[i].rank;
    if (m.anchors[i].inside && m.anchors[i].seen > 0.5) tops += context.anchors[i].rank;
  }
  const double rank = known ? context.anchors[static_cast<std::size_t>(context.main)].rank : 0.0;
  const double position = plateau(std::abs(main.position.x - 0.5), positions.off_centre) *
                          plateau(main.position.y, positions.down);

  using enum TermKind;
  using enum TermUnit;
  // clang-format off
  return {
      // name, weight, kind, good, unit, measure, meaning (printed after the value), advice where
      // the value is too small, advice where it is too large. Ramps beside the plateaus are wide,
      // so that a search does not stop as soon as a term is full.
      // A mountain that stands alone interrupts the skyline: there is sky on both sides of it, down
      // to its foot.
      {"sky", 8.0, excess, {0, 0.10, 0.19 + 0.08 * alone, 1}, share, m.skyline.mean,
       "of the picture is above the skyline",
       "little sky: raise the view (camera.tilt_deg above 0)",
       "much sky: lower the view (camera.tilt_deg below 0) or bend the ground more"},
      {"skyline", 0.8, plateau, {0.0, 0.03, 0.06, 0.13}, share, m.skyline.deviation,
       "of the picture's height: rise and fall of the skyline",
       "the skyline is a straight line: look towards higher mountains",
       "the skyline falls off to a side: aim at the centre of the mountains"},
      {"hump", 1.2, excess, {0, 0, 0, 1}, share, m.skyline.hump,
       "on the scale from separate peaks to one smooth hump", "",
       "the skyline is one hump: look at mountains that stand apart, or narrow the view"},
      {"level", 8.0, excess, {0, 0, 0.205 + 0.18 * alone, 1}, share, m.skyline.low,
       "of the picture's height lies above the lowest parts of the skyline", "",
       "the ground falls off at a corner: the data end too near there, or the view is too wide"},
      {"main", 2.2, plateau, {0, 1, 1, never}, share, position * seen,
       "of the score for the position of the main subject",
       "the main subject is hidden, at the edge or outside: a summit belongs a third from a side, "
       "in the upper third",
       ""},
      {"subject", worth_of(kind, context), plateau, {0, 1, 1, never}, share, rank,
       "of the rank of the region's best subject", "the picture is about a lesser mountain", ""},
      {"size", 1.5 + (summit ? 1.5 * lone : 0.0), plateau, positions.size, share,
       main.inside ? main.size : 0.0, "of the picture's height: the main subject",
       "the main subject is small: go nearer, narrow the view or exaggerate more",
       "the main subject fills the picture: go farther away"},
      {"along", kind == AnchorKind::canyon ? 1.2 + 2.0 * context.plateau : 0.0, plateau,
       {0.6, 0.95, 1.01, 2.0}, number, main.along,
       "on a scale from 0, across the canyon, to 1, along it",
       "the view crosses the canyon: look along it", ""},
      {"stands", summit ? 0.8 : 0.0, plateau, {-0.06, 0.05, never, never}, share,
       m.skyline.median - main.position.y,
       "of the picture's height: the main summit above the skyline",
       "the main summit does not rise above the skyline", ""},
      {"tops", 1.0, plateau, {0, 1, 1, never}, share, all > 0.0 ? tops / all : 1.0,
       "of the region's great summits are visible", "", ""},
      {"forms", 2.0, plateau, {0.02, 0.14, 0.24, 0.45}, share, m.forms,
       "of the picture's height: landforms above their valleys",
       "the land looks flat: exaggerate more, or go nearer",
       "forms are steeper than in painted panoramas: exaggerate less"},
      {"ground", 1.5, plateau, {0.20, 0.75, 1.01, 1.3}, share, m.visible_ground,
       "of the ground in view is visible",
       "mountains hide much ground: bend it more, or look from higher", ""},
      {"floor", 1.0, plateau, {0, 1, never, never}, share,
       m.floor.visible * std::min(1.0, m.floor.share / 0.02),
       "of the valley floors in view is visible", "", ""},
      // A picture without any valley floor shows only slopes: the first third counts once more, and
      // only what lacks there is advised. Valleys hidden behind ranges are no fault.
      {"valley", 0.5, plateau, {0, 0.3, never, never}, share,
       m.floor.visible * std::min(1.0, m.floor.share / 0.02),
       "of the valley floors in view is visible",
       "valley floors are hidden: look along a valley, from higher, or bend the ground more", ""},
      {"depth", 0.8, plateau, {0, 1, never, never}, share, m.floor.depth_spread,
       "evenness of valley floor over distance", "", ""},
      {"across", 0.5, plateau, {0, 1, never, never}, share, m.floor.width_spread,
       "evenness of valley floor from left to right", "", ""},
      {"water", 0.7, plateau, {0.0, 0.02, 0.16, 0.45}, share, m.water,
       "of the picture is water", "", ""},
      {"ranges", 1.0, plateau, {0.4, 2.0, 4.5, 8.0}, number, m.ranges, "ranges one behind another",
       "no range stands in front of another: look across the ridges, or bend the ground less",
       "too many edges to read: look from higher"},
      {"rise", 1.0, plateau, {-0.3, 0.25, 1.2, 2.5}, number, m.rise,
       "times the region's relief: height of the far land above the near",
       "the land falls away from the viewer: look the other way", ""},
      {"area", 1.6, plateau, {0.02, 0.34 - 0.2 * lone, 1.4, 2.5}, number, m.area,
       "times the region's area is in view", "", ""},
      {"angle", 1.0, plateau, {8, 28, 46, 62}, degrees, m.lower_edge.angle_deg,
       "between the line of sight and the ground at the lower edge",
       "the foreground looks flat: bend it towards the viewer",
       "the foreground looks like a map: bend it less"},
      {"cut", 6.0, excess, {0, 0, 0.04, 1}, share, m.lower_edge.cut,
       "of the lower edge cuts through mountains", "",
       "the lower edge cuts through mountains: move it to a valley"},
      {"flat", 2.0, excess, {0, 0, 0.35, 1}, share, m.flat, "of the picture is low ground", "",
       "much of the picture is a plain"},
      // Proposals satisfy these by their layout; they are evaluated in other scenes only.
      {"haze", 0.0, told, {0.0, 0.10, 0.40, 0.8}, share, m.haze, "haze over the land, on average",
       "no haze between near and far: air.from_m or air.scale_m is too large for this region",
       "too much haze over the land: air.from_m or air.scale_m is too small for this region"},
      {"empty", 10.0, excess, {0, 0, 0, 1}, share, m.lower_edge.empty,
       "of the lower edge has no ground", "", "there are no data at the lower edge"},
      {"rim", 6.0, excess, {0, 0, 0.02, 1}, share, m.rim.share,
       "of the picture shows the end of the data", "", "the end of the data is visible"},
      {"rim near", 15.0, excess, {0, 0, 0, 1}, share, m.rim.near_share,
       "of the picture shows the end of the data in the foreground", "",
       "the data end in the foreground"},
      {"cells", 0.10, excess, {0, 0, 14, 1}, pixels, m.lower_edge.cell_px,
       "per cell of the data at the lower edge, in a picture 2400 px wide", "",
       "cells of the data will be visible in the foreground: go farther away, or take finer data"},
  };
  // clang-format on
}

double total(const std::vector<ScoreTerm>& terms) {
  double sum = 0.0;
  for (const ScoreTerm& term : terms) sum += term.points();
  return sum;
}

std::string describe_gains(const std::vector<ScoreTerm>& before,
                           const std::vector<ScoreTerm>& after) {
  struct Gain {
    std::size_t term;
    double points;
  };
  std::vector<Gain> gains;
  for (std::size_t i = 0; i < before.size() && i < after.size(); ++i)
    gains.push_back({i, after[i].points() - before[i].points()});
  std::stable_sort(gains.begin(), gains.end(),
                   [](const Gain& a, const Gain& b) { return a.points > b.points; });
  std::string out;
  constexpr std::size_t max = 2;
  constexpr double min_points = 0.02;
  for (std::size_t k = 0; k < std::min(max, gains.size()) && gains[k].points > min_points; ++k) {
    const ScoreTerm& was = before[gains[k].term];
    const ScoreTerm& is = after[gains[k].term];
    const double unit = is.unit == TermUnit::share ? 100.0 : 1.0;
    const int digits = is.unit == TermUnit::number ? 2 : 0;
    out += fmt::format("{}{} {:.{}f} to {:.{}f}{}", out.empty() ? "" : ", ", is.name,
                       unit * was.value, digits, unit * is.value, digits,
                       is.unit == TermUnit::share     ? " %"
                       : is.unit == TermUnit::degrees ? "°"
                       : is.unit == TermUnit::pixels  ? " px"
                                                      : "");
  }
  return out.empty() ? "a little of everything" : out;
}

int leading_anchor(const ViewMeasures& measures, ScoreContext context) {
  int best = 0;
  double max = -never;
  for (std::size_t i = 0; i < context.anchors.size() && i < measures.anchors.size(); ++i) {
    if (!measures.anchors[i].inside) continue;
    context.main = static_cast<int>(i);
    if (const double points = total(score_terms(measures, context)); points > max)
      max = points, best = context.main;
  }
  return best;
}

double merit(const std::vector<ScoreTerm>& terms, const ScoreContext& context) {
  // The maximum score of a picture of the region, for any subject, so that merits of two views can
  // be compared.
  double max = 0.0;
  for (const AnchorKind kind : {AnchorKind::summit, AnchorKind::canyon, AnchorKind::shore}) {
    ViewMeasures any;
    any.anchors.resize(1);
    ScoreContext about = context;
    about.main = 0;
    about.anchors.assign(1, Anchor{.kind = kind});
    double points = 0.0;
    for (const ScoreTerm& term : score_terms(any, about)) points += term.max();
    max = std::max(max, points);
  }
  return std::clamp(10.0 * total(terms) / max, 0.0, 10.0);
}

std::string measure_text(const ScoreTerm& term) {
  switch (term.unit) {
    case TermUnit::share:
      return fmt::format("{:.0f} %", 100.0 * term.value);
    case TermUnit::degrees:
      return fmt::format("{:.0f}°", term.value);
    case TermUnit::pixels:
      return fmt::format("{:.0f} px", term.value);
    case TermUnit::number:
      break;
  }
  return fmt::format("{:.1f}", term.value);
}

}  // namespace belvedere
