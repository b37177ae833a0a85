#include "renderer/world/valley_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// A level perspective 90° wide: its plane lies half a width before the eye, so that the picture's
// rim is seen at a slope of (height / width) · cos(angle off the middle).
TEST(SightLines, OfALevelPerspective) {
  CameraParameters camera;
  camera.width = 400;
  camera.height = 100;
  camera.azimuth_deg = 30.0;
  camera.pitch_deg = 0.0;
  camera.field_of_view_deg = 90.0;
  const std::vector<SightLine> lines = sight_lines(camera, 9);
  ASSERT_EQ(lines.size(), 9U);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double off_deg = lines[i].azimuth_deg - 30.0;
    EXPECT_NEAR(off_deg, (static_cast<double>(i) - 4.0) * 10.0, 0.2) << "evenly spaced";
    EXPECT_NEAR(lines[i].highest, 0.25 * std::cos(to_radians(off_deg)), 1e-6);
    EXPECT_NEAR(lines[i].lowest, -0.25 * std::cos(to_radians(off_deg)), 1e-6);
  }
}

TEST(SightLines, ParallelOnesMeetInNoEye) {
  CameraParameters camera;
  camera.projection = "oblique";
  EXPECT_THAT(test::message_of(ErrorKind::usage, [&] { sight_lines(camera, 9); }),
              AllOf(HasSubstr("camera.projection"), HasSubstr("\"perspective\"")));
}

TEST(KnownAltitude, IsVoidWhereSomethingWasFilled) {
  Raster<float> raster{Grid<float>(8, 8, 100.F), {0.0, 0.0, 10.0, 10.0}, {}};
  raster.cells(3, 4) = NAN;
  const Grid<float> known = known_altitude(make_dem(std::move(raster)));
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(std::isnan(known(x, y)), x == 3 && y == 4) << x << ' ' << y;
}

// The search for a bend tries many on one ground.
TEST(BareView, BentAnewIsAsIfItHadBeenMadeSo) {
  const std::string bend =
      "deform.bend.points=[{ distance_m = 3000, inclination_deg = 15 }, { distance_m = 12000, "
      "inclination_deg = 0 }]";
  const BareView bent = make_bare_view(test::small_scene({bend}), silent_progress());
  BareView again = make_bare_view(test::small_scene(), silent_progress());
  const auto position = [](const BareView& bare) {
    return bare.deformation.point({6000.0, 1000.0, 1000.0});
  };
  EXPECT_NE(position(again), position(bent));
  bend_again(again, bent.view.deform.bend);
  EXPECT_EQ(position(again), position(bent));
}

}  // namespace
}  // namespace belvedere
