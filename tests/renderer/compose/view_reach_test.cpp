#include "renderer/compose/view_reach.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

// Level ground of 400 m, 60 km a side, seen northwards from its southern edge.
class Reach : public testing::Test {
 protected:
  ViewReach of(double eye_m, const DeformParameters& deform) {
    CameraParameters camera;
    camera.eye = {viewer_, eye_m};
    camera.width = 800;
    camera.height = 400;
    camera.field_of_view_deg = 44.0;
    camera.pitch_deg = -20.0;
    camera.projection = projection_;
    return find_reach(ground_, Deformation(deform, viewer_), camera);
  }
  CoarseGround ground_ =
      make_coarse_ground(test::synthetic_raster(60.0, [](double, double) { return 400.0; }), 300.0);
  glm::dvec2 viewer_ = test::position_km(30.0, 0.0);
  std::string projection_ = "perspective";
};

// d = √(c² + 2 R h) is where the line of sight touches a bent plain, h the eye over it.
TEST_F(Reach, EndsWhereBentGroundIsHighestInThePicture) {
  const double eye_m = 5400.0, radius_m = 90000.0, crest_m = 30000.0;
  DeformParameters deform;
  deform.bend = {.radius_m = radius_m, .crest_m = crest_m};
  const ViewReach reach = of(eye_m, deform);
  const double horizon = std::sqrt(crest_m * crest_m + 2.0 * radius_m * (eye_m - 400.0));
  EXPECT_NEAR(reach.far_m, horizon, 1.0);
  // The lower edge: half of 2 atan(tan 22° / 2) below the pitch.
  const double edge = std::tan((20.0 * 3.14159265358979 / 180.0) +
                               std::atan(std::tan(22.0 * 3.14159265358979 / 180.0) / 2.0));
  const auto depression = [&](double d) {
    return (eye_m - 400.0 + (d - crest_m) * (d - crest_m) / (2.0 * radius_m)) / d;
  };
  EXPECT_NEAR(depression(reach.near_m), edge, 0.03);
}

TEST_F(Reach, GoesByTheGroundAsItIsRaised) {
  DeformParameters deform;
  deform.exaggeration = 2.0;
  deform.exaggeration_base_m = 0.0;
  deform.bend = {.radius_m = 90000.0, .crest_m = 30000.0};
  EXPECT_NEAR(of(5400.0, deform).far_m, std::sqrt(9e8 + 2.0 * 90000.0 * 4600.0), 1.0);
}

TEST_F(Reach, OfAPlainEndsWithTheData) {
  EXPECT_NEAR(of(5400.0, {}).far_m, 60000.0, 1500.0);
  projection_ = "oblique";
  EXPECT_NEAR(of(5400.0, {}).far_m, 60000.0, 1500.0);
  viewer_ = test::position_km(30.0, 100.0);
  EXPECT_EQ(of(5400.0, {}).far_m, 0.0) << "no data lie in the north";
}

}  // namespace
}  // namespace belvedere
