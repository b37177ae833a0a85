#include "terrain/layers/fit/clusters.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/layers/fit/fit_cells.h"

namespace belvedere {
namespace {

constexpr double min_variance =
    1e-4;  // of a component: keeps a repeated colour from becoming a point of infinite density

double squared_distance(const ClusterPlace& a, const ClusterPlace& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i != a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// Terms of a component's log density: ln weight - ½ ln |Σ|, and the inverse of Σ.
struct Density {
  double level = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
};
std::vector<Density> densities_of(const std::vector<MixturePart>& parts) {
  std::vector<Density> densities;
  for (const MixturePart& p : parts) {
    const double determinant = p.xx * p.yy - p.xy * p.xy;
    densities.push_back({exact::log(p.weight) - 0.5 * exact::log(determinant), p.yy / determinant,
                         -p.xy / determinant, p.xx / determinant});
  }
  return densities;
}

// Writes the probability of each component; returns ln of the density there, up to ln 2π.
double posteriors(const PlanePosition& position, const std::vector<MixturePart>& parts,
                  const std::vector<Density>& densities, double* chance) {
  double max = -std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j != parts.size(); ++j) {
    const double dx = position.x - parts[j].mean.x;
    const double dy = position.y - parts[j].mean.y;
    chance[j] =
        densities[j].level - 0.5 * (dx * dx * densities[j].xx + 2.0 * dx * dy * densities[j].xy +
                                    dy * dy * densities[j].yy);
    max = std::max(max, chance[j]);
  }
  double total = 0.0;
  for (std::size_t j = 0; j != parts.size(); ++j) {
    chance[j] = chance[j] - max < -40.0 ? 0.0 : exact::exp(chance[j] - max);
    total += chance[j];
  }
  for (std::size_t j = 0; j != parts.size(); ++j) chance[j] /= total;
  return max + exact::log(total);
}

struct Mixture {
  std::vector<MixturePart> parts;
  double criterion = 0.0;  // smaller is better
};

void maximize(std::span<const PlanePosition> positions, const std::vector<double>& chance,
              std::vector<MixturePart>& parts) {
  const std::size_t count = parts.size();
  for (std::size_t j = 0; j != count; ++j) {
    double weight = 1e-9;
    double x = 0.0;
    double y = 0.0;
    for (std::size_t i = 0; i != positions.size(); ++i) {
      const double c = chance[i * count + j];
      weight += c;
      x += c * positions[i].x;
      y += c * positions[i].y;
    }
    MixturePart part{
        weight / static_cast<double>(positions.size()), {x / weight, y / weight}, 0.0, 0.0, 0.0};
    for (std::size_t i = 0; i != positions.size(); ++i) {
      const double c = chance[i * count + j];
      if (c == 0.0) continue;
      const double dx = positions[i].x - part.mean.x;
      const double dy = positions[i].y - part.mean.y;
      part.xx += c * dx * dx;
      part.xy += c * dx * dy;
      part.yy += c * dy * dy;
    }
    part.xx = part.xx / weight + min_variance;
    part.xy /= weight;
    part.yy = part.yy / weight + min_variance;
    parts[j] = part;
  }
}

Mixture fit_mixture(std::span<const PlanePosition> positions, int wanted, int rounds) {
  constexpr double resolved = 1e-5;  // gain in mean ln density at which iteration ends
  std::vector<ClusterPlace> flat(positions.size());
  for (std::size_t i = 0; i != flat.size(); ++i) flat[i] = {positions[i].x, positions[i].y, 0.0};
  const std::vector<ClusterPlace> means =
      cluster_means(flat, wanted, {.part = 100 + static_cast<std::uint64_t>(wanted)});
  const std::size_t count = means.size();
  std::vector<double> chance(positions.size() * count, 0.0);
  for (std::size_t i = 0; i != flat.size(); ++i)
    chance[i * count + nearest_mean(flat[i], means)] = 1.0;
  Mixture mixture{std::vector<MixturePart>(count), 0.0};
  double likelihood = -std::numeric_limits<double>::infinity();
  std::vector<double> terms(positions.size());
  for (int round = 0; round != rounds; ++round) {
    maximize(positions, chance, mixture.parts);
    const std::vector<Density> densities = densities_of(mixture.parts);
    parallel_ranges(positions.size(), std::size_t{1024}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i)
        terms[i] = posteriors(positions[i], mixture.parts, densities, &chance[i * count]);
    });
    const double before = likelihood;
    likelihood = std::accumulate(terms.begin(), terms.end(), 0.0);
    if (likelihood - before < resolved * static_cast<double>(positions.size())) break;
  }
  // A component has a weight, two numbers of its mean and three of its covariance; weights sum to
  // 1.
  mixture.criterion = -2.0 * likelihood + (6.0 * static_cast<double>(count) - 1.0) *
                                              exact::log(static_cast<double>(positions.size()));
  return mixture;
}

// Repeatedly joins the two groups with the largest mutual misclassification, until none exceeds
// `join`.
std::vector<std::uint8_t> joined_parts(std::span<const PlanePosition> positions,
                                       const std::vector<MixturePart>& parts, double join) {
  const std::size_t count = parts.size();
  const std::vector<Density> densities = densities_of(parts);
  std::vector<double> chance(positions.size() * count);
  for (std::size_t i = 0; i != positions.size(); ++i)
    posteriors(positions[i], parts, densities, &chance[i * count]);
  std::vector<std::size_t> group(count);
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t left = count; left > 2; --left) {
    std::vector<double> claimed(count * count,
                                0.0);  // [group of the cell][assigned group], summed probabilities
    std::vector<double> cells(count, 0.0);
    std::vector<double> of(count);
    for (std::size_t i = 0; i != positions.size(); ++i) {
      std::fill(of.begin(), of.end(), 0.0);
      for (std::size_t j = 0; j != count; ++j) of[group[j]] += chance[i * count + j];
      const auto own =
          static_cast<std::size_t>(std::max_element(of.begin(), of.end()) - of.begin());
      cells[own] += 1.0;
      for (std::size_t j = 0; j != count; ++j) claimed[own * count + j] += of[j];
    }
    double max = 0.0;
    std::size_t from = 0;
    std::size_t to = 0;
    for (std::size_t a = 0; a != count; ++a)
      for (std::size_t b = 0; b != count; ++b) {
        const double share = a == b || cells[a] == 0.0 ? 0.0 : claimed[a * count + b] / cells[a];
        if (share > max) {
          max = share;
          from = b;
          to = a;
        }
      }
    if (max < join) break;
    for (std::size_t& g : group)
      if (g == from) g = to;
  }
  std::vector<std::uint8_t> classes(count);
  std::vector<std::size_t> seen;
  for (std::size_t j = 0; j != count; ++j) {
    const auto at = std::find(seen.begin(), seen.end(), group[j]);
    classes[j] = static_cast<std::uint8_t>(at - seen.begin());
    if (at == seen.end()) seen.push_back(group[j]);
  }
  return classes;
}

}  // namespace

std::vector<ClusterPlace> cluster_means(std::span<const ClusterPlace> positions, int count,
                                        const MeansParameters& parameters) {
  std::vector<ClusterPlace> means;
  if (positions.empty()) return means;
  const std::uint64_t seed = stream_seed(0, Stream::layers_fit, parameters.part);
  means.push_back(
      positions[random_index(static_cast<std::uint32_t>(positions.size()), seed, 0, 0)]);
  std::vector<double> distance(positions.size(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(means.size()) < count) {
    double total = 0.0;
    for (std::size_t i = 0; i != positions.size(); ++i) {
      distance[i] = std::min(distance[i], squared_distance(positions[i], means.back()));
      total += distance[i];
    }
    if (!(total > 0.0)) break;
    const double wanted = total * random_uniform(seed, static_cast<std::int64_t>(means.size()), 0);
    double sum = 0.0;
    std::size_t chosen = 0;
    while (chosen + 1 != positions.size() && (sum += distance[chosen]) <= wanted) ++chosen;
    means.push_back(positions[chosen]);
  }
  for (int round = 0; round != parameters.rounds; ++round) {
    std::vector<ClusterPlace> sums(means.size(), ClusterPlace{});
    std::vector<double> cells(means.size(), 0.0);
    for (const ClusterPlace& position : positions) {
      const std::uint8_t at = nearest_mean(position, means);
      for (std::size_t d = 0; d != position.size(); ++d) sums[at][d] += position[d];
      cells[at] += 1.0;
    }
    bool moved = false;
    for (std::size_t j = 0; j != means.size(); ++j) {
      if (cells[j] == 0.0) continue;
      for (double& v : sums[j]) v /= cells[j];
      moved = moved || sums[j] != means[j];
      means[j] = sums[j];
    }
    if (!moved) break;
  }
  return means;
}

std::uint8_t nearest_mean(const ClusterPlace& position, std::span<const ClusterPlace> means) {
  std::size_t best = 0;
  for (std::size_t j = 1; j < means.size(); ++j)
    if (squared_distance(position, means[j]) < squared_distance(position, means[best])) best = j;
  return static_cast<std::uint8_t>(best);
}

Clusters find_clusters(std::span<const PlanePosition> positions,
                       const ClusterParameters& parameters) {
  constexpr std::size_t fewest = 50;
  if (positions.size() < fewest)
    throw Error(ErrorKind::input, "clusters",
                fmt::format("{} cells with a colour", positions.size()), "at least 50");
  std::vector<PlanePosition> some;
  for (const std::uint32_t i :
       draw_labelled(std::vector<std::uint8_t>(positions.size(), 0), parameters.max, 2))
    some.push_back(positions[i]);
  Mixture best;
  for (const int count : parameters.counts) {
    Mixture mixture = fit_mixture(some, count, parameters.rounds);
    if (best.parts.empty() || mixture.criterion < best.criterion) best = std::move(mixture);
  }
  Clusters clusters{std::move(best.parts), {}, 0};
  clusters.class_of_part = joined_parts(some, clusters.parts, std::max(parameters.join, 0.15));
  for (const std::uint8_t c : clusters.class_of_part)
    clusters.classes = std::max(clusters.classes, c + 1);
  return clusters;
}

std::vector<std::uint8_t> clusters_at(std::span<const PlanePosition> positions,
                                      const Clusters& clusters) {
  const std::vector<Density> densities = densities_of(clusters.parts);
  std::vector<std::uint8_t> at(positions.size());
  parallel_ranges(positions.size(), std::size_t{8192}, [&](std::size_t begin, std::size_t end) {
    std::vector<double> chance(clusters.parts.size());
    std::vector<double> of(static_cast<std::size_t>(clusters.classes));
    for (std::size_t i = begin; i != end; ++i) {
      posteriors(positions[i], clusters.parts, densities, chance.data());
      std::fill(of.begin(), of.end(), 0.0);
      for (std::size_t j = 0; j != chance.size(); ++j) of[clusters.class_of_part[j]] += chance[j];
      at[i] = static_cast<std::uint8_t>(std::max_element(of.begin(), of.end()) - of.begin());
    }
  });
  return at;
}

}  // namespace belvedere
