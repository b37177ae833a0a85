#include "renderer/exemplar/painting_colours.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace belvedere {
namespace {

// Rivers go with the painting's water, or with the ground that they run through.
TEST(WaterShift, IsThatOfThePaintedWaterOrOfTheGroundAroundIt) {
  const Palette summer = read_palette("summer");
  const auto paint = [&](ScannedPainting& scan, LandCoverClass id, glm::vec3 shift) {
    LabelRamps& ramps = scan.ramps[static_cast<std::size_t>(id)];
    ramps.distances = {0.0};
    ramps.texels = 100;
    ToneRamp ramp{};
    for (std::size_t t = 0; t < ramp.size(); ++t)
      ramp[t] = palette_colour(summer, id, 1500.0, ramp_tones[t]) + shift;
    ramps.ramps = {ramp};
  };
  EXPECT_EQ(water_shift(summer, {}), glm::vec3(0.F));
  std::vector<ScannedPainting> scans(1);
  paint(scans[0], LandCoverClass::water, {0.04F, -0.02F, -0.06F});
  paint(scans[0], LandCoverClass::snow, {-0.2F, -0.2F, -0.2F});
  const glm::vec3 of_water = water_shift(summer, scans);
  EXPECT_LT(glm::length(of_water - glm::vec3(0.04F, -0.02F, -0.06F)), 0.01F);
  scans[0].ramps[static_cast<std::size_t>(LandCoverClass::water)] = {};
  const glm::vec3 of_snow = water_shift(summer, scans);
  EXPECT_LT(glm::length(of_snow - glm::vec3(-0.2F)), 0.02F) << "nothing else is known";
  paint(scans[0], LandCoverClass::pasture, {0.05F, 0.02F, 0.F});
  const glm::vec3 of_ground = water_shift(summer, scans);
  EXPECT_LT(glm::length(of_ground - glm::vec3(0.05F, 0.02F, 0.F)), 0.01F);
  EXPECT_GT(of_ground.x, 0.F) << "not the snow's";
}

}  // namespace
}  // namespace belvedere
