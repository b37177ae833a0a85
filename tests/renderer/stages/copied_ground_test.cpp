#include "renderer/stages/copied_ground.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>

namespace belvedere {
namespace {

PaintedExemplar flat_exemplar(const char* name, glm::vec3 colour) {
  PaintedExemplar out;
  out.exemplar.name = name;
  out.picture = out.base = Grid<glm::vec3>(1, 1, colour);
  return out;
}

// Pixels from a painting, from the program's sheet and without a texel: water, then one of rock,
// the last half in haze.
TEST(CopyGround, WaterThatNoPaintingLendsGoesWithThePaintings) {
  using enum LandCoverClass;
  CopyPlan plan;
  plan.residual = 0.75;
  plan.exemplars.push_back(flat_exemplar("painting", glm::vec3(0.6F)));
  plan.exemplars.push_back(flat_exemplar("sheet", glm::vec3(0.4F)));
  plan.own_sheets = {false, true};
  MatchField matches(5, 1);
  matches(0, 0) = {0, 0, 0};
  matches(1, 0) = {1, 0, 0};
  PaintDraft draft;
  draft.land_cover = Grid<LandCoverClass>(5, 1, water);
  draft.land_cover(3, 0) = pasture;
  draft.base = Grid<glm::vec3>(5, 1, glm::vec3(0.4F));
  draft.under = Grid<std::uint32_t>(5, 1);
  draft.under_share = Grid<std::uint8_t>(5, 1);
  BasePicture base;
  base.colour = draft.base;
  base.haze = Grid<float>(5, 1);
  base.haze(4, 0) = 0.5F;
  const ModelPaint modelled;
  const SeamPaint with_seam;
  const auto copied = [&] {
    return copy_ground(plan, {matches, modelled, with_seam}, draft, base, draft.land_cover,
                       {0, 0, 5, 1});
  };
  const Grid<glm::vec3> before = copied();
  plan.water_shift = {0.2F, 0.F, -0.4F};
  const Grid<glm::vec3> after = copied();
  const glm::vec3 quarter(0.05F, 0.F, -0.1F);
  const std::array<float, 5> shares = {0.F, 1.F, 1.F, 0.F, 0.5F};
  for (int x = 0; x < 5; ++x)
    EXPECT_LT(
        glm::length(after(x, 0) - before(x, 0) - shares[static_cast<std::size_t>(x)] * quarter),
        1e-6F)
        << x;
}

}  // namespace
}  // namespace belvedere
