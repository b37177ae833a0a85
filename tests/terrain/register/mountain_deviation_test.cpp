#include "terrain/register/mountain_deviation.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "base/math.h"
#include "terrain/register/pair_fit.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

const glm::dvec2 summit(684000.0, 5255000.0);
constexpr double raise_sigma = 2.0;  // of the unknown

// A mountain that stands still, of which only the raise is open, with a place whose residual is so
// many times its noise.
Registration raised_by(double residual) {
  const std::vector<ControlPair> pairs = test::synthetic_places(40);
  const test::SyntheticView view = test::synthetic_view(ViewKind::plane, pairs);
  Registration out;
  out.scale = 2.0;
  out.frame = view.frame;
  out.view = view.view;
  out.mountains = {{summit, view.frame.extent_m, {}}};
  const std::size_t unknowns = view_unknown::count + MovedMountain::unknowns;
  out.view_covariance = Matrix(unknowns, unknowns);
  out.view_covariance(unknowns - 1, unknowns - 1) = square(raise_sigma);
  out.displacement = field_of_extent(view.frame.extent_m, 0.12);
  out.displacement.places = {{summit, {50.0 * residual, 20.0 * residual}, {50.0, 20.0}}};
  return out;
}

TEST(MountainDeviation, IsWhatTheOpenUnknownMovesInThePicture) {
  const Registration found = raised_by(0.0);
  const ControlPair place{.position = summit + glm::dvec2(300.0, 0.0), .altitude_m = 1800.0};
  const auto pixel = [&](double raise_m) {
    ControlPair raised = place;
    raised.altitude_m += raise_m;
    return test::pixel_of({found.frame, found.view}, raised);
  };
  const double px_per_m = glm::length(pixel(1.0) - pixel(-1.0)) / 2.0;
  const double sigma_px =
      found.scale * px_per_m * raise_sigma * MovedMountain::raise * found.frame.extent_m;
  EXPECT_GT(sigma_px, 1.0);
  EXPECT_NEAR(MountainDeviation(found).variance_px2(place.position, place.altitude_m),
              0.5 * square(sigma_px), 1e-3 * square(sigma_px));
}

TEST(MountainDeviation, GrowsWithTheResidualsOnTheMountain) {
  const auto variance = [](double residual) {
    return MountainDeviation(raised_by(residual)).variance_px2(summit, 1800.0);
  };
  EXPECT_EQ(variance(0.9), variance(0.0)) << "within the noise";
  EXPECT_NEAR(variance(3.0), 9.0 * variance(0.0), 1e-9 * variance(3.0));
  EXPECT_NEAR(variance(50.0), 25.0 * variance(0.0), 1e-9 * variance(50.0)) << "at most";
}

TEST(MountainDeviation, IsNoneBesideMountains) {
  const Registration found = raised_by(3.0);
  const double radius_m = handle_of(found.mountains.front()).radius_m;
  EXPECT_EQ(
      MountainDeviation(found).variance_px2(summit + glm::dvec2(0.0, 1.01 * radius_m), 1800.0),
      0.0);
  Registration still = found;
  still.mountains.clear();
  EXPECT_EQ(MountainDeviation(still).variance_px2(summit, 1800.0), 0.0);
}

}  // namespace
}  // namespace belvedere
