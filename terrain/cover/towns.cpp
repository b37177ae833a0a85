#include "terrain/cover/towns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <unordered_map>

#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/io/points.h"
#include "terrain/shape/mask_pieces.h"

namespace belvedere {
namespace {

constexpr double block_m = 300.0;  // one candidate in each block of the map
// For inferred settlements, and as in the Alps (TownParameters::inferred).
struct Density {
  double few, alpine;
  double at(double inferred) const { return few + (alpine - few) * inferred; }
};
constexpr Density town_spacing_m{9000.0,
                                 6000.0};  // distance of market towns: a day's walk there and back
constexpr Density village_spacing_m{2900.0, 1700.0};
constexpr Density hamlet_spacing_m{3400.0, 2000.0};
constexpr double plain_m = 2000.0;  // ground that is level over this distance is a plain
constexpr float min_floor = 0.03F;  // share of valley floor within trading distance of a hamlet
constexpr double link_m = 5200.0;   // towns and villages within this distance are linked
constexpr float outermost = -4.F;
constexpr float min_side_km2 = 3.F;  // catchment of a side stream whose mouth attracts settlement
constexpr float largest_side_km2 = 400.F;
constexpr float river_km2 = 40.F;

struct Candidate {
  float score;
  std::int32_t cell;
  bool on_floor;
};

double distance_m(const TownGround& g, glm::dvec2 a, std::int32_t cell) {
  const glm::dvec2 there = g.transform.to_crs(cell % g.floor.width(), cell / g.floor.width());
  return glm::length(there - a);
}

// Largest of amount · exp(-d² / 2σ²) over the mouths of side valleys, where a stream enters the
// floor.
Grid<float> valley_mouths(const TownGround& g, double cell_m) {
  const int width = g.floor.width();
  const int height = g.floor.height();
  Grid<float> near(width, height, 0.F);
  const double sigma = 420.0 / cell_m;
  const int reach = static_cast<int>(2.5 * sigma);
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      const float area = g.catchment_km2(x, y);
      if (area < min_side_km2 || area > largest_side_km2 || g.floor(x, y) >= 0.5F) continue;
      bool opens = false;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          opens =
              opens || (g.catchment_km2(x + dx, y + dy) > area && g.floor(x + dx, y + dy) >= 0.5F);
      if (!opens) continue;
      const double amount =
          std::min(1.0, 0.35 + 0.30 * exact::log10(static_cast<double>(area) / min_side_km2));
      for (int v = std::max(0, y - reach); v < std::min(height, y + reach + 1); ++v)
        for (int u = std::max(0, x - reach); u < std::min(width, x + reach + 1); ++u) {
          const double d2 = (u - x) * (u - x) + (v - y) * (v - y);
          near(u, v) = std::max(
              near(u, v), static_cast<float>(amount * exact::exp(-0.5 * d2 / (sigma * sigma))));
        }
    }
  }
  return near;
}

// Distance to the nearest stream of some size, m; large if there is none.
Grid<float> distance_to_rivers(const TownGround& g, double cell_m) {
  Grid<std::uint8_t> streams(g.floor.width(), g.floor.height(), 0);
  for (std::size_t i = 0; i < streams.size(); ++i)
    streams[i] = g.catchment_km2[i] >= river_km2 ? 1 : 0;
  return distance_to_marked_m(streams, cell_m);
}

// Positions in a grid of squares for fast neighbour search: a terrain as wide as a continent has a
// hundred thousand settlements.
class NearPlaces {
 public:
  void add(glm::dvec2 position, std::size_t index) {
    squares_[square(column(position.x), column(position.y))].push_back(index);
  }
  // Whether f is true for the index of any position in the squares that a circle touches; some are
  // outside the circle.
  template <class F>
  bool any_near(glm::dvec2 position, double reach_m, F&& f) const {
    for (std::int64_t y = column(position.y - reach_m); y <= column(position.y + reach_m); ++y)
      for (std::int64_t x = column(position.x - reach_m); x <= column(position.x + reach_m); ++x)
        if (const auto found = squares_.find(square(x, y)); found != squares_.end())
          if (std::any_of(found->second.begin(), found->second.end(), f)) return true;
    return false;
  }

 private:
  static constexpr double side_m = 4000.0;
  static std::int64_t column(double along) {
    return static_cast<std::int64_t>(std::floor(along / side_m));
  }
  static std::int64_t square(std::int64_t x, std::int64_t y) {
    return y * (std::int64_t{1} << 24) + x;
  }
  std::unordered_map<std::int64_t, std::vector<std::size_t>> squares_;
};

// The best cell of each block, if it is habitable.
std::vector<Candidate> find_candidates(const TownGround& g, const TownParameters& p,
                                       double cell_m) {
  const int width = g.floor.width();
  const int height = g.floor.height();
  const Grid<float> mouths = valley_mouths(g, cell_m);
  const Grid<float> rivers = distance_to_rivers(g, cell_m);
  const Grid<float> room = gaussian_blur(g.floor, 800.0 / cell_m);
  const Grid<float> around = gaussian_blur(g.floor, plain_m / cell_m);
  const Grid<float> level = gaussian_blur(g.slope_deg, 120.0 / cell_m);
  const int block = std::max(1, static_cast<int>(block_m / cell_m));
  const auto few = static_cast<float>(1.0 - p.inferred);
  const std::uint64_t key = stream_seed(p.seed, Stream::towns);
  // Rows of blocks in parallel, joined in their order.
  std::vector<std::vector<Candidate>> rows(static_cast<std::size_t>((height + block - 1) / block));
  parallel_rows(static_cast<int>(rows.size()), [&](int row) {
    const int by = row * block;
    std::vector<Candidate>& found = rows[static_cast<std::size_t>(row)];
    for (int bx = 0; bx < width; bx += block) {
      Candidate best{-1.F, -1, true};
      Candidate terrace{-1.F, -1, false};
      const auto chance = static_cast<float>(random_uniform(key, bx / block, by / block, 1));
      const auto luck = static_cast<float>(random_uniform(key, bx / block, by / block, 7));
      for (int y = by; y < std::min(height, by + block); ++y) {
        for (int x = bx; x < std::min(width, bx + block); ++x) {
          const float z = g.altitude_m(x, y);
          const auto cell = static_cast<std::int32_t>(g.floor.index(x, y));
          if (static_cast<double>(z) > p.highest_m) continue;
          if (g.suitability != nullptr &&
              (*g.suitability)(x, y) + static_cast<float>(p.inferred) <= luck)
            continue;
          const float low = std::clamp((static_cast<float>(p.highest_m) - z) / 500.F, 0.F, 1.F);
          if (g.floor(x, y) >= 0.5F) {
            // Next to the river, not in it.
            const float away = rivers(x, y);
            const float bank =
                away < 130.F
                    ? -0.6F
                    : exact::exp(-0.5F * (away - 350.F) * (away - 350.F) / (450.F * 450.F));
            // Space is good, but inside a plain all positions are equally good: only rivers and
            // edges attract villages there.
            const float lost = few * std::clamp((around(x, y) - 0.75F) / 0.2F, 0.F, 1.F);
            const float score = 0.95F * mouths(x, y) + 0.60F * bank + 0.70F * (room(x, y) - lost) +
                                0.35F * low + 0.35F * chance;
            if (score > best.score) best = {score, cell, true};
          } else if (level(x, y) < 11.F &&
                     around(x, y) + static_cast<float>(p.inferred) > min_floor) {
            const float score = 0.5F * g.south(x, y) + 0.5F * low + chance - 0.03F * level(x, y);
            if (score > terrace.score) terrace = {score, cell, false};
          }
        }
      }
      if (best.cell >= 0) found.push_back(best);
      if (terrace.cell >= 0) found.push_back(terrace);
    }
  });
  std::vector<Candidate> candidates;
  for (const std::vector<Candidate>& row : rows)
    candidates.insert(candidates.end(), row.begin(), row.end());
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.score != b.score ? a.score > b.score : a.cell < b.cell;
  });
  return candidates;
}

// Second moments of cells about their centroid.
struct Moments {
  double weight = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  void add(double w, double dx, double dy) {
    weight += w;
    x += w * dx;
    y += w * dy;
    xx += w * dx * dx;
    xy += w * dx * dy;
    yy += w * dy * dy;
  }
  // (cos 2a, sin 2a) of the long axis times the elongation, 0 round … 1 a line.
  glm::dvec2 axis() const {
    if (weight <= 0.0) return glm::dvec2(0.0);
    const double cxx = xx - x * x / weight;
    const double cxy = xy - x * y / weight;
    const double cyy = yy - y * y / weight;
    return glm::dvec2(cxx - cyy, 2.0 * cxy) / std::max(cxx + cyy, 1e-9);
  }
};

// Streets follow a nearby river, else the valley, on a slope the contour.
void take_direction(const TownGround& g, std::int32_t cell, double cell_m, TownSite& site) {
  const int cx = cell % g.floor.width();
  const int cy = cell / g.floor.width();
  const int reach = static_cast<int>(1100.0 / cell_m);
  Moments ground;
  Moments river;
  for (int y = std::max(0, cy - reach); y < std::min(g.floor.height(), cy + reach + 1); ++y)
    for (int x = std::max(0, cx - reach); x < std::min(g.floor.width(), cx + reach + 1); ++x) {
      const double dx = x - cx;
      const double dy = cy - y;
      if (dx * dx + dy * dy > reach * reach) continue;
      const double rise = static_cast<double>(g.altitude_m(x, y) - g.altitude_m(cx, cy));
      ground.add(
          site.on_floor ? static_cast<double>(g.floor(x, y)) : 1.0 / (1.0 + 0.02 * rise * rise), dx,
          dy);
      if (g.catchment_km2(x, y) >= river_km2) river.add(1.0, dx, dy);
    }
  const glm::dvec2 axis = ground.axis() + 1.5 * river.axis();
  const double clear = std::min(1.0, glm::length(axis));
  if (clear > 0.0) site.along_rad = 0.5 * exact::atan2(axis.y, axis.x);
  site.stretch = 1.0 + 1.1 * clear;
}

// Share of the straight line between two positions that lies on valley floors.
double open_share(const TownGround& g, glm::dvec2 a, glm::dvec2 b) {
  const double length = glm::length(b - a);
  const int steps = std::max(2, static_cast<int>(length / 60.0));
  int open = 0;
  for (int k = 0; k <= steps; ++k) {
    const glm::dvec2 position = a + (b - a) * (static_cast<double>(k) / steps);
    const glm::dvec2 at = g.transform.to_cell(position.x, position.y);
    open += g.floor.clamped(static_cast<int>(std::lround(at.x)),
                            static_cast<int>(std::lround(at.y))) > 0.4F
                ? 1
                : 0;
  }
  return static_cast<double>(open) / (steps + 1);
}

// The cells around a segment, half open.
PixelRect cells_near(const TownGround& g, glm::dvec2 a, glm::dvec2 b, double margin_m) {
  const glm::dvec2 low =
      g.transform.to_cell(std::min(a.x, b.x) - margin_m, std::max(a.y, b.y) + margin_m);
  const glm::dvec2 high =
      g.transform.to_cell(std::max(a.x, b.x) + margin_m, std::min(a.y, b.y) - margin_m);
  return {std::max(0, static_cast<int>(low.x)), std::max(0, static_cast<int>(low.y)),
          std::min(g.floor.width() - 1, static_cast<int>(high.x) + 1) + 1,
          std::min(g.floor.height() - 1, static_cast<int>(high.y) + 1) + 1};
}

// Each cell takes the maximum over towns and links. Roots and quotients are computed only if an
// upper bound, wider than rounding errors, exceeds the current value.
constexpr double slack = 1e-4;

// One town: 1 - distance / radius, where the distance along its streets is divided by its stretch.
void raise_town(const TownGround& g, const TownSite& site, const PixelRect& box,
                Grid<float>& field) {
  const glm::dvec2 along{exact::cos(site.along_rad), exact::sin(site.along_rad)};
  const double per_stretch2 = 1.0 / (site.stretch * site.stretch);
  for (int y = box.y0; y < box.y1; ++y) {
    float* out = field.row(y);
    for (int x = box.x0; x < box.x1; ++x) {
      const glm::dvec2 off = g.transform.to_crs(x, y) - site.position;
      const double stretched = glm::dot(off, along);
      const double v = off.x * along.y - off.y * along.x;
      const double within = (1.0 + slack - static_cast<double>(out[x])) * site.radius_m;
      if (stretched * stretched * per_stretch2 + v * v > within * within) continue;
      const double u = stretched / site.stretch;
      out[x] = std::max(out[x], static_cast<float>(1.0 - std::sqrt(u * u + v * v) / site.radius_m));
    }
  }
}

// Houses along the road between two towns, fewer farther out.
struct TownLink {
  const TownSite* from;
  const TownSite* to;
  PixelRect cells;
};

void raise_link(const TownGround& g, const TownLink& link, const PixelRect& box,
                Grid<float>& field) {
  const TownSite* sites[2] = {link.from, link.to};
  const glm::dvec2 way = link.to->position - link.from->position;
  const double length = glm::length(way);
  const double widest = length * (40.0 + 0.10 * std::max(link.from->radius_m, link.to->radius_m));
  for (int y = box.y0; y < box.y1; ++y) {
    float* out = field.row(y);
    for (int x = box.x0; x < box.x1; ++x) {
      const glm::dvec2 off = g.transform.to_crs(x, y) - link.from->position;
      // The distance to the line through both is never greater than that to the road between them.
      if (std::abs(off.x * way.y - off.y * way.x) >
          widest * (1.0 + slack - static_cast<double>(out[x])))
        continue;
      const double t = std::clamp(glm::dot(off, way) / (length * length), 0.0, 1.0);
      const double aside = glm::length(off - t * way);
      const double gone_m[2] = {t * length, (1.0 - t) * length};
      for (int k = 0; k < 2; ++k) {
        const double half = 40.0 + 0.10 * sites[k]->radius_m;
        const double left =
            1.0 - gone_m[k] / (2.1 * sites[k]->radius_m * std::sqrt(sites[k]->stretch));
        out[x] = std::max(out[x], static_cast<float>(std::min(0.45 * left, 1.0 - aside / half)));
      }
    }
  }
}

}  // namespace

float agricultural_suitability(float moisture, float temperature_c) {
  // Rain-fed farming becomes possible where plants get half of the water they could use, and is
  // safe at two thirds; barley ripens down to an annual mean of about 2 °C (the highest villages of
  // the Alps and of Norway).
  const auto ramp = [](float value, float none, float all) {
    const float t = std::clamp((value - none) / (all - none), 0.F, 1.F);
    return t * t * (3.F - 2.F * t);
  };
  return ramp(moisture, 0.45F, 0.66F) * ramp(temperature_c, 0.F, 3.5F);
}

std::vector<TownSite> find_town_sites(const TownGround& g, const TownParameters& p) {
  const double cell_m = 0.5 * (g.transform.cell_x + g.transform.cell_y);
  std::vector<TownSite> sites;
  NearPlaces positions;
  double widest_m = 0.0;  // of all sites
  const auto found = [&](const TownSite& site) {
    widest_m = std::max(widest_m, site.radius_m * site.stretch);
    positions.add(site.position, sites.size());
    sites.push_back(site);
  };
  for (const KnownTown& town : p.known) {
    if (town.radius_m <= 0.0) continue;
    TownSite site{town.position, town.radius_m, 1.0, 0.0, true};
    const glm::dvec2 at = g.transform.to_cell(town.position.x, town.position.y);
    const int x = static_cast<int>(std::lround(at.x));
    const int y = static_cast<int>(std::lround(at.y));
    if (g.floor.contains(x, y))
      take_direction(g, static_cast<std::int32_t>(g.floor.index(x, y)), cell_m, site);
    // The radius is that of a circle with the area of the town.
    site.radius_m /= std::sqrt(site.stretch);
    found(site);
  }
  if (p.amount <= -1.0) return sites;

  const std::vector<Candidate> candidates = find_candidates(g, p, cell_m);
  const auto is_free = [&](const Candidate& c, double spacing_m) {
    const glm::dvec2 here = g.transform.to_crs(c.cell % g.floor.width(), c.cell / g.floor.width());
    const double reach_m = 1.0 + std::max(spacing_m, 0.5 * spacing_m + 1.3 * widest_m);
    return !positions.any_near(here, reach_m, [&](std::size_t index) {
      const TownSite& site = sites[index];
      return distance_m(g, site.position, c.cell) <
             std::max(spacing_m, 0.5 * spacing_m + 1.3 * site.radius_m * site.stretch);
    });
  };
  const double closer = exact::exp2(-0.9 * p.amount);
  const double larger = 1.0 + 0.35 * p.amount;
  const double smaller = Density{0.72, 1.0}.at(p.inferred);
  const auto resolve = [&](const Candidate& c, double radius_m) {
    TownSite site{g.transform.to_crs(c.cell % g.floor.width(), c.cell / g.floor.width()),
                  radius_m * larger, 1.0, 0.0, c.on_floor};
    take_direction(g, c.cell, cell_m, site);
    found(site);
  };
  const std::uint64_t key = stream_seed(p.seed, Stream::towns);
  const auto chance = [&](const Candidate& c, std::uint64_t draw) {
    return random_uniform(key, c.cell, 0, draw);
  };
  for (const Candidate& c : candidates)
    if (c.on_floor && c.score > 1.45F && is_free(c, town_spacing_m.at(p.inferred) * closer))
      resolve(c,
              smaller * (260.0 + 330.0 * std::clamp(static_cast<double>(c.score) - 1.3, 0.0, 1.0) +
                         140.0 * chance(c, 2)));
  for (const Candidate& c : candidates)
    if (c.on_floor && c.score > 0.75F - 0.25F * static_cast<float>(p.amount) &&
        is_free(c, village_spacing_m.at(p.inferred) * closer * (0.7 + 0.9 * chance(c, 3)))) {
      const double u = chance(c, 4);
      resolve(c, smaller * (95.0 + 170.0 * u * u));
    }
  for (const Candidate& c : candidates)
    if (!c.on_floor && c.score > 0.95F - 0.3F * static_cast<float>(p.amount) &&
        is_free(c, hamlet_spacing_m.at(p.inferred) * closer * (0.7 + 0.9 * chance(c, 5)))) {
      const double u = chance(c, 6);
      resolve(c, smaller * (60.0 + 110.0 * u * u));
    }
  return sites;
}

Grid<float> town_field(const std::vector<TownSite>& sites, const TownGround& g) {
  std::vector<PixelRect> boxes;
  for (const TownSite& site : sites)
    boxes.push_back(
        cells_near(g, site.position, site.position, site.radius_m * site.stretch * 5.0));
  // Houses follow the roads out of a town towards its neighbours.
  std::vector<TownLink> links;
  NearPlaces before;
  double widest_m = 0.0;
  for (std::size_t b = 0; b < sites.size(); ++b) {
    if (!sites[b].on_floor) continue;
    before.any_near(
        sites[b].position, 1.0 + link_m + 2.0 * (sites[b].radius_m + widest_m), [&](std::size_t a) {
          const double length = glm::length(sites[b].position - sites[a].position);
          if (length > link_m + 2.0 * (sites[a].radius_m + sites[b].radius_m) || length < 1.0)
            return false;
          const PixelRect cells = cells_near(g, sites[a].position, sites[b].position, 200.0);
          if (cells.empty() || open_share(g, sites[a].position, sites[b].position) < 0.85)
            return false;
          links.push_back({&sites[a], &sites[b], cells});
          return false;
        });
    before.add(sites[b].position, b);
    widest_m = std::max(widest_m, sites[b].radius_m);
  }
  // A maximum does not depend on the order, so bands of rows may run in parallel.
  Grid<float> field(g.floor.width(), g.floor.height(), outermost);
  constexpr int band = 64;
  parallel_rows((field.height() + band - 1) / band, [&](int b) {
    const PixelRect rows{0, b * band, field.width(), std::min(field.height(), (b + 1) * band)};
    for (std::size_t i = 0; i < sites.size(); ++i)
      raise_town(g, sites[i], intersection(boxes[i], rows), field);
    for (const TownLink& link : links) raise_link(g, link, intersection(link.cells, rows), field);
  });
  return field;
}

double town_radius_m(double population) {
  constexpr double m2_a_head = 170.0;
  return std::sqrt(population * m2_a_head / std::numbers::pi);
}

std::vector<KnownTown> read_towns(const VectorSource& source, const std::string& crs,
                                  Progress& progress) {
  const std::string& path = source.path;
  const PointTable table = read_points(source, crs);
  const int name = table.find("name");
  const int radius = table.find("radius_m");
  const int population = table.find("population");
  if (radius < 0 && population < 0)
    throw Error(ErrorKind::usage, path,
                fmt::format("no column with the size of towns; the columns are {}",
                            fmt::join(table.columns, ", ")),
                "radius_m or population");
  std::vector<KnownTown> towns;
  for (const PointTable::Point& point : table.points) {
    constexpr double max_size = 1e9;
    double radius_m = table.number(point, radius, 0.0, max_size).value_or(0.0);
    if (radius_m == 0.0)
      radius_m = town_radius_m(table.number(point, population, 0.0, max_size).value_or(0.0));
    if (radius_m > largest_town_radius_m)
      throw Error(ErrorKind::usage, point.where, fmt::format("town radius of {:.0f} m", radius_m),
                  fmt::format("at most {} m", largest_town_radius_m));
    if (radius_m > 0.0)
      towns.push_back(
          {.position = point.position,
           .radius_m = radius_m,
           .name = name < 0 ? std::string() : point.values[static_cast<std::size_t>(name)]});
  }
  if (towns.size() < table.points.size())
    progress.note(
        fmt::format("{}: {} of {} towns have neither radius_m nor population and are left out",
                    path, table.points.size() - towns.size(), table.points.size()));
  return towns;
}

}  // namespace belvedere
