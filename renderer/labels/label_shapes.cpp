#include "renderer/labels/label_shapes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/masks/polygon.h"
#include "base/parallel.h"
#include "base/text/parse_number.h"
#include "renderer/labels/drawing.h"

namespace belvedere {
namespace {

constexpr int sections = 48;
constexpr int max_steps = 4000;          // maximum number of samples per line
constexpr double steepest = 0.5735764;   // cosine of 55°
constexpr double max_turn = 0.5;         // cosine of 60°
constexpr double longest_ends = 0.25;    // by which a line may be extended at each end, of the text
constexpr double shortest_gap_px = 6.0;  // shorter hidden gaps do not split a line

double rank_of(const MapFeature& feature, const std::string& text) {
  if (text.empty()) return 5.0;
  const std::optional<double> value = parse_number<double>(text);
  if (!value || !(*value >= 1.0 && *value <= 9.0))
    throw Error(ErrorKind::usage, feature.where, "rank is \"" + text + '"',
                "a number, 1 … 9; empty if not known");
  return *value;
}

glm::dvec2 centre_of(const std::vector<glm::dvec2>& positions) {
  glm::dvec2 sum(0.0);
  for (const glm::dvec2 p : positions) sum += p;
  return sum / static_cast<double>(positions.size());
}

// A line with positions inserted, no farther from each other than `step`; steps grow where a line
// would have too many.
std::vector<glm::dvec2> refined(const std::vector<glm::dvec2>& row, double step, bool closed) {
  std::vector<glm::dvec2> ring = row;
  if (closed) ring.push_back(row.front());
  step = std::max(step, length_of(ring) / max_steps);
  std::vector<glm::dvec2> out;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const int parts =
        std::max(1, static_cast<int>(std::ceil(glm::length(ring[i + 1] - ring[i]) / step)));
    for (int k = 0; k < parts; ++k)
      out.push_back(glm::mix(ring[i], ring[i + 1], static_cast<double>(k) / parts));
  }
  if (!closed) out.push_back(ring.back());
  return out;
}

struct Seen {
  glm::dvec2 pixel{0.0};
  bool seen = false;
};

// The longest visible piece, in pixels; short gaps do not split it.
std::vector<glm::dvec2> longest_run(const std::vector<Seen>& row) {
  std::vector<glm::dvec2> best, run;
  glm::dvec2 last(0.0);
  for (const Seen& at : row) {
    if (!at.seen) continue;
    if (!run.empty() && glm::length(at.pixel - last) > shortest_gap_px + 2.0) {
      if (length_of(run) > length_of(best)) best = run;
      run.clear();
    }
    if (run.empty() || glm::length(at.pixel - run.back()) > .5) run.push_back(at.pixel);
    last = at.pixel;
  }
  return length_of(run) > length_of(best) ? run : best;
}

ShapeRun run_of_line(const LocatedGround& ground, const LabelShape& shape) {
  ShapeRun out;
  const double metres = ground.cell_m / ground.transform.cell_x;
  for (const std::vector<glm::dvec2>& part : shape.parts) {
    std::vector<Seen> row;
    for (const glm::dvec2 position : refined(part, .5 * ground.cell_m / metres, false)) {
      const std::optional<ImagePosition> at = ground.map.to_image(position);
      if (at) row.push_back({at->pixel, at->visible});
    }
    std::vector<glm::dvec2> run = longest_run(row);
    if (length_of(run) > length_of(out.line)) out.line = std::move(run);
  }
  return out;
}

ShapeRun run_of_area(const LocatedGround& ground, const LabelShape& shape) {
  std::vector<std::vector<glm::dvec2>> rings;
  for (const std::vector<glm::dvec2>& part : shape.parts) {
    std::vector<glm::dvec2> ring;
    for (const glm::dvec2 position : refined(part, ground.transform.cell_x, true))
      if (const std::optional<ImagePosition> at = ground.map.to_image(position))
        ring.push_back(at->pixel);
    if (ring.size() > 2) rings.push_back(std::move(ring));
  }
  ShapeRun out;
  if (rings.empty()) return out;
  const std::vector<glm::dvec2> centre = centreline(rings);
  if (centre.size() < 2) return out;
  std::vector<Seen> row;
  // A position of the area is visible if its pixel shows it, and not ground in front.
  for (const glm::dvec2 pixel : refined(centre, 1.0, false)) {
    const std::optional<GeoPosition> shown = ground.map.to_geo(pixel);
    row.push_back({pixel, shown && encloses(shape.parts, shown->position)});
  }
  out.line = longest_run(row);
  return out;
}

LabelMark mark_of(const LocatedGround& ground, const LabelShape& shape,
                  const std::vector<glm::dvec2>& line) {
  LabelMark mark;
  mark.drawn_position = shape.point.position;
  mark.dem_altitude_m = NAN;
  if (line.size() < 2) {
    const std::optional<ImagePosition> at = ground.map.to_image(shape.point.position);
    if (!ground.map.on_surface(shape.point.position)) return mark;
    mark.state = !at              ? MarkState::behind_eye
                 : at->in_picture ? MarkState::hidden
                                  : MarkState::outside_picture;
    if (at) {
      mark.pixel = at->pixel;
      mark.distance_m = at->distance_m;
      if (mark.state == MarkState::hidden) mark.in_front = ground.map.to_geo(at->pixel);
    }
    return mark;
  }
  mark.pixel = line[line.size() / 2];
  mark.state = MarkState::seen;
  if (const std::optional<GeoPosition> shown = ground.map.to_geo(mark.pixel)) {
    mark.drawn_position = shown->position;
    mark.distance_m = shown->distance_m;
    mark.dem_altitude_m = shown->altitude_m;
  }
  return mark;
}

// How wide an area is seen in the row of a pixel that shows it.
double seen_width(const LocatedGround& ground, const LabelShape& shape, glm::dvec2 pixel) {
  constexpr double widest_px = 4000.0;  // wide enough for any name
  const auto reach = [&](double step) {
    double way = 0.0;
    while (way < widest_px) {
      const std::optional<GeoPosition> shown =
          ground.map.to_geo(pixel + glm::dvec2((way + 1.0) * step, 0.0));
      if (!shown || !encloses(shape.parts, shown->position)) break;
      way += 1.0;
    }
    return way;
  };
  return 1.0 + reach(-1.0) + reach(1.0);
}

// The part of a line between two lengths along it, in 32 steps.
std::vector<glm::dvec2> stretch(const std::vector<glm::dvec2>& line, double from, double to) {
  constexpr int steps = 32;
  std::vector<glm::dvec2> out;
  std::size_t i = 0;
  double before = 0.0;
  for (int k = 0; k <= steps; ++k) {
    const double want = from + (to - from) * k / steps;
    while (i + 2 < line.size() && before + glm::length(line[i + 1] - line[i]) < want) {
      before += glm::length(line[i + 1] - line[i]);
      ++i;
    }
    const double piece = glm::length(line[i + 1] - line[i]);
    out.push_back(piece > 0.0 ? line[i] + (line[i + 1] - line[i]) * ((want - before) / piece)
                              : line[i]);
  }
  return out;
}

// y = a + b x + c x² through positions, by least squares; x is centred and scaled to about ±1, so
// that sums are well conditioned.
std::array<double, 3> fit_parabola(const std::vector<glm::dvec2>& positions) {
  std::array<double, 5> s{};
  std::array<double, 3> t{};
  for (const glm::dvec2 p : positions) {
    double power = 1.0;
    for (std::size_t k = 0; k < 5; ++k, power *= p.x) {
      s[k] += power;
      if (k < 3) t[k] += power * p.y;
    }
  }
  // Cramer's rule; symmetric and small.
  const auto det = [](double a, double b, double c, double d, double e, double f, double g,
                      double h, double i) {
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  };
  const double whole = det(s[0], s[1], s[2], s[1], s[2], s[3], s[2], s[3], s[4]);
  if (std::abs(whole) < 1e-12) return {t[0] / s[0], 0.0, 0.0};
  return {det(t[0], s[1], s[2], t[1], s[2], s[3], t[2], s[3], s[4]) / whole,
          det(s[0], t[0], s[2], s[1], t[1], s[3], s[2], t[2], s[4]) / whole,
          det(s[0], s[1], t[0], s[1], s[2], t[1], s[2], s[3], t[2]) / whole};
}

// An arc that fits a part of a line and has its length; empty where a text cannot be set on it.
std::vector<glm::dvec2> arc_along(const std::vector<glm::dvec2>& positions, double width,
                                  double lift) {
  const glm::dvec2 chord = positions.back() - positions.front();
  if (glm::length(chord) < .6 * width) return {};
  const glm::dvec2 along = chord / glm::length(chord);
  const glm::dvec2 across(-along.y, along.x);
  const glm::dvec2 centre = .5 * (positions.front() + positions.back());
  const double unit = .5 * width;
  std::vector<glm::dvec2> own;
  for (const glm::dvec2 p : positions)
    own.emplace_back(glm::dot(p - centre, along) / unit, glm::dot(p - centre, across) / unit);
  const std::array<double, 3> f = fit_parabola(own);
  std::vector<glm::dvec2> arc;
  constexpr int steps = 40;
  // A little beyond both ends: set_along centres the text, and SVG programs drop letters that pass
  // the end of a path.
  for (int k = 0; k <= steps; ++k) {
    const double x = -1.15 + 2.3 * k / steps;
    const glm::dvec2 tangent = glm::normalize(along + across * (f[1] + 2.0 * f[2] * x));
    arc.push_back(centre + unit * (x * along + (f[0] + f[1] * x + f[2] * x * x) * across) +
                  lift * glm::dvec2(tangent.y, -tangent.x));
  }
  glm::dvec2 first(0.0);
  for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
    const glm::dvec2 tangent = glm::normalize(arc[i + 1] - arc[i]);
    if (i == 0) first = tangent;
    if (tangent.x < steepest || glm::dot(first, tangent) < max_turn) return {};
  }
  return arc;
}

}  // namespace

std::vector<LabelShape> read_label_shapes(const VectorSource& source, const std::string& crs,
                                          const LabelStyle& style, Progress& progress) {
  const std::string& path = source.path;
  // The kind: the first of the columns between name and rank that is not empty.
  const MapFeatures file = read_map_features(
      source,
      {.columns = {"name"}, .also = {"kind", "type", "natural", "place", "waterway", "rank"}}, crs);
  std::vector<LabelShape> shapes;
  std::map<std::pair<std::string, int>, std::size_t> known;
  std::size_t nameless = 0, strange = 0;
  const int usual = std::max(0, style.find("valley"));
  for (const MapFeature& feature : file.features) {
    if (feature.shape == MapShape::point) continue;
    if (feature.values[0].empty() || letters_of(feature.values[0]) > longest_name) {
      ++nameless;
      continue;
    }
    const auto word = std::find_if(feature.values.begin() + 1, feature.values.end() - 1,
                                   [](const std::string& text) { return !text.empty(); });
    const int kind = word == feature.values.end() - 1 ? usual : style.find(*word);
    if (kind < 0) ++strange;
    const auto [at, is_new] = known.try_emplace({feature.values[0], kind}, shapes.size());
    if (!is_new && feature.shape == MapShape::line && !shapes[at->second].is_area) {
      shapes[at->second].parts.push_back(feature.parts.front());
      continue;
    }
    LabelShape shape;
    shape.point.name = feature.values[0];
    shape.point.kind = std::max(0, kind);
    shape.point.rank = rank_of(feature, feature.values.back());
    shape.point.where = feature.where;
    shape.is_area = feature.shape == MapShape::area;
    shape.parts = feature.parts;
    const std::vector<glm::dvec2>& first = shape.parts.front();
    shape.point.position = shape.is_area ? centre_of(first) : first[first.size() / 2];
    shapes.push_back(std::move(shape));
  }
  if (shapes.empty())
    throw Error(
        ErrorKind::usage, path,
        fmt::format("none of its {} features is a line or an area with a name of 1 … {} letters",
                    file.features.size(), longest_name),
        "lines and areas with names; points are --points, or [[labels.points]]");
  if (nameless > 0)
    progress.note(fmt::format(
        "{}: {} lines and areas without a name, or with one of more than {} letters, are left out",
        path, nameless, longest_name));
  if (strange > 0)
    progress.note(
        fmt::format("{}: {} lines and areas of kinds that the style {} does not contain: set as {}",
                    path, strange, style.name, style.kinds[0].name));
  return shapes;
}

std::vector<glm::dvec2> centreline(const std::vector<std::vector<glm::dvec2>>& rings) {
  // The longest direction is the principal axis of the outline's vertices.
  const std::vector<glm::dvec2>& outline = rings.front();
  const glm::dvec2 centre = centre_of(outline);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const glm::dvec2 p : outline) {
    const glm::dvec2 d = p - centre;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const double root = std::sqrt(.25 * (xx - yy) * (xx - yy) + xy * xy);
  const double greatest = .5 * (xx + yy) + root;
  glm::dvec2 axis = std::abs(xy) > 1e-9 * (xx + yy) ? glm::dvec2(greatest - yy, xy)
                    : xx >= yy                      ? glm::dvec2(1, 0)
                                                    : glm::dvec2(0, 1);
  if (!(glm::length(axis) > 0.0)) return {};
  axis = glm::normalize(axis);
  if (axis.x < 0.0) axis = -axis;
  const glm::dvec2 across(-axis.y, axis.x);
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (const glm::dvec2 p : outline) {
    from = std::min(from, glm::dot(p - centre, axis));
    to = std::max(to, glm::dot(p - centre, axis));
  }
  std::vector<glm::dvec2> line;
  for (int k = 0; k < sections; ++k) {
    const double at = from + (to - from) * (k + .5) / sections;
    std::vector<double> cuts;
    for (const std::vector<glm::dvec2>& ring : rings)
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const double a = glm::dot(ring[j] - centre, axis) - at;
        const double b = glm::dot(ring[i] - centre, axis) - at;
        if ((a > 0.0) == (b > 0.0)) continue;
        cuts.push_back(glm::dot(glm::mix(ring[j], ring[i], a / (a - b)) - centre, across));
      }
    std::sort(cuts.begin(), cuts.end());
    double widest = 0.0, best = 0.0;
    for (std::size_t i = 0; i + 1 < cuts.size(); i += 2)
      if (cuts[i + 1] - cuts[i] > widest) {
        widest = cuts[i + 1] - cuts[i];
        best = .5 * (cuts[i] + cuts[i + 1]);
      }
    if (widest > 0.0) line.push_back(centre + at * axis + best * across);
  }
  return line;
}

std::vector<ShapeRun> find_shape_runs(const LocatedGround& ground,
                                      const std::vector<LabelShape>& shapes) {
  std::vector<ShapeRun> runs(shapes.size());
  parallel_ranges<std::size_t>(shapes.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      runs[i] = shapes[i].is_area ? run_of_area(ground, shapes[i]) : run_of_line(ground, shapes[i]);
      runs[i].mark = mark_of(ground, shapes[i], runs[i].line);
      if (shapes[i].is_area && runs[i].mark.state == MarkState::seen)
        runs[i].mark.width_px = seen_width(ground, shapes[i], runs[i].mark.pixel);
    }
  });
  return runs;
}

std::vector<std::vector<glm::dvec2>> fitted_baselines(const std::vector<glm::dvec2>& line,
                                                      double width_px, double lift_px,
                                                      double aside_px) {
  const double length = length_of(line);
  if (line.size() < 2 || length < width_px * (1.0 - 2.0 * longest_ends)) return {};
  std::vector<glm::dvec2> row = line;
  if (row.back().x < row.front().x) std::reverse(row.begin(), row.end());
  const double max = std::max(0.0, .5 * (length - width_px));
  // Beyond its ends the line continues straight, in the direction of its last quarter: single
  // pixels have none.
  const glm::dvec2 begins =
      row.front() - row[row.size() / 4 + 1 < row.size() ? row.size() / 4 + 1 : row.size() - 1];
  const glm::dvec2 ends =
      row.back() - row[row.size() - 1 - std::min(row.size() - 1, row.size() / 4 + 1)];
  if (glm::length(begins) > 0.0 && glm::length(ends) > 0.0) {
    std::vector<glm::dvec2> longer = {row.front() + width_px * glm::normalize(begins)};
    std::copy(row.begin(), row.end(), std::back_inserter(longer));
    longer.push_back(row.back() + width_px * glm::normalize(ends));
    row = std::move(longer);
  }
  const double added = .5 * (length_of(row) - length);
  // The cost grows with the distance from the centre of the line.
  struct Arc {
    double cost;
    std::vector<glm::dvec2> baseline;
  };
  std::vector<Arc> arcs;
  for (const double share : {0.0, -.3, .3, -.6, .6, -.95, .95}) {
    if (share != 0.0 && max == 0.0) break;
    const double centre = added + .5 * length + share * max;
    const std::vector<glm::dvec2> piece =
        stretch(row, centre - .5 * width_px, centre + .5 * width_px);
    for (const double side : {0.0, -1.0, 1.0}) {
      if (side != 0.0 && !(aside_px > 0.0)) break;
      std::vector<glm::dvec2> arc = arc_along(piece, width_px, lift_px + side * aside_px);
      if (!arc.empty())
        arcs.push_back({std::abs(share) + (side == 0.0  ? 0.0
                                           : side < 0.0 ? .45
                                                        : .55),
                        std::move(arc)});
    }
  }
  std::stable_sort(arcs.begin(), arcs.end(),
                   [](const Arc& a, const Arc& b) { return a.cost < b.cost; });
  std::vector<std::vector<glm::dvec2>> found;
  for (Arc& arc : arcs) found.push_back(std::move(arc.baseline));
  return found;
}

}  // namespace belvedere
