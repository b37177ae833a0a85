#include "terrain/register/view_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

constexpr std::array all_kinds = {ViewKind::cylinder, ViewKind::panini, ViewKind::plane};

TEST(ViewModel, TheFrameIsThatOfThePairs) {
  std::vector<ControlPair> pairs(11);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double n = static_cast<double>(i);
    pairs[i].position = {100.0 + 10.0 * n, 50.0 - n};
    pairs[i].altitude_m = 1000.0 - n;
  }
  const ViewFrame frame = view_frame(ViewKind::plane, {1200.0, 500.0}, false, pairs);
  EXPECT_EQ(frame.extent_m, 100.0);
  EXPECT_NEAR(frame.origin.x, 150.0, 1e-9);
  EXPECT_NEAR(frame.origin.y, 45.0, 1e-9);
  EXPECT_EQ(frame.valley_m, 991.0);
}

// A place due north at distance d, and one to the east of the middle by an angle a.
TEST(ViewModel, PixelsHaveTheClosedForms) {
  const double extent = 20000.0, d = 16000.0, a = 0.3, focal = 900.0, q = -0.2;
  const double height = 1200.0, exaggeration = 1.4;
  ViewFrame frame{.size_px = {1200.0, 600.0}, .extent_m = extent, .valley_m = 500.0};
  ViewUnknowns view = {};
  view[view_unknown::log_focal] = std::log(focal);
  view[view_unknown::exaggeration] = exaggeration;
  view[view_unknown::drop] = 0.2;
  view[view_unknown::drop + 1] = 0.05;
  view[view_unknown::bend + 0] = 0.5;
  const double x = d / extent;
  const double drop = (0.2 + 0.05 * x + 0.5 * std::pow(x - 0.4, 3)) * extent;
  const double t = (exaggeration * height - drop) / d;
  EXPECT_NEAR(view_drop_m(frame, view, d), drop, 1e-9);
  EXPECT_NEAR(view_exaggeration(frame, view, d), exaggeration, 1e-12);
  const glm::dvec2 place(d * std::sin(a), d * std::cos(a));
  const auto pixel = [&](ViewKind kind) {
    frame.kind = kind;
    const ViewPixel at = project_in_view(frame, view, place, 500.0 + height);
    return glm::dvec2(at.u.value, at.v.value);
  };
  EXPECT_NEAR(pixel(ViewKind::cylinder).x, 600.0 + focal * a, 1e-9);
  EXPECT_NEAR(pixel(ViewKind::cylinder).y, 300.0 - focal * t, 1e-9);
  view[view_unknown::pitch] = q;
  const double s = 2.0 / (1.0 + std::cos(a));
  EXPECT_NEAR(pixel(ViewKind::panini).x, 600.0 + focal * s * std::sin(a), 1e-9);
  EXPECT_NEAR(pixel(ViewKind::panini).y, 300.0 + focal * std::tan(q) - focal * s * t, 1e-9);
  const double depth = std::cos(q) * std::cos(a) + std::sin(q) * t;
  EXPECT_NEAR(pixel(ViewKind::plane).x, 600.0 + focal * std::sin(a) / depth, 1e-9);
  EXPECT_NEAR(pixel(ViewKind::plane).y,
              300.0 - focal * (std::cos(q) * t - std::sin(q) * std::cos(a)) / depth, 1e-9);
}

TEST(ViewModel, TangentsAreLinearInTheirFactors) {
  const std::vector<ControlPair> places = test::synthetic_places(5);
  test::SyntheticView synthetic = test::synthetic_view(ViewKind::cylinder, places);
  for (std::size_t i = 0; i < 9; ++i)
    synthetic.view[view_unknown::exaggeration + i] += 0.01 * (static_cast<double>(i) + 1.0);
  for (const ControlPair& place : places) {
    const double distance = view_distance_m(synthetic.frame, synthetic.view, place.position);
    const auto factors = tangent_factors(synthetic.frame, distance, place.altitude_m);
    double tangent = 0.0;
    for (std::size_t i = 0; i < 9; ++i)
      tangent += factors[i] * synthetic.view[view_unknown::exaggeration + i];
    EXPECT_NEAR(test::pixel_of(synthetic, place).y, 275.0 - 850.0 * tangent, 1e-9);
  }
}

TEST(ViewModel, DerivativesAreThoseOfDifferences) {
  const std::vector<ControlPair> places = test::synthetic_places(6);
  for (const ViewKind kind : all_kinds) {
    test::SyntheticView synthetic = test::synthetic_view(kind, places);
    for (std::size_t i = 0; i < 9; ++i) synthetic.view[view_unknown::exaggeration + i] += 0.03;
    for (ControlPair place : places) {
      place.pixel = test::pixel_of(synthetic, place) + glm::dvec2(20.0, -10.0);
      const auto values = [&](const ViewUnknowns& view) {
        const ViewPixel pixel =
            project_in_view(synthetic.frame, view, place.position, place.altitude_m, {90.0, 60.0});
        const ViewDisplacement seen = displacement_in_view(synthetic.frame, view, place);
        return std::array{pixel.u, pixel.v, seen.lateral_m, seen.upward_m};
      };
      const auto here = values(synthetic.view);
      for (std::size_t i = 0; i < view_unknown::count; ++i) {
        constexpr double step = 1e-5;
        ViewUnknowns more = synthetic.view, less = synthetic.view;
        more[i] += step, less[i] -= step;
        const auto above = values(more), below = values(less);
        for (std::size_t k = 0; k < here.size(); ++k) {
          const double slope = (above[k].value - below[k].value) / (2.0 * step);
          EXPECT_NEAR(here[k].slope[i], slope, 1e-5 * (1.0 + std::abs(slope)))
              << view_kind_name(kind) << ", value " << k << " by unknown " << i;
        }
      }
    }
  }
}

TEST(ViewModel, DisplacementsAreReadBackFromPixels) {
  std::vector<ControlPair> places = test::synthetic_places(12);
  const Displacement moved{350.0, -140.0};
  for (const ViewKind kind : all_kinds) {
    const test::SyntheticView synthetic = test::synthetic_view(kind, places);
    for (ControlPair& place : places) {
      place.pixel = test::pixel_of(synthetic, place, moved);
      const ViewDisplacement seen = displacement_in_view(synthetic.frame, synthetic.view, place);
      EXPECT_NEAR(seen.lateral_m.value, moved.lateral_m, 1e-6);
      EXPECT_NEAR(seen.upward_m.value, moved.upward_m, 1e-6);
      const double right =
          test::pixel_of(synthetic, place, {moved.lateral_m + 1.0, moved.upward_m}).x;
      const double left =
          test::pixel_of(synthetic, place, {moved.lateral_m - 1.0, moved.upward_m}).x;
      EXPECT_NEAR(std::abs(right - left) / 2.0, seen.px_per_m.lateral_m, 1e-8);
    }
  }
}

TEST(ViewModel, ViewsOfNoPainterAreNotPlausible) {
  std::vector<ControlPair> places = test::synthetic_places(12);
  const test::SyntheticView synthetic = test::synthetic_view(ViewKind::plane, places);
  test::paint(synthetic, places);
  EXPECT_TRUE(is_plausible(synthetic.frame, synthetic.view, places));
  const auto with = [&](std::size_t index, double value) {
    ViewUnknowns view = synthetic.view;
    view[index] = value;
    return is_plausible(synthetic.frame, view, places);
  };
  EXPECT_FALSE(with(view_unknown::log_focal, std::log(100.0)));
  EXPECT_FALSE(with(view_unknown::log_focal, 200.0));
  EXPECT_FALSE(with(view_unknown::east, -30.0));
  EXPECT_FALSE(with(view_unknown::north, std::nan("")));
}

TEST(ViewModel, PriorsVanishWhereTheyExpect) {
  const std::vector<ControlPair> places = test::synthetic_places(5);
  for (const ViewKind kind : all_kinds) {
    test::SyntheticView synthetic = test::synthetic_view(kind, places);
    for (const ViewNumber& prior : view_priors(synthetic.frame, synthetic.view))
      EXPECT_EQ(prior.value, 0.0);
    synthetic.view[view_unknown::middle] = 0.1;
    synthetic.frame.cropped = true;
    double most = 0.0;
    for (const ViewNumber& prior : view_priors(synthetic.frame, synthetic.view))
      most = std::max(most, prior.value);
    EXPECT_NEAR(most, 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace belvedere
