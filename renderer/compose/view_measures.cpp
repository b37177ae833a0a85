#include "renderer/compose/view_measures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

constexpr double hidden = 99.0;        // a depression below all
constexpr double lowest_share = 0.96;  // of the skyline, which is higher than its low parts
constexpr double lowest_seen = 3.0;    // tangent: what lies deeper is below the picture

double unit_height(double y) { return std::clamp(y, 0.0, 1.0); }

// Sums over the picture; a share is of the columns that show ground.
struct Sums {
  double columns = 0.0;
  double rim = 0.0, rim_near = 0.0, floor = 0.0, water = 0.0, flat = 0.0, forms = 0.0, haze = 0.0,
         all = 0.0;
  std::array<double, 4> floor_by_depth{};
  std::array<double, 3> floor_by_third{};
  double area = 0.0, area_seen = 0.0, area_floor = 0.0, area_floor_seen = 0.0;
  double jumps = 0.0;
  double edge_columns = 0.0, edge_empty = 0.0, edge_cut = 0.0;
};

struct Subject {  // canyon or shore: its cells within the radius of the anchor
  double area = 0.0, seen = 0.0;
};

double mean_of(const std::vector<double>& v, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) sum += v[i];
  return to > from ? sum / static_cast<double>(to - from) : 0.0;
}

SkylineMeasures measure_skyline(const std::vector<double>& heights) {
  SkylineMeasures out;
  if (heights.empty()) return out;
  out.low = percentile(heights, lowest_share);
  out.median = percentile(heights, 0.5);
  out.summit = *std::min_element(heights.begin(), heights.end());
  out.mean = mean_of(heights, 0, heights.size());
  double sum = 0.0;
  for (const double y : heights) sum += square(y - out.mean);
  out.deviation = std::sqrt(sum / static_cast<double>(heights.size()));
  out.hump = hump_of(heights);
  return out;
}

// Finds what the lower edge cuts, followed outwards: it cuts a mountain where the ground on it is
// high above its valleys, whose floor is then outside, and rises farther into the picture.
// Plateaus, and slopes that fall away from the viewer, begin there.
class EdgeForm {
 public:
  explicit EdgeForm(const CoarseGround& ground) : ground_(ground) {}
  void begin(const GroundCell& c, double distance_m) {
    edge_m_ = top_m_ = static_cast<double>(c.altitude_m);
    from_m_ = distance_m;
    high_ = static_cast<double>(c.above_m) > 0.40 * ground_.relief_m;
    follows_ = true;
  }
  // The next ground: until it lies lower than the edge, or so far away that it is another mountain.
  void go_on(double altitude_m, double distance_m) {
    constexpr double lower = 0.05, reach = 0.10;  // of the relief, of the side
    follows_ = follows_ && altitude_m > edge_m_ - lower * ground_.relief_m &&
               distance_m < from_m_ + reach * ground_.side_m;
    if (follows_) top_m_ = std::max(top_m_, altitude_m);
  }
  bool cuts() const { return high_ && top_m_ - edge_m_ > 0.10 * ground_.relief_m; }

 private:
  const CoarseGround& ground_;
  double edge_m_ = 0.0, top_m_ = 0.0, from_m_ = 0.0;
  bool high_ = false, follows_ = false;
};

// The position of a point at a height, and whether ground in front hides it.
AnchorSight sight_of(const CoarseGround& ground, const SightModel& sight, const Anchor& anchor) {
  AnchorSight out;
  const glm::dvec2 away = anchor.position - sight.viewer;
  const double distance = std::sqrt(away.x * away.x + away.y * away.y);
  out.distance_m = distance;
  if (distance < 1.0) return out;
  const auto index = [&](double d) {
    const auto above = std::upper_bound(sight.distance_m.begin(), sight.distance_m.end(), d);
    return std::clamp<std::ptrdiff_t>(above - sight.distance_m.begin() - 1, 0,
                                      static_cast<std::ptrdiff_t>(sight.distance_m.size()) - 2);
  };
  const auto between = [&](const std::vector<double>& v, double d) {
    const auto i = static_cast<std::size_t>(index(d));
    const double t = (d - sight.distance_m[i]) / (sight.distance_m[i + 1] - sight.distance_m[i]);
    return v[i] + t * (v[i + 1] - v[i]);
  };
  const auto depression = [&](double altitude_m, double d) {
    const double z = sight.base_m + between(sight.exaggeration, d) * (altitude_m - sight.base_m);
    return (sight.eye_m - z + between(sight.drop_m, d)) / d;
  };
  const glm::dvec2 on_map = away / distance;
  const glm::dvec2 direction = to_map(on_map, -sight.azimuth_deg);
  const double own = depression(anchor.altitude_m, distance);
  out.position = sight.picture.position(direction, own);
  out.inside = out.position.x >= 0.0 && out.position.x <= 1.0 && out.position.y >= 0.0 &&
               out.position.y <= 1.0;
  out.size = between(sight.exaggeration, distance) * anchor.stands_m / (distance * sight.height);
  out.along = std::abs(on_map.x * anchor.along.x + on_map.y * anchor.along.y);
  if (!out.inside) return out;
  constexpr int steps = 80;
  out.seen = 1.0;
  for (int k = 0; k < steps; ++k) {
    const double d = distance * (0.3 + 0.685 * k / (steps - 1));
    const GroundCell* c = ground.at(sight.viewer + d * on_map);
    if (c != nullptr && c->known && depression(static_cast<double>(c->altitude_m), d) < own)
      out.seen = 0.0;
  }
  return out;
}

// Ground in near and far parts of the depth, whose altitudes are compared: weights by distance.
struct MeanAltitude {
  double sum = 0.0, weight = 0.0;
  void add(double altitude_m, double distance_m) {
    sum += distance_m * altitude_m, weight += distance_m;
  }
};

// Sums over the lines of sight.
struct SeenView {
  Sums sums;
  std::vector<Subject> subjects;  // of the anchors
  std::vector<double> skyline;    // of the columns whose level line lies in the picture
  MeanAltitude near, far;
};

// A sample of a line of sight inside the picture.
struct SeenSample {
  const GroundCell& cell;
  std::size_t step;  // along the line
  double distance_m;
  double depth;       // 0 at the lower edge, 1 at the horizon
  glm::dvec2 on_map;  // the line's direction
  glm::dvec2 at;      // in the picture
  bool seen;
};

// Ground between lower edge and horizon, visible or not. Samples lie at equal ratios, so each
// represents an area that grows with d².
void add_ground(SeenView& view, const CoarseGround& ground, const SightModel& sight,
                const std::vector<Anchor>& anchors, const SeenSample& sample) {
  const double subject_reach = 0.09 * ground.side_m;
  const auto& [c, step, d, depth, on_map, at, seen] = sample;
  const double area = d * d;
  view.sums.area += area;
  if (seen) view.sums.area_seen += area;
  if (c.floor) {
    view.sums.area_floor += area;
    if (seen) view.sums.area_floor_seen += area;
  }
  if (depth > 0.6) view.far.add(static_cast<double>(c.altitude_m), d);
  if (depth < 0.4) view.near.add(static_cast<double>(c.altitude_m), d);
  for (std::size_t k = 0; k < anchors.size(); ++k) {
    const Anchor& a = anchors[k];
    if (a.kind == AnchorKind::summit) continue;
    const bool belongs = a.kind == AnchorKind::shore
                             ? c.water
                             : static_cast<double>(c.incision_m) > 0.6 * a.stands_m;
    if (!belongs) continue;
    const glm::dvec2 off = sight.viewer + d * on_map - a.position;
    if (off.x * off.x + off.y * off.y > subject_reach * subject_reach) continue;
    view.subjects[k].area += area;
    if (seen && at.y <= 1.0) view.subjects[k].seen += area;
  }
}

// The part of the picture that a sample covers: `height` of a column.
void add_picture(Sums& sums, const CoarseGround& ground, const SightModel& sight,
                 const SeenSample& sample, double height, double air) {
  const GroundCell& c = sample.cell;
  const double depth = std::clamp(sample.depth, 0.0, 1.0);
  sums.all += height;
  sums.haze += height * air;
  if (static_cast<double>(c.rim_m) < sight.rim_fade_m) {
    sums.rim += height;
    if (depth < 0.55) sums.rim_near += height;
  }
  if (c.water) sums.water += height;
  if (c.floor) {
    sums.floor += height;
    sums.floor_by_depth[std::min<std::size_t>(3, static_cast<std::size_t>(4.0 * depth))] += height;
    sums.floor_by_third[std::min<std::size_t>(2, static_cast<std::size_t>(3.0 * sample.at.x))] +=
        height;
  }
  const double above = static_cast<double>(c.above_m);
  if (above < 0.12 * ground.relief_m && !c.water) sums.flat += height;
  sums.forms +=
      height * square(sight.exaggeration[sample.step] * above / (sample.distance_m * sight.height));
}

// Traverses one line of sight outwards. air: of each step.
void walk_line(SeenView& view, const CoarseGround& ground, const SightModel& sight,
               const std::vector<Anchor>& anchors, glm::dvec2 direction,
               const std::vector<double>& air) {
  const double depth_of_view = std::max(1.0, sight.far_m - sight.near_m);
  const glm::dvec2 on_map = to_map(direction, sight.azimuth_deg);
  double before = hidden;
  double last_seen = 0.0;
  double top = 1.0;
  bool any = false;
  bool lower_edge = false;
  EdgeForm edge_form(ground);
  const double level_x = sight.picture.position(direction, 0.3).x;
  const bool central = level_x >= 0.0 && level_x <= 1.0;
  for (std::size_t i = 0; i < sight.distance_m.size(); ++i) {
    const double d = sight.distance_m[i];
    const GroundCell* c = ground.at(sight.viewer + d * on_map);
    if (c == nullptr || !c->known) continue;
    const double altitude = static_cast<double>(c->altitude_m);
    const double z = sight.base_m + sight.exaggeration[i] * (altitude - sight.base_m);
    const double depression = (sight.eye_m - z + sight.drop_m[i]) / d;
    const bool seen = depression < before;
    const double was = before;
    if (seen) before = depression;
    edge_form.go_on(altitude, d);
    const bool in_depth = d >= sight.near_m && d <= sight.far_m;
    if (!seen && !in_depth) continue;
    const glm::dvec2 at = sight.picture.position(direction, depression);
    if (!(at.x >= 0.0 && at.x <= 1.0)) continue;
    any = true;
    const SeenSample sample{*c, i, d, (d - sight.near_m) / depth_of_view, on_map, at, seen};
    if (in_depth) add_ground(view, ground, sight, anchors, sample);
    if (!seen) continue;
    const double below = sight.picture.position(direction, std::min(was, lowest_seen)).y;
    if (below > 1.0 && at.y < 1.0) {
      lower_edge = true;
      edge_form.begin(*c, d);
    }
    top = std::min(top, unit_height(at.y));
    const double height = std::max(0.0, unit_height(below) - unit_height(at.y));
    if (last_seen > 0.0 && at.y < 1.0 && d / last_seen > 1.045 && central) view.sums.jumps += 1.0;
    if (at.y < 1.0) last_seen = d;
    if (height > 0.0) add_picture(view.sums, ground, sight, sample, height, air[i]);
  }
  if (any) view.sums.columns += 1.0;
  if (!central) return;
  view.skyline.push_back(any ? top : 1.0);
  view.sums.edge_columns += 1.0;
  if (!lower_edge) view.sums.edge_empty += 1.0;
  if (edge_form.cuts()) view.sums.edge_cut += 1.0;
}

// At the centre of the lower edge: the angle between the line of sight and the bent ground.
double lower_edge_angle_deg(const SightModel& sight) {
  std::size_t i = 0;
  while (i + 2 < sight.distance_m.size() && sight.distance_m[i + 1] < sight.near_m) ++i;
  const double slope =
      (sight.drop_m[i + 1] - sight.drop_m[i]) / (sight.distance_m[i + 1] - sight.distance_m[i]);
  double low = 0.0, high = lowest_seen;  // depression of the lower edge, by bisection
  for (int k = 0; k < 40; ++k) {
    const double centre = 0.5 * (low + high);
    (sight.picture.position({0.0, 1.0}, centre).y < 1.0 ? low : high) = centre;
  }
  return to_degrees(exact::atan2(low, 1.0) + exact::atan2(-slope, 1.0));
}

// Sums as shares.
void add_shares(ViewMeasures& out, const Sums& sums) {
  const double columns = std::max(1.0, sums.columns);
  const double edge = std::max(1.0, sums.edge_columns);
  out.lower_edge.empty = sums.edge_empty / edge;
  out.lower_edge.cut = sums.edge_cut / edge;
  out.ranges = sums.jumps / edge;
  out.rim.share = sums.rim / columns;
  out.rim.near_share = sums.rim_near / columns;
  out.floor.share = sums.floor / columns;
  out.water = sums.water / columns;
  out.flat = sums.flat / columns;
  for (const double share : sums.floor_by_depth)
    out.floor.depth_spread += 0.25 * std::min(1.0, share / columns / 0.012);
  for (const double share : sums.floor_by_third)
    out.floor.width_spread += std::min(1.0, share / columns / 0.015) / 3.0;
  if (sums.area > 0.0) out.visible_ground = sums.area_seen / sums.area;
  if (sums.area_floor > 0.0) out.floor.visible = sums.area_floor_seen / sums.area_floor;
  if (sums.all > 0.0) {
    out.forms = std::sqrt(sums.forms / sums.all);
    out.haze = sums.haze / sums.all;
  }
}

}  // namespace

double hump_of(const std::vector<double>& line) {
  constexpr double falls_from = 0.24, falls_to = 0.30;  // picture heights, from the top
  constexpr double peaks =
      0.036;  // deviation from the parabola, which indicates a skyline of peaks
  const std::size_t n = line.size();
  if (n < 4) return 0.0;
  const double sky_low = percentile(line, lowest_share);
  const auto across = [&](std::size_t i) {
    return 2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1.0;
  };
  double x2 = 0.0;
  for (std::size_t i = 0; i < n; ++i) x2 += square(across(i));
  const double mean = mean_of(line, 0, n);
  const double mean_x2 = x2 / static_cast<double>(n);
  // 1, x and x² - mean are orthogonal on samples that are evenly spaced around 0.
  double along = 0.0, arch = 0.0, arch2 = 0.0, all = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = across(i);
    const double q = square(x) - mean_x2;
    const double y = line[i] - mean;
    along += x * y, arch += q * y, arch2 += square(q), all += square(y);
  }
  const double rest = std::max(0.0, all - square(along) / x2 - square(arch) / arch2);
  const double stands_off = std::sqrt(rest / static_cast<double>(n));
  return unit((sky_low - falls_from) / (falls_to - falls_from)) * unit(1.0 - stands_off / peaks);
}

ViewMeasures measure_view(const CoarseGround& ground, const SightModel& sight,
                          const std::vector<Anchor>& anchors) {
  SeenView view;
  view.subjects.resize(anchors.size());
  std::vector<double> air;
  for (const double distance : sight.distance_m)
    air.push_back(sight.haze * (1.0 - exact::exp(-std::max(0.0, distance - sight.air_from_m) /
                                                 sight.air_scale_m)));
  for (const glm::dvec2 direction : sight.directions)
    walk_line(view, ground, sight, anchors, direction, air);

  ViewMeasures out;
  out.skyline = measure_skyline(view.skyline);
  add_shares(out, view.sums);
  if (view.far.weight > 0.0 && view.near.weight > 0.0)
    out.rise =
        (view.far.sum / view.far.weight - view.near.sum / view.near.weight) / ground.relief_m;
  out.area =
      0.5 * sight.width * (square(sight.far_m) - square(sight.near_m)) / square(ground.side_m);
  constexpr double evaluated_px = 2400.0;
  out.lower_edge.cell_px =
      ground.source_cell_m / std::max(1e-6, sight.width * sight.near_m / evaluated_px);
  out.lower_edge.angle_deg = lower_edge_angle_deg(sight);
  for (std::size_t k = 0; k < anchors.size(); ++k) {
    AnchorSight placed = sight_of(ground, sight, anchors[k]);
    if (anchors[k].kind != AnchorKind::summit && view.subjects[k].area > 0.0)
      placed.seen = view.subjects[k].seen / view.subjects[k].area;
    out.anchors.push_back(placed);
  }
  return out;
}

ViewMeasures measure_view(const CoarseGround& ground, const ViewShape& view,
                          const std::vector<Anchor>& anchors, const MeasureParameters& parameters) {
  const ComposedPicture picture(view);
  const HorizonDefaults horizon = defaults_of_horizon(view.far_m);
  SightModel sight{
      .picture = picture,
      .viewer = view.viewer,
      .eye_m = view.eye_m,
      .azimuth_deg = view.azimuth_deg,
      .width = to_radians(view.field_of_view_deg),
      .height = picture_height(view),
      .near_m = view.near_m,
      .far_m = view.far_m,
      .directions = fan_directions(view.field_of_view_deg, view.cylinder, parameters.columns),
      .distance_m = growing_distances(0.7 * view.near_m, 1.12 * view.far_m, parameters.steps),
      .drop_m = {},
      .exaggeration = {},
      .base_m = view.base_m,
      .rim_fade_m = horizon.rim_fade_m,
      .air_from_m = horizon.air_from_m,
      .air_scale_m = horizon.air_scale_m,
      .haze = view_haze};
  for (const double d : sight.distance_m) sight.drop_m.push_back(view.drop_m(d));
  sight.exaggeration.assign(sight.distance_m.size(), view.exaggeration);
  return measure_view(ground, sight, anchors);
}

}  // namespace belvedere
