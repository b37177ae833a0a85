#include "renderer/features/drawn_features.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "base/parallel.h"
#include "renderer/features/drawn_cables.h"
#include "renderer/features/drawn_houses.h"

namespace belvedere {
namespace {

constexpr int net_px = 256;
constexpr double shortest_gap_mm =
    1.0;  // shorter hidden parts are drawn, unless a farther range hides them
constexpr double shortest_speck_mm = 0.3;  // shorter visible parts are not drawn
constexpr double same_range = 0.03;  // share of its distance within which ground in front of a
                                     // point belongs to the same slope

double length_mm(const std::vector<LineSample>& samples, std::size_t first, std::size_t last,
                 double px_per_mm) {
  double px = 0.0;
  for (std::size_t i = first; i < last; ++i)
    px += glm::length(samples[i + 1].pixel - samples[i].pixel);
  return px / px_per_mm;
}

// The runs of equal samples, as pairs first … last.
template <class Like>
void for_runs(const std::vector<LineSample>& samples, Like&& like,
              const std::function<void(std::size_t, std::size_t)>& take) {
  for (std::size_t i = 0; i < samples.size();) {
    std::size_t last = i;
    while (last + 1 < samples.size() && like(samples[last + 1]) == like(samples[i])) ++last;
    take(i, last);
    i = last + 1;
  }
}

void close_gaps(std::vector<LineSample>& samples, double px_per_mm) {
  const auto seen = [](const LineSample& s) { return s.seen; };
  for_runs(samples, seen, [&](std::size_t first, std::size_t last) {
    if (samples[first].seen || first == 0 || last + 1 == samples.size()) return;
    bool near = true;
    for (std::size_t i = first; i <= last; ++i)
      near = near && samples[i].in_picture &&
             samples[i].hidden_by_m < same_range * samples[i].distance_m;
    if (near && length_mm(samples, first - 1, last + 1, px_per_mm) < shortest_gap_mm)
      for (std::size_t i = first; i <= last; ++i) samples[i].seen = true;
  });
  for_runs(samples, seen, [&](std::size_t first, std::size_t last) {
    if (!samples[first].seen || first == 0 || last + 1 == samples.size()) return;
    if (length_mm(samples, first, last, px_per_mm) < shortest_speck_mm)
      for (std::size_t i = first; i <= last; ++i) samples[i].seen = false;
  });
}

// Removes points on a straight line of constant width, to a quarter of a pixel; ends stay.
void thin(std::vector<DrawnPoint>& points) {
  constexpr float max_px = 0.15F;
  std::vector<DrawnPoint> kept = {points.front()};
  std::size_t from = 0;
  for (std::size_t to = 2; to < points.size(); ++to) {
    const DrawnPoint& a = points[from];
    const DrawnPoint& b = points[to];
    const glm::vec2 way = b.position - a.position;
    const float squared = glm::dot(way, way) + 1e-12F;
    bool straight = to - from < 64 && std::abs(b.distance_m - a.distance_m) < 0.01F * a.distance_m;
    for (std::size_t k = from + 1; k < to && straight; ++k) {
      const float t = glm::dot(points[k].position - a.position, way) / squared;
      straight =
          t >= 0.F && t <= 1.F && glm::length(points[k].position - a.position - t * way) < max_px;
    }
    if (straight) continue;
    kept.push_back(points[to - 1]);
    from = to - 1;
  }
  kept.push_back(points.back());
  points = std::move(kept);
}

struct Making {
  const FeatureSet& set;
  const GroundSight& sight;
  const DrawnParameters& parameters;
  double foreground_m_per_px;
};

// The drawn parts of one feature.
struct Made {
  std::vector<DrawnLine> lines;
  std::vector<DrawnHouse> houses;
  DrawnCount count;
};

void count_line(const std::vector<LineSample>& samples, bool drawn, bool far, DrawnCount& count) {
  bool on_terrain = false;
  bool in_picture = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    on_terrain = on_terrain || samples[i].on_terrain;
    in_picture = in_picture || samples[i].in_picture;
    if (i == 0) continue;
    const double length_m = glm::length(samples[i].map - samples[i - 1].map);
    count.length_m += length_m;
    if (samples[i].seen && samples[i - 1].seen) count.seen_m += length_m;
  }
  ++count.features;
  ++(!on_terrain   ? count.outside_terrain
     : !in_picture ? count.outside_picture
     : drawn       ? count.drawn
     : far         ? count.too_far
                   : count.hidden);
}

void draw_way(const Making& making, const Feature& feature, const FeatureKind& kind, Made& made) {
  const double px_per_mm = making.parameters.px_per_mm;
  std::vector<LineSample> samples = sample_line(making.sight, feature.parts.front(), px_per_mm);
  close_gaps(samples, px_per_mm);
  bool far = false;
  double along_mm = 0.0;
  std::vector<DrawnPoint> run;
  const auto end_run = [&] {
    if (run.size() > 1) {
      thin(run);
      made.lines.push_back({.kind = feature.kind, .part = LinePart::way, .points = std::move(run)});
    }
    run.clear();
  };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const LineSample& sample = samples[i];
    if (!sample.projected) {
      end_run();
      continue;
    }
    const PointLook look = look_at(making.sight, sample.point, sample.pixel, kind, feature.width_mm,
                                   feature.real_m, px_per_mm, making.foreground_m_per_px);
    if (i > 0 && samples[i - 1].projected)
      along_mm += glm::length(sample.pixel - samples[i - 1].pixel) / (px_per_mm * look.share);
    far = far || (sample.seen && look.too_far);
    if (!sample.seen || look.too_far) {
      end_run();
      continue;
    }
    run.push_back({.position = glm::vec2(sample.pixel),
                   .distance_m = static_cast<float>(sample.distance_m),
                   .half_px = static_cast<float>(look.half_px),
                   .share = static_cast<float>(look.share),
                   .along_mm = static_cast<float>(along_mm)});
  }
  end_run();
  count_line(samples, !made.lines.empty(), far, made.count);
}

// Pixels that a river needs free of trees: its water as it appears in the picture.
std::vector<DrawnLine> river_lanes(const Making& making, const CoverRiver& river) {
  std::vector<DrawnLine> lanes;
  if (river.kind < 0) return lanes;  // the style has no such rivers
  const FeatureKind& kind = making.set.style.kinds[static_cast<std::size_t>(river.kind)];
  if (kind.clear_mm <= 0.0 || river.positions.size() < 2) return lanes;
  const double px_per_mm = making.parameters.px_per_mm;
  const std::vector<LineSample> samples = sample_line(making.sight, river.positions, px_per_mm);
  std::vector<DrawnPoint> run;
  const auto end_run = [&] {
    if (run.size() > 1) {
      thin(run);
      lanes.push_back({.kind = river.kind, .part = LinePart::lane, .points = std::move(run)});
    }
    run.clear();
  };
  std::size_t at = 0;  // the river's position at or before the sample
  for (const LineSample& sample : samples) {
    if (at + 1 < river.positions.size() && sample.map == river.positions[at + 1]) ++at;
    if (!sample.in_picture) {
      end_run();
      continue;
    }
    const std::size_t from = std::min(at, river.positions.size() - 2);
    const glm::dvec2 along = river.positions[from + 1] - river.positions[from];
    const double length_m = std::max(glm::length(along), 1e-9);
    const auto half_m =
        static_cast<double>(std::max(river.half_width_m[from], river.half_width_m[from + 1]));
    const PointLook look = look_at(making.sight, sample.point, sample.pixel, kind, kind.width_mm,
                                   0.0, px_per_mm, making.foreground_m_per_px);
    // The visible width of its water: a river that runs across the view is foreshortened.
    const double step_m = 30.0;
    const glm::dvec3 ahead{along * (step_m / length_m), 0.0};
    const auto on = making.sight.pixel(sample.point + ahead);
    const auto beside = making.sight.pixel(sample.point + glm::dvec3(-ahead.y, ahead.x, 0.0));
    double half_px = 0.0;
    if (on && beside) {
      const glm::dvec2 a = *on - sample.pixel;
      const glm::dvec2 b = *beside - sample.pixel;
      half_px =
          std::abs(a.x * b.y - a.y * b.x) / std::max(glm::length(a), 1e-9) * (half_m / step_m);
    }
    run.push_back({.position = glm::vec2(sample.pixel),
                   .distance_m = static_cast<float>(sample.distance_m),
                   .half_px = static_cast<float>(half_px),
                   .share = static_cast<float>(look.share),
                   .along_mm = 0.F});
  }
  end_run();
  return lanes;
}

// The direction to the sun at a feature.
glm::dvec3 sun_at(const DrawnParameters& parameters, const Feature& feature) {
  const bool known =
      parameters.light_field && !feature.parts.empty() && !feature.parts.front().empty();
  return known ? parameters.light_field->at(feature.parts.front().front()).sun : parameters.sun;
}

Made make_feature(const Making& making, const Feature& feature) {
  Made made;
  const FeatureKind& kind = making.set.style.kinds[static_cast<std::size_t>(feature.kind)];
  switch (kind.draw) {
    case FeatureDraw::line:
    case FeatureDraw::band:
      draw_way(making, feature, kind, made);
      break;
    case FeatureDraw::cable:
      draw_cable({making.sight, kind, making.parameters.px_per_mm, making.foreground_m_per_px},
                 feature, made.lines, made.count);
      break;
    case FeatureDraw::building:
      draw_house({making.sight, kind, making.parameters.px_per_mm, making.foreground_m_per_px,
                  sun_at(making.parameters, feature)},
                 feature, made.houses, made.count);
      break;
    case FeatureDraw::river:
    case FeatureDraw::area:
    case FeatureDraw::coast:
    case FeatureDraw::town:
      break;
  }
  return made;
}

void add(const DrawnCount& from, DrawnCount& to) {
  to.features += from.features;
  to.outside_terrain += from.outside_terrain;
  to.outside_picture += from.outside_picture;
  to.hidden += from.hidden;
  to.too_far += from.too_far;
  to.drawn += from.drawn;
  to.length_m += from.length_m;
  to.seen_m += from.seen_m;
}

glm::ivec2 net_of(glm::ivec2 sheet_px) { return (sheet_px + net_px - 1) / net_px; }

// The grid cells that a box of the sheet touches, clipped to its border.
PixelRect cells_of(glm::vec2 low, glm::vec2 high, glm::ivec2 net) {
  const auto cell = [](float px) {
    return static_cast<int>(std::floor(std::clamp(px, -1e6F, 1e6F) / net_px));
  };
  return intersection({cell(low.x), cell(low.y), cell(high.x) + 1, cell(high.y) + 1},
                      {0, 0, net.x, net.y});
}

void put(std::vector<std::vector<std::uint32_t>>& cells, PixelRect where, glm::ivec2 net,
         std::uint32_t number) {
  for (int y = where.y0; y < where.y1; ++y)
    for (int x = where.x0; x < where.x1; ++x) {
      std::vector<std::uint32_t>& cell =
          cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(net.x) +
                static_cast<std::size_t>(x)];
      if (cell.empty() || cell.back() != number) cell.push_back(number);
    }
}

void index(DrawnFeatures& drawn) {
  drawn.net = net_of(drawn.sheet_px);
  const std::size_t count =
      static_cast<std::size_t>(drawn.net.x) * static_cast<std::size_t>(drawn.net.y);
  drawn.lines_in.resize(count);
  drawn.houses_in.resize(count);
  for (std::size_t k = 0; k < drawn.lines.size(); ++k) {
    const DrawnLine& line = drawn.lines[k];
    const FeatureKind& kind = drawn.style.kinds[static_cast<std::size_t>(line.kind)];
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const DrawnPoint& a = line.points[i];
      const DrawnPoint& b = line.points[i + 1];
      const float reach =
          std::max(reach_px(kind, a, drawn.px_per_mm), reach_px(kind, b, drawn.px_per_mm));
      put(drawn.lines_in,
          cells_of(glm::min(a.position, b.position) - reach,
                   glm::max(a.position, b.position) + reach, drawn.net),
          drawn.net, static_cast<std::uint32_t>(k));
    }
  }
  for (std::size_t k = 0; k < drawn.houses.size(); ++k) {
    const DrawnHouse& house = drawn.houses[k];
    const FeatureKind& kind = drawn.style.kinds[static_cast<std::size_t>(house.kind)];
    const float reach =
        house.reach_px + static_cast<float>(clear_below * kind.clear_mm * drawn.px_per_mm) + 2.F;
    put(drawn.houses_in, cells_of(house.foot - reach, house.foot + reach, drawn.net), drawn.net,
        static_cast<std::uint32_t>(k));
    drawn.house_reach_px =
        std::max(drawn.house_reach_px, static_cast<int>(std::ceil(house.reach_px)));
  }
}

std::vector<std::uint32_t> numbers_at(const std::vector<std::vector<std::uint32_t>>& cells,
                                      glm::ivec2 net, PixelRect rect) {
  const PixelRect where = cells_of({rect.x0, rect.y0}, {rect.x1 - 1, rect.y1 - 1}, net);
  std::vector<std::uint32_t> all;
  for (int y = where.y0; y < where.y1; ++y)
    for (int x = where.x0; x < where.x1; ++x) {
      const std::vector<std::uint32_t>& cell =
          cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(net.x) +
                static_cast<std::size_t>(x)];
      all.insert(all.end(), cell.begin(), cell.end());
    }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

std::vector<std::uint32_t> DrawnFeatures::lines_at(PixelRect rect) const {
  return numbers_at(lines_in, net, rect);
}
std::vector<std::uint32_t> DrawnFeatures::houses_at(PixelRect rect) const {
  return numbers_at(houses_in, net, rect);
}

const DrawnFeatures& no_features() {
  static const DrawnFeatures none;
  return none;
}

float reach_px(const FeatureKind& kind, const DrawnPoint& point, double px_per_mm) {
  const double beyond_mm =
      std::max({kind.casing_mm, kind.bed_mm, clear_below * kind.clear_mm}) + kind.soft_mm;
  return point.half_px * (1.F + static_cast<float>(kind.hand)) +
         static_cast<float>(beyond_mm * px_per_mm) * point.share + 2.F;
}

DrawnFeatures draw_features(const FeatureSet& set, const GroundSight& sight,
                            const DrawnParameters& parameters, std::span<const CoverRiver> rivers) {
  DrawnFeatures drawn;
  drawn.style = set.style;
  drawn.winter = parameters.winter;
  drawn.px_per_mm = parameters.px_per_mm;
  drawn.seed = parameters.seed;
  drawn.sheet_px = sight.size();
  drawn.rivers = !rivers.empty();
  drawn.counts.assign(set.readings.size(), std::vector<DrawnCount>(set.style.kinds.size()));
  const Making making{set, sight, parameters, sight.nearest_metres_per_px()};
  std::vector<Made> made(set.features.size());
  parallel_ranges<std::size_t>(set.features.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) made[i] = make_feature(making, set.features[i]);
  });
  for (std::size_t i = 0; i < made.size(); ++i) {
    const Feature& feature = set.features[i];
    add(made[i].count, drawn.counts[static_cast<std::size_t>(feature.source)]
                                   [static_cast<std::size_t>(feature.kind)]);
    std::move(made[i].lines.begin(), made[i].lines.end(), std::back_inserter(drawn.lines));
    std::move(made[i].houses.begin(), made[i].houses.end(), std::back_inserter(drawn.houses));
  }
  std::vector<std::vector<DrawnLine>> lanes(rivers.size());
  parallel_ranges<std::size_t>(rivers.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) lanes[i] = river_lanes(making, rivers[i]);
  });
  for (std::vector<DrawnLine>& lane : lanes)
    std::move(lane.begin(), lane.end(), std::back_inserter(drawn.lines));
  index(drawn);
  return drawn;
}

}  // namespace belvedere
