#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/layers/fit/hue_saturation.h"

namespace belvedere {

// A place that things are grouped by: a colour in the hue–saturation plane (the last number 0), or in a colour space.
using ClusterPlace = std::array<double, 3>;

struct MeansParameters {
  int rounds = 40;         // at most
  std::uint64_t part = 0;  // of the stream layers_fit
};
// k-means, begun far apart (Arthur and Vassilvitskii 2007). At most `count` middles: fewer where there are fewer places.
std::vector<ClusterPlace> cluster_means(std::span<const ClusterPlace> places, int count, const MeansParameters& parameters = {});
std::uint8_t nearest_mean(const ClusterPlace& place, std::span<const ClusterPlace> means);

// A mixture of Gaussians in the plane.
struct MixturePart {
  double weight = 0.0;
  PlanePlace mean;
  double xx = 0.0;  // covariance
  double xy = 0.0;
  double yy = 0.0;
};
struct ClusterParameters {
  std::vector<int> counts = {4, 6, 8, 10, 12};  // of parts that are tried; Bayes' information criterion (Schwarz 1978) chooses
  double join = 0.2;                            // parts whose cells the other claims by more than this on average are one class; ≥ .15
  std::size_t most = 8'000;                     // cells that the mixture is fitted on
  int rounds = 80;                              // of expectation and maximization, at most
};
// Classes by colour: the parts of a mixture, those that are mistaken for each other joined (after Hennig 2010), since a mixture needs
// several parts for one class that is not Gaussian. OpenCV fits such mixtures too, but in minutes where this takes a second, and its last
// bits hang on the processor.
struct Clusters {
  std::vector<MixturePart> parts;
  std::vector<std::uint8_t> class_of_part;
  int classes = 0;
};
// Error(input) for fewer than 50 places.
Clusters find_clusters(std::span<const PlanePlace> places, const ClusterParameters& parameters = {});
// The class that is the most likely at each place: the sum over its parts.
std::vector<std::uint8_t> clusters_at(std::span<const PlanePlace> places, const Clusters& clusters);

}  // namespace belvedere
