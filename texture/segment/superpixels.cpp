#include "texture/segment/superpixels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "base/filter.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

Grid<glm::vec3> blurred(const Grid<glm::vec3>& picture, double sigma) {
  Grid<glm::vec3> out(picture.width(), picture.height());
  for (int c = 0; c < 3; ++c) {
    Grid<float> channel(picture.width(), picture.height());
    for (std::size_t i = 0; i < channel.size(); ++i) channel[i] = picture[i][c];
    channel = gaussian_blur(channel, sigma);
    for (std::size_t i = 0; i < channel.size(); ++i) out[i][c] = channel[i];
  }
  return out;
}

struct Centre {
  glm::vec3 colour{0.F};
  float x = 0.F;
  float y = 0.F;
};

// Centres in rows, odd rows shifted by half a step: a honeycomb of `across` × `down`.
struct Lattice {
  int across;
  int down;
  double step_x;
  double step_y;
  glm::dvec2 position(int i, int j) const {
    return {(i + (j % 2 == 0 ? 0.25 : 0.75)) * step_x - 0.5, (j + 0.5) * step_y - 0.5};
  }
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j * across + i); }
};

Lattice make_lattice(int width, int height, int count) {
  const double step = std::sqrt(static_cast<double>(width) * height / std::max(count, 1));
  Lattice lattice{};
  lattice.across = std::clamp(static_cast<int>(width / step + 0.5), 1, width);
  lattice.down = std::clamp(static_cast<int>(height / step + 0.5), 1, height);
  lattice.step_x = static_cast<double>(width) / lattice.across;
  lattice.step_y = static_cast<double>(height) / lattice.down;
  return lattice;
}

// Each pixel goes to the best of the centres that began near it: a centre moves at most one step,
// so two columns and rows around suffice.
Grid<std::uint16_t> assign(const Grid<glm::vec3>& picture, const Lattice& lattice,
                           const std::vector<Centre>& centres, float compactness) {
  Grid<std::uint16_t> of(picture.width(), picture.height());
  const auto per_x = static_cast<float>(compactness / lattice.step_x);
  const auto per_y = static_cast<float>(compactness / lattice.step_y);
  parallel_rows(picture.height(), [&](int y) {
    const int row = std::min(static_cast<int>(y / lattice.step_y), lattice.down - 1);
    for (int x = 0; x < picture.width(); ++x) {
      const int column = std::min(static_cast<int>(x / lattice.step_x), lattice.across - 1);
      const glm::vec3& colour = picture(x, y);
      float min = std::numeric_limits<float>::infinity();
      for (int j = std::max(row - 1, 0); j <= std::min(row + 1, lattice.down - 1); ++j)
        for (int i = std::max(column - 1, 0); i <= std::min(column + 1, lattice.across - 1); ++i) {
          const Centre& centre = centres[lattice.index(i, j)];
          const glm::vec3 step = colour - centre.colour;
          const float dx = (static_cast<float>(x) - centre.x) * per_x;
          const float dy = (static_cast<float>(y) - centre.y) * per_y;
          const float distance = glm::dot(step, step) + dx * dx + dy * dy;
          if (distance < min) {
            min = distance;
            of(x, y) = static_cast<std::uint16_t>(lattice.index(i, j));
          }
        }
    }
  });
  return of;
}

void move_centres(const Grid<glm::vec3>& picture, const Grid<std::uint16_t>& of,
                  std::vector<Centre>& centres) {
  struct Sum {
    glm::dvec3 colour{0.0};
    double x = 0.0, y = 0.0, count = 0.0;
  };
  std::vector<Sum> sums(centres.size());
  for (int y = 0; y < of.height(); ++y)
    for (int x = 0; x < of.width(); ++x) {
      Sum& sum = sums[of(x, y)];
      sum.colour += picture(x, y);
      sum.x += x;
      sum.y += y;
      sum.count += 1.0;
    }
  for (std::size_t k = 0; k < centres.size(); ++k) {
    const Sum& sum = sums[k];
    if (sum.count > 0.0)
      centres[k] = {glm::vec3(sum.colour / sum.count), static_cast<float>(sum.x / sum.count),
                    static_cast<float>(sum.y / sum.count)};
  }
}

Grid<std::uint16_t> even_cells(const Grid<glm::vec3>& picture,
                               const SuperpixelParameters& parameters) {
  const Lattice lattice =
      make_lattice(picture.width(), picture.height(), std::max(parameters.cells, parameters.count));
  std::vector<Centre> centres;
  for (int j = 0; j < lattice.down; ++j)
    for (int i = 0; i < lattice.across; ++i) {
      const glm::dvec2 position = lattice.position(i, j);
      const glm::vec3& colour =
          picture.clamped(static_cast<int>(position.x + 0.5), static_cast<int>(position.y + 0.5));
      centres.push_back({colour, static_cast<float>(position.x), static_cast<float>(position.y)});
    }
  Grid<std::uint16_t> of;
  for (int round = 0; round < std::max(parameters.rounds, 1); ++round) {
    of = assign(picture, lattice, centres, static_cast<float>(parameters.compactness));
    move_centres(picture, of, centres);
  }
  return of;
}

// Connected pieces of equal values, four neighbours, numbered by rows.
Grid<std::uint32_t> connected_pieces(const Grid<std::uint16_t>& of, std::size_t& count) {
  constexpr std::uint32_t unmet = std::numeric_limits<std::uint32_t>::max();
  Grid<std::uint32_t> piece(of.width(), of.height(), unmet);
  count = 0;
  std::vector<std::pair<int, int>> open;
  for (int y = 0; y < of.height(); ++y)
    for (int x = 0; x < of.width(); ++x) {
      if (piece(x, y) != unmet) continue;
      const auto number = static_cast<std::uint32_t>(count++);
      const auto take = [&, value = of(x, y)](int px, int py) {
        if (!of.contains(px, py) || piece(px, py) != unmet || of(px, py) != value) return;
        piece(px, py) = number;
        open.emplace_back(px, py);
      };
      take(x, y);
      while (!open.empty()) {
        const auto [px, py] = open.back();
        open.pop_back();
        take(px - 1, py);
        take(px + 1, py);
        take(px, py - 1);
        take(px, py + 1);
      }
    }
  return piece;
}

struct Region {
  glm::dvec3 sum{0.0};
  double pixels = 0.0;
  std::map<std::uint32_t, double> border;  // length of that with each neighbour, px
  std::uint32_t joined = 0;                // number of joins; earlier costs are then invalid
};

// Increase of the sum of squared deviations when two regions are merged, per pixel of the removed
// border.
double cost_of_joining(const Region& a, const Region& b, double border) {
  const glm::dvec3 step = a.sum / a.pixels - b.sum / b.pixels;
  return a.pixels * b.pixels / (a.pixels + b.pixels) * glm::dot(step, step) / border;
}

struct Joint {
  double cost;
  std::uint32_t a, b;  // a < b
  std::uint32_t joined_a, joined_b;
  bool operator>(const Joint& other) const {
    return cost != other.cost ? cost > other.cost : std::pair(a, b) > std::pair(other.a, other.b);
  }
};

std::vector<Region> measure_regions(const Grid<glm::vec3>& picture,
                                    const Grid<std::uint32_t>& piece, std::size_t count) {
  std::vector<Region> regions(count);
  const auto meet = [&](std::uint32_t a, std::uint32_t b) {
    if (a == b) return;
    regions[a].border[b] += 1.0;
    regions[b].border[a] += 1.0;
  };
  for (int y = 0; y < piece.height(); ++y)
    for (int x = 0; x < piece.width(); ++x) {
      Region& region = regions[piece(x, y)];
      region.sum += picture(x, y);
      region.pixels += 1.0;
      if (x > 0) meet(piece(x - 1, y), piece(x, y));
      if (y > 0) meet(piece(x, y - 1), piece(x, y));
    }
  return regions;
}

// The final region of each region.
std::vector<std::uint32_t> join_regions(std::vector<Region> regions, std::size_t wanted) {
  std::priority_queue<Joint, std::vector<Joint>, std::greater<>> joints;
  const auto offer = [&](std::uint32_t a, std::uint32_t b, double border) {
    joints.push({cost_of_joining(regions[a], regions[b], border), std::min(a, b), std::max(a, b),
                 regions[std::min(a, b)].joined, regions[std::max(a, b)].joined});
  };
  for (std::uint32_t a = 0; a < regions.size(); ++a)
    for (const auto& [b, border] : regions[a].border)
      if (a < b) offer(a, b, border);
  std::vector<std::uint32_t> into(regions.size());
  for (std::uint32_t i = 0; i < into.size(); ++i) into[i] = i;
  for (std::size_t left = regions.size(); left > wanted && !joints.empty();) {
    const Joint joint = joints.top();
    joints.pop();
    Region& a = regions[joint.a];
    Region& b = regions[joint.b];
    if (into[joint.a] != joint.a || into[joint.b] != joint.b || a.joined != joint.joined_a ||
        b.joined != joint.joined_b)
      continue;
    into[joint.b] = joint.a;
    a.sum += b.sum;
    a.pixels += b.pixels;
    ++a.joined;
    a.border.erase(joint.b);
    for (const auto& [other, border] : b.border) {
      if (other == joint.a) continue;
      a.border[other] += border;
      regions[other].border.erase(joint.b);
      regions[other].border[joint.a] += border;
    }
    b.border.clear();
    for (const auto& [other, border] : a.border) offer(joint.a, other, border);
    --left;
  }
  // Regions are merged into lower ones, so the final region of a lower one is already known.
  for (std::uint32_t i = 0; i < into.size(); ++i) into[i] = into[into[i]];
  return into;
}

}  // namespace

Superpixels find_superpixels(const Grid<glm::vec3>& picture,
                             const SuperpixelParameters& parameters) {
  const Grid<glm::vec3> seen = blurred(picture, parameters.blur_px);
  std::size_t pieces = 0;
  const Grid<std::uint32_t> piece = connected_pieces(even_cells(seen, parameters), pieces);
  const std::vector<std::uint32_t> into =
      join_regions(measure_regions(seen, piece, pieces),
                   static_cast<std::size_t>(std::max(parameters.count, 1)));
  constexpr std::uint16_t unmet = std::numeric_limits<std::uint16_t>::max();
  std::vector<std::uint16_t> number(pieces, unmet);
  Superpixels out{Grid<std::uint16_t>(picture.width(), picture.height()), 0};
  for (std::size_t i = 0; i < piece.size(); ++i) {
    std::uint16_t& n = number[into[piece[i]]];
    if (n == unmet) n = static_cast<std::uint16_t>(out.count++);
    out.of[i] = n;
  }
  return out;
}

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

// Between two groups: sum of the weights, and number of pairs.
struct Groups {
  std::vector<double> sum;  // count × count
  std::vector<std::size_t> members;
  std::size_t count;
  double mean(std::size_t a, std::size_t b) const {
    return sum[a * count + b] / static_cast<double>(members[a] * members[b]);
  }
};

// The later group with the largest mean weight to this one; none if there is none.
std::size_t best_partner(const Groups& groups, std::size_t a) {
  std::size_t best = none;
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t b = a + 1; b < groups.count; ++b) {
    if (groups.members[b] == 0) continue;
    if (const double mean = groups.mean(a, b); mean > highest) {
      highest = mean;
      best = b;
    }
  }
  return best;
}

}  // namespace

Partition in_order(const Partition& groups) {
  constexpr std::uint16_t unmet = 65535;
  Partition number(65536, unmet);
  Partition out;
  out.reserve(groups.size());
  std::uint16_t next = 0;
  for (const std::uint16_t group : groups) {
    if (number[group] == unmet) number[group] = next++;
    out.push_back(number[group]);
  }
  return out;
}

Partition join_by_mean_weight(const PairWeights& weights) {
  const std::size_t count = weights.count();
  Groups groups{std::vector<double>(count * count, 0.0), std::vector<std::size_t>(count, 1), count};
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
      if (a != b) groups.sum[a * count + b] = weights(a, b);
  Partition of(count);
  for (std::size_t i = 0; i < count; ++i) of[i] = static_cast<std::uint16_t>(i);
  std::vector<std::size_t> partner(count);
  for (std::size_t a = 0; a < count; ++a) partner[a] = best_partner(groups, a);
  for (;;) {
    std::size_t a = none;
    double highest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      if (groups.members[i] == 0 || partner[i] == none) continue;
      if (const double mean = groups.mean(i, partner[i]); mean > highest) {
        highest = mean;
        a = i;
      }
    }
    if (a == none) return in_order(of);
    const std::size_t b = partner[a];
    for (std::size_t c = 0; c < count; ++c) {
      groups.sum[a * count + c] += groups.sum[b * count + c];
      groups.sum[c * count + a] = groups.sum[a * count + c];
    }
    groups.members[a] += groups.members[b];
    groups.members[b] = 0;
    for (std::uint16_t& group : of)
      if (group == b) group = static_cast<std::uint16_t>(a);
    // Only means to one of the two have changed; a group whose partner was neither may have found a
    // better one in `a`.
    for (std::size_t i = 0; i < count; ++i) {
      if (groups.members[i] == 0) continue;
      if (i == a || partner[i] == a || partner[i] == b) {
        partner[i] = best_partner(groups, i);
      } else if (i < a && partner[i] != none) {
        const double now = groups.mean(i, a);
        const double before = groups.mean(i, partner[i]);
        if (now > before || (now == before && a < partner[i])) partner[i] = a;
      }
    }
  }
}

Partition move_singly(const PairWeights& weights, const Partition& start) {
  const std::size_t count = weights.count();
  Partition of = in_order(start);
  // One group more than things, so that one is always empty: becoming a group of its own is also a
  // move.
  const std::size_t groups = count + 1;
  std::vector<double> pull(count * groups, 0.0);  // of every group on every thing
  std::vector<std::size_t> members(groups, 0);
  for (std::size_t i = 0; i < count; ++i) {
    ++members[of[i]];
    for (std::size_t j = 0; j < count; ++j)
      if (i != j) pull[i * groups + of[j]] += weights(i, j);
  }
  // Smaller gains are rounding errors of sums.
  double scale = 0.0;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b) scale = std::max(scale, std::abs(weights(a, b)));
  const double min = 1e-9 * scale;
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t own = of[i];
      std::size_t best = own;
      double highest = pull[i * groups + own] + min;
      bool empty_seen = false;
      for (std::size_t g = 0; g < groups; ++g) {
        if (g == own || (members[g] == 0 && empty_seen)) continue;
        empty_seen = empty_seen || members[g] == 0;
        const double gain = members[g] == 0 ? 0.0 : pull[i * groups + g];
        if (gain > highest) {
          highest = gain;
          best = g;
        }
      }
      if (best == own) continue;
      --members[own];
      ++members[best];
      of[i] = static_cast<std::uint16_t>(best);
      for (std::size_t j = 0; j < count; ++j) {
        if (j == i) continue;
        pull[j * groups + own] -= weights(i, j);
        pull[j * groups + best] += weights(i, j);
      }
      moved = true;
    }
  }
  return in_order(of);
}

Partition partition_cliques(const PairWeights& weights) {
  return move_singly(weights, join_by_mean_weight(weights));
}

}  // namespace belvedere
