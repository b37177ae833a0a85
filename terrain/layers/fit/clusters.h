#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/layers/fit/fit_measures.h"

namespace belvedere {

// A colour for clustering: a position in the hue–saturation plane (the last number 0), or in a
// colour space.
using ClusterPlace = std::array<double, 3>;

struct MeansParameters {
  int rounds = 40;         // maximum
  std::uint64_t part = 0;  // of the stream layers_fit
};
// k-means with k-means++ initialization (Arthur and Vassilvitskii 2007). At most `count` centres:
// fewer if there are fewer positions.
std::vector<ClusterPlace> cluster_means(std::span<const ClusterPlace> positions, int count,
                                        const MeansParameters& parameters = {});
std::uint8_t nearest_mean(const ClusterPlace& position, std::span<const ClusterPlace> means);

// A mixture of Gaussians in the plane.
struct MixturePart {
  double weight = 0.0;
  PlanePosition mean;
  double xx = 0.0;  // covariance
  double xy = 0.0;
  double yy = 0.0;
};
struct ClusterParameters {
  std::vector<int> counts = {
      4, 6, 8, 10,
      12};  // numbers of components tried; Bayes' information criterion (Schwarz 1978) selects one
  double join = 0.2;  // components with a larger mean misclassification are one class; ≥ .15
  std::size_t max = 8'000;  // cells that the mixture is fitted to
  int rounds = 80;          // maximum number of expectation-maximization iterations
};
// Classes by colour: the components of a mixture, joined if they overlap (after Hennig 2010), since
// one class that is not Gaussian needs several components. OpenCV fits such mixtures too, but needs
// minutes instead of a second, and its last bits depend on the processor.
struct Clusters {
  std::vector<MixturePart> parts;
  std::vector<std::uint8_t> class_of_part;
  int classes = 0;
};
// Error(input) for fewer than 50 positions.
Clusters find_clusters(std::span<const PlanePosition> positions,
                       const ClusterParameters& parameters = {});
// The most likely class at each position: the sum over its components.
std::vector<std::uint8_t> clusters_at(std::span<const PlanePosition> positions,
                                      const Clusters& clusters);

}  // namespace belvedere
