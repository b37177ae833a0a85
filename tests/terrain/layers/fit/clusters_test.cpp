#include "terrain/layers/fit/clusters.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/layers/fit/fit_measures.h"
#include "tests/terrain/layers/fit/rand_index.h"
#include "tests/terrain/layers/fit/synthetic_picture.h"

namespace belvedere {
namespace {

using test::adjusted_rand_index;

std::vector<PlanePosition> positions_of(const Grid<glm::vec3>& rgb) {
  std::vector<PlanePosition> positions;
  for (const glm::vec3& colour : rgb)
    positions.push_back(hue_saturation_place(hue_saturation_of(colour)));
  return positions;
}

TEST(AdjustedRandIndex, AsHubertAndArabieHaveIt) {
  const std::vector<std::uint8_t> a = {0, 0, 0, 1, 1, 1};
  EXPECT_DOUBLE_EQ(adjusted_rand_index(a, std::vector<std::uint8_t>{5, 5, 5, 2, 2, 2}), 1.0);
  // Tables [[2 1 0] [0 1 2]]: (2 - 3·6/15 …): pairs together 2, in a 6, in b 3, of 15.
  EXPECT_NEAR(adjusted_rand_index(a, std::vector<std::uint8_t>{0, 0, 1, 1, 2, 2}),
              (2.0 - 6.0 * 3.0 / 15.0) / (4.5 - 6.0 * 3.0 / 15.0), 1e-12);
}

TEST(ClusterMeans, FindHeapsFarApart) {
  std::vector<ClusterPlace> positions;
  for (int i = 0; i != 300; ++i) {
    const double heap = i % 3;
    positions.push_back({10.0 * heap + 0.1 * random_normal(1, i, 0),
                         heap * heap + 0.1 * random_normal(1, i, 1), 0.0});
  }
  std::vector<ClusterPlace> means = cluster_means(positions, 3);
  std::sort(means.begin(), means.end());
  for (std::size_t k = 0; k != 3; ++k) {
    EXPECT_NEAR(means[k][0], 10.0 * static_cast<double>(k), 0.05);
    EXPECT_NEAR(means[k][1], static_cast<double>(k * k), 0.05);
  }
  EXPECT_EQ(cluster_means(std::vector<ClusterPlace>(20, ClusterPlace{1.0, 2.0, 3.0}), 4).size(),
            1U);
}

TEST(FindClusters, SyntheticPictureIsDividedAsItWasMade) {
  const Grid<float> ground = synthetic::hills(256, 256);
  const synthetic::Picture picture = synthetic::seven_classes(ground, {140.0, 40.0, 0.0}, 4.0);
  const std::vector<PlanePosition> positions = positions_of(picture.rgb);
  const Clusters clusters = find_clusters(positions);
  EXPECT_GE(clusters.classes, 4);
  EXPECT_LE(clusters.classes, static_cast<int>(clusters.parts.size()));
  EXPECT_GE(adjusted_rand_index(clusters_at(positions, clusters), picture.classes), 0.73);
}

// The smallest number of components tried exceeds what these clusters need: inseparable ones are
// one class.
TEST(FindClusters, PartsThatOverlapAreJoined) {
  std::vector<PlanePosition> positions;
  for (int i = 0; i != 6'000; ++i) {
    const double x = i % 3 == 0 ? -0.6 : 0.3;
    positions.push_back({x + 0.05 * random_normal(4, i, 1), 0.1 + 0.05 * random_normal(4, i, 2)});
  }
  const Clusters joined = find_clusters(positions);
  EXPECT_EQ(joined.classes, 2);
  EXPECT_GT(joined.parts.size(), 2U);
  EXPECT_GT(find_clusters(positions, {.join = 2.0}).classes, 2);
}

TEST(FindClusters, OneThreadOrTwoGiveTheSameParts) {
  const std::vector<PlanePosition> positions =
      positions_of(synthetic::seven_classes(synthetic::hills(96, 96), {140.0, 40.0, 0.0}, 4.0).rgb);
  const auto first_mean = [&](int threads) {
    const ThreadLimit limit(threads);
    const Clusters clusters = find_clusters(positions);
    return std::pair(clusters.parts[0].mean.x, clusters.parts[0].xx);
  };
  EXPECT_EQ(first_mean(1), first_mean(2));
}

TEST(FindClusters, TooFewPlacesAreAnError) {
  EXPECT_THROW(find_clusters(std::vector<PlanePosition>(10)), Error);
}

}  // namespace
}  // namespace belvedere
