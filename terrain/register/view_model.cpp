#include "terrain/register/view_model.h"

#include <algorithm>
#include <numbers>

#include "base/statistics.h"

namespace belvedere {
namespace {

namespace unknown = view_unknown;

constexpr double nearest_share = 0.02;  // of L: nearer places count as that far

// A camera's numbers, of any kind of number.
template <class Number>
struct Lens {
  ViewKind kind;
  Number focal, pitch, middle_x, middle_y;
};

template <class Number>
struct Position {
  Number x, y;
};

// A number that is not below its limit; there it is constant.
template <class Number>
Number at_least(const Number& a, double limit) {
  return a.value > limit ? a : Number(limit);
}

template <class Number>
Position<Number> to_pixel(const Lens<Number>& lens, const Number& turn, const Number& tangent) {
  if (lens.kind == ViewKind::cylinder)
    return {lens.middle_x + lens.focal * turn, lens.middle_y - lens.focal * tangent};
  if (lens.kind == ViewKind::panini) {
    const Number scale = lens.focal * Number(2.0) / (Number(1.0) + at_least(cos(turn), -0.9));
    const Number horizon = lens.middle_y + lens.focal * sin(lens.pitch) / cos(lens.pitch);
    return {lens.middle_x + scale * sin(turn), horizon - scale * tangent};
  }
  constexpr double min_depth = 0.05;
  const Number along = cos(lens.pitch), up = sin(lens.pitch);
  const Number depth = at_least(along * cos(turn) + up * tangent, min_depth);
  return {lens.middle_x + lens.focal * sin(turn) / depth,
          lens.middle_y - lens.focal * (along * tangent - up * cos(turn)) / depth};
}

// The turn from the middle and the tangent of elevation of a pixel: x and y are these.
template <class Number>
Position<Number> from_pixel(const Lens<Number>& lens, glm::dvec2 pixel) {
  const Number x = (Number(pixel.x) - lens.middle_x) / lens.focal;
  const Number y = (lens.middle_y - Number(pixel.y)) / lens.focal;
  if (lens.kind == ViewKind::cylinder) return {x, y};
  if (lens.kind == ViewKind::panini) {
    const Number quarter = x * x / Number(4.0);
    const Number cosine = (Number(1.0) - quarter) / (Number(1.0) + quarter);
    const Number scale = Number(2.0) / (Number(1.0) + cosine);
    return {atan2(x / scale, cosine), (y + sin(lens.pitch) / cos(lens.pitch)) / scale};
  }
  const Number ahead = cos(lens.pitch) - y * sin(lens.pitch);
  const Number up = sin(lens.pitch) + y * cos(lens.pitch);
  return {atan2(x, ahead), up / sqrt(x * x + ahead * ahead)};
}

ViewNumber number(const ViewUnknowns& view, std::size_t index) {
  return ViewNumber::unknown(view[index], index);
}

Lens<ViewNumber> lens_of(const ViewFrame& frame, const ViewUnknowns& view) {
  const ViewNumber width(frame.size_px.x);
  return {frame.kind, exp(number(view, unknown::log_focal)), number(view, unknown::pitch),
          ViewNumber(0.5 * frame.size_px.x) + width * number(view, unknown::middle),
          ViewNumber(0.5 * frame.size_px.y) + width * number(view, unknown::middle + 1)};
}

// Within -π…π, with the same derivatives.
ViewNumber wrapped(ViewNumber angle) {
  angle.value = std::remainder(angle.value, 2.0 * std::numbers::pi);
  return angle;
}

struct Direction {
  ViewNumber turn, tangent, distance_m;
};

Direction direction_of(const ViewFrame& frame, const ViewUnknowns& view, glm::dvec2 position,
                       double altitude_m) {
  const ViewNumber extent(frame.extent_m);
  const ViewNumber east =
      ViewNumber(position.x - frame.origin.x) - extent * number(view, unknown::east);
  const ViewNumber north =
      ViewNumber(position.y - frame.origin.y) - extent * number(view, unknown::north);
  const ViewNumber distance =
      at_least(sqrt(east * east + north * north), nearest_share * frame.extent_m);
  const ViewNumber x = distance / extent;
  const ViewNumber log_x = log(x);
  const ViewNumber exaggeration = number(view, unknown::exaggeration) +
                                  number(view, unknown::exaggeration + 1) * log_x +
                                  number(view, unknown::exaggeration + 2) * log_x * log_x;
  ViewNumber drop = number(view, unknown::drop) + number(view, unknown::drop + 1) * x +
                    number(view, unknown::drop + 2) * x * x;
  for (std::size_t k = 0; k < view_knots.size(); ++k) {
    const ViewNumber beyond = at_least(x - ViewNumber(view_knots[k]), 0.0);
    drop = drop + number(view, unknown::bend + k) * beyond * beyond * beyond;
  }
  return {wrapped(atan2(east, north) - number(view, unknown::azimuth)),
          (exaggeration * ViewNumber(altitude_m - frame.valley_m) - drop * extent) / distance,
          distance};
}

}  // namespace

std::string_view view_kind_name(ViewKind kind) {
  switch (kind) {
    case ViewKind::cylinder:
      return "cylindrical";
    case ViewKind::panini:
      return "panini";
    case ViewKind::plane:
      break;
  }
  return "perspective";
}

ViewFrame view_frame(ViewKind kind, glm::dvec2 size_px, bool cropped,
                     std::span<const ControlPair> pairs) {
  ViewFrame frame{.kind = kind, .size_px = size_px, .cropped = cropped};
  glm::dvec2 low = pairs.front().position, high = low;
  std::vector<double> altitudes;
  for (const ControlPair& pair : pairs) {
    frame.origin += pair.position / static_cast<double>(pairs.size());
    low = {std::min(low.x, pair.position.x), std::min(low.y, pair.position.y)};
    high = {std::max(high.x, pair.position.x), std::max(high.y, pair.position.y)};
    altitudes.push_back(pair.altitude_m);
  }
  constexpr double lower = 0.1, min_extent_m = 1.0;
  frame.extent_m = std::max({high.x - low.x, high.y - low.y, min_extent_m});
  frame.valley_m = percentile(altitudes, lower);
  return frame;
}

double view_distance_m(const ViewFrame& frame, const ViewUnknowns& view, glm::dvec2 position) {
  return std::max(exact::hypot(position.x - frame.origin.x - frame.extent_m * view[unknown::east],
                               position.y - frame.origin.y - frame.extent_m * view[unknown::north]),
                  nearest_share * frame.extent_m);
}

std::array<double, 9> tangent_factors(const ViewFrame& frame, double distance_m,
                                      double altitude_m) {
  const double x = distance_m / frame.extent_m;
  const double log_x = exact::log(x);
  const double height = (altitude_m - frame.valley_m) / distance_m;
  std::array<double, 9> out = {height, height * log_x, height * log_x * log_x, -1.0 / x, -1.0, -x};
  for (std::size_t k = 0; k < view_knots.size(); ++k) {
    const double beyond = std::max(x - view_knots[k], 0.0);
    out[6 + k] = -beyond * beyond * beyond / x;
  }
  return out;
}

double view_exaggeration(const ViewFrame& frame, const ViewUnknowns& view, double distance_m) {
  const double log_x = exact::log(std::max(distance_m / frame.extent_m, nearest_share));
  return view[unknown::exaggeration] + view[unknown::exaggeration + 1] * log_x +
         view[unknown::exaggeration + 2] * log_x * log_x;
}

double view_drop_m(const ViewFrame& frame, const ViewUnknowns& view, double distance_m) {
  const double x = distance_m / frame.extent_m;
  double drop = view[unknown::drop] + view[unknown::drop + 1] * x + view[unknown::drop + 2] * x * x;
  for (std::size_t k = 0; k < view_knots.size(); ++k) {
    const double beyond = std::max(x - view_knots[k], 0.0);
    drop += view[unknown::bend + k] * beyond * beyond * beyond;
  }
  return drop * frame.extent_m;
}

ViewPixel project_in_view(const ViewFrame& frame, const ViewUnknowns& view, glm::dvec2 position,
                          double altitude_m, const Displacement& displaced) {
  const Direction to = direction_of(frame, view, position, altitude_m);
  const Position<ViewNumber> at =
      to_pixel(lens_of(frame, view), to.turn + ViewNumber(displaced.lateral_m) / to.distance_m,
               to.tangent + ViewNumber(displaced.upward_m) / to.distance_m);
  return {at.x, at.y};
}

ViewDisplacement displacement_in_view(const ViewFrame& frame, const ViewUnknowns& view,
                                      const ControlPair& pair) {
  const Direction to = direction_of(frame, view, pair.position, pair.altitude_m);
  const Lens<ViewNumber> lens = lens_of(frame, view);
  const Position<ViewNumber> shown = from_pixel(lens, pair.pixel);
  using Two = Dual<2>;
  const Position<Two> pixel =
      to_pixel(Lens<Two>{frame.kind, lens.focal.value, lens.pitch.value, 0.0, 0.0},
               Two::unknown(shown.x.value, 0), Two::unknown(shown.y.value, 1));
  return {to.distance_m * wrapped(shown.x - to.turn),
          to.distance_m * (shown.y - to.tangent),
          {std::abs(pixel.x.slope[0]) / to.distance_m.value,
           std::abs(pixel.y.slope[1]) / to.distance_m.value}};
}

bool is_plausible(const ViewFrame& frame, const ViewUnknowns& view,
                  std::span<const ControlPair> pairs) {
  constexpr double shortest = 0.125, longest = 50.0;  // focal length, in widths
  constexpr double farthest = 10.0;                   // eye, in L
  constexpr double min_px_per_extent = 1.0;
  const double focal = exact::exp(view[unknown::log_focal]) / frame.size_px.x;
  if (!(focal >= shortest && focal <= longest)) return false;
  if (!(exact::hypot(view[unknown::east], view[unknown::north]) <= farthest)) return false;
  return std::all_of(pairs.begin(), pairs.end(), [&](const ControlPair& pair) {
    const ViewDisplacement seen = displacement_in_view(frame, view, pair);
    return std::isfinite(seen.lateral_m.value) && std::isfinite(seen.upward_m.value) &&
           seen.px_per_m.lateral_m * frame.extent_m >= min_px_per_extent &&
           seen.px_per_m.upward_m * frame.extent_m >= min_px_per_extent;
  });
}

std::vector<ViewNumber> view_priors(const ViewFrame& frame, const ViewUnknowns& view) {
  std::vector<ViewNumber> out;
  const auto expect = [&](std::size_t index, double mean, double deviation) {
    out.push_back((number(view, index) - ViewNumber(mean)) / ViewNumber(deviation));
  };
  constexpr double fixed = 1e-3;
  expect(unknown::exaggeration, 1.5, 0.5);
  expect(unknown::exaggeration + 1, 0.0, 0.35);
  expect(unknown::exaggeration + 2, 0.0, 0.12);
  frame.kind == ViewKind::cylinder ? expect(unknown::pitch, 0.0, fixed)
                                   : expect(unknown::pitch, -0.25, 0.12);
  expect(unknown::drop + 2, 0.0, 1.0);
  for (std::size_t k = 0; k < view_knots.size(); ++k) expect(unknown::bend + k, 0.0, 0.4);
  for (std::size_t k = 0; k < 2; ++k) expect(unknown::middle + k, 0.0, frame.cropped ? 0.1 : 1e-6);
  return out;
}

}  // namespace belvedere
