#include "renderer/register/register_by_paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/filter.h"
#include "base/math_exact.h"
#include "renderer/image/rows/picture_rows.h"
#include "renderer/register/match_paint.h"
#include "renderer/register/registered_ground.h"
#include "terrain/generalize/widen_valleys.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {

glm::dvec2 DrawnGround::drawn_position(glm::dvec2 position) const {
  if (goes_to.empty()) return position;
  const glm::dvec2 cell = drawn_cell(goes_to, dem.transform.to_cell(position.x, position.y));
  return dem.transform.to_crs(cell.x, cell.y);
}

ControlPair DrawnGround::drawn(ControlPair pair) const {
  if (goes_to.empty()) return pair;
  pair.position = drawn_position(pair.position);
  const glm::dvec2 cell = dem.transform.to_cell(pair.position.x, pair.position.y);
  pair.altitude_m = static_cast<double>(sample_bilinear(dem.altitude_m, cell.x, cell.y));
  return pair;
}

std::vector<ControlPair> DrawnGround::drawn(std::span<const ControlPair> pairs) const {
  std::vector<ControlPair> out;
  for (const ControlPair& pair : pairs) out.push_back(drawn(pair));
  return out;
}

DrawnGround draw_ground(const Dem& dem, double valleys_m, Progress& progress) {
  DrawnGround out{.valleys_m = valleys_m, .dem = dem};
  if (valleys_m <= 0.0) return out;
  WidenedValleys wide =
      widen_valleys(dem.altitude_m, find_lakes(dem.altitude_m, {}), {}, dem.cell_m(),
                    {.width_m = static_cast<float>(valleys_m)}, progress);
  out.dem.altitude_m = std::move(wide.altitude_m);
  out.goes_to = std::move(wide.goes_to);
  return out;
}

namespace {

struct Round {
  int width_px = 600;  // of the pictures that are compared
  MatchPaintParameters match;
};
constexpr std::array<Round, 3> rounds = {
    {{400, {.half_px = 20, .reach_px = {15, 12}, .spacing_px = 18, .prior_px = 4.0}},
     {600, {.half_px = 22, .reach_px = {15, 12}, .spacing_px = 23, .prior_px = 4.0}},
     {600, {.half_px = 17, .reach_px = {11, 9}, .spacing_px = 20, .prior_px = 3.0}}}};

glm::ivec2 reduced_size(glm::ivec2 painting_px, int width_px) {
  return {width_px, std::max(1, width_px * painting_px.y / painting_px.x)};
}

// 50 px² of a painting 1200 px wide: a stroke.
double independent_px2(int width_px) { return 50.0 * (width_px / 1200.0) * (width_px / 1200.0); }

std::vector<PaintedPlace> painted_places(const std::vector<PaintMatch>& matches,
                                         const RegisteredGround& ground, double px) {
  std::vector<PaintedPlace> out;
  constexpr double min_sigma_px = 2.5;  // of 1200: forests overhang the ground that they stand on
  for (const PaintMatch& match : matches) {
    PaintedPlace painted;
    painted.place.pixel = px * (glm::dvec2(match.pixel) + 0.5 + match.shift_px);
    painted.place.position = ground.position(match.pixel.x, match.pixel.y);
    painted.place.altitude_m = static_cast<double>(ground.altitude_m(match.pixel.x, match.pixel.y));
    const double min_px = min_sigma_px * px * ground.altitude_m.width() / 1200.0;
    painted.sigma_px = {exact::hypot(px * match.sigma_px.x, min_px),
                        exact::hypot(px * match.sigma_px.y, min_px)};
    out.push_back(painted);
  }
  return out;
}

// How well the paint shows the registered ground, if that is it.
class ValleyEvidence {
 public:
  ValleyEvidence(const Registration& registration, const Grid<glm::vec3>& painting,
                 Progress& progress)
      : registration_(registration),
        painting_px_(painting.width(), painting.height()),
        paint_(reduced_oklab(painting, reduced_size(painting_px_, width_px))),
        progress_(progress) {}

  Grid<double> of(const DrawnGround& ground) const {
    MatchPaintParameters parameters{
        .half_px = 10, .reach_px = {3, 3}, .spacing_px = 10, .prior_px = 2.0};
    parameters.independent_px2 = independent_px2(width_px);
    const RegisteredView view(registration_, registered_scene(registration_, painting_px_),
                              ground.dem, {paint_.width(), paint_.height()}, progress_);
    return paint_evidence(paint_, trace_registered(view), parameters);
  }

 private:
  static constexpr int width_px = 400;
  const Registration& registration_;
  glm::ivec2 painting_px_;
  Grid<glm::vec3> paint_;
  Progress& progress_;
};

// By how much `other` shows better, where both have ground.
double gained_evidence(const Grid<double>& one, const Grid<double>& other) {
  double sum = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i)
    if (!std::isnan(one[i]) && !std::isnan(other[i])) sum += other[i] - one[i];
  return sum;
}

// The ground whose valleys are as wide as the paint shows best; as on the map unless another is
// clearly likelier: first by 300 m, and if so by 150 and 450 m too.
DrawnGround likeliest_ground(const Registration& registration, const Grid<glm::vec3>& painting,
                             const DrawnGround& map, Progress& progress) {
  constexpr double min_gain = 8.0;
  constexpr std::array<double, 3> valleys_m = {300.0, 150.0, 450.0};
  const ValleyEvidence evidence(registration, painting, progress);
  const Grid<double> of_map = evidence.of(map);
  DrawnGround best = map;
  double best_gain = min_gain;
  for (const double width : valleys_m) {
    DrawnGround wide = draw_ground(map.dem, width, progress);
    if (wide.goes_to.empty()) break;
    const double gain = gained_evidence(of_map, evidence.of(wide));
    if (gain > best_gain) {
      best = std::move(wide);
      best_gain = gain;
    } else if (width == valleys_m.front()) {
      break;
    }
  }
  return best;
}

}  // namespace

PaintRegistration register_by_paint(const Registration& from_pairs,
                                    std::span<const ControlPair> pairs,
                                    const Grid<glm::vec3>& painting, const Dem& dem,
                                    Progress& progress) {
  PaintRegistration out{.registration = from_pairs};
  const glm::ivec2 painting_px(painting.width(), painting.height());
  DrawnGround ground = draw_ground(dem, 0.0, progress);
  out.ground = ground;
  for (const Round& round : rounds) {
    const int width = round.width_px;
    if (painting.width() < width) continue;
    const bool first = &round == &rounds.front();
    const glm::ivec2 size = reduced_size(painting_px, width);
    const double px = static_cast<double>(painting.width()) / width;
    RegisteredGround seen = trace_registered(
        RegisteredView(out.registration, registered_scene(out.registration, painting_px),
                       ground.dem, size, progress));
    for (float& sigma : seen.sigma_px) sigma /= static_cast<float>(px);
    MatchPaintParameters parameters = round.match;
    parameters.independent_px2 = independent_px2(width);
    const std::vector<PaintMatch> matches =
        match_paint(reduced_oklab(painting, size), seen, parameters);
    constexpr std::size_t min_matches = 8;
    if (matches.size() < min_matches) continue;
    Registration start = out.registration;
    start.valleys_m = ground.valleys_m;
    std::optional<Registration> better =
        refine_registration(start, ground.drawn(pairs), painted_places(matches, seen, px));
    if (better) {
      out.registration = *std::move(better);
      out.matches = matches.size();
      ++out.rounds;
      out.ground = ground;
    }
    if (first) ground = likeliest_ground(out.registration, painting, ground, progress);
  }
  return out;
}

}  // namespace belvedere
