#include "renderer/style/fit/missing_classes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/renderer/style/synthetic_painting.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class MissingClasses : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    test::Landscape landscape = test::make_landscape();
    for (int y = 0; y < 24; ++y)  // a third of the sky is at dusk
      for (int x = 0; x < 54; ++x) landscape.picture(x, y) = from_oklab({0.82, 0.03, 0.05});
    painting_ = new StylePainting(prepare_painting(landscape.picture, landscape.mask));
    law_ = new LightLaw(fit_light_law(*painting_));
    reference_ = new ClassRamps(palette_ramps(read_palette("summer")));
    seen_ = new SeenRamps(fit_class_ramps(*painting_, *law_, *reference_));
  }
  static void TearDownTestSuite() {
    delete painting_;
    delete law_;
    delete reference_;
    delete seen_;
  }
  static DerivedRamps derived(const SeenRamps& seen) {
    return derive_missing_classes(seen, *painting_, *law_, *reference_);
  }
  static StylePainting* painting_;
  static LightLaw* law_;
  static ClassRamps* reference_;
  static SeenRamps* seen_;
};
StylePainting* MissingClasses::painting_ = nullptr;
LightLaw* MissingClasses::law_ = nullptr;
ClassRamps* MissingClasses::reference_ = nullptr;
SeenRamps* MissingClasses::seen_ = nullptr;

TEST_F(MissingClasses, SeenOnesStayAndAllOthersAreThere) {
  const DerivedRamps out = derived(*seen_);
  for (std::size_t c = 1; c < out.ramps.size(); ++c) {
    if (seen_->seen[c]) {
      EXPECT_EQ(out.ramps[c], seen_->ramps[c]);
    }
    EXPECT_GT(out.ramps[c][3].x, out.ramps[c][0].x + 0.1) << land_cover_table[c].name;
  }
  EXPECT_EQ(out.notes.size(), 8U);
}

TEST_F(MissingClasses, WaterIsTheBlueOfTheSkyAndDarker) {
  const DerivedRamps out = derived(*seen_);
  EXPECT_THAT(out.notes, Contains(AllOf(HasSubstr("no water"), HasSubstr("bluest of the sky"))));
  const LabRamp& water_ramp = out.ramps[index_of(water)];
  for (const glm::dvec3& colour : water_ramp) EXPECT_LT(colour.z, 0.0);
  EXPECT_LT(water_ramp[1].x, 0.75);
  EXPECT_NEAR(water_ramp[2].y, -0.02, 0.005);  // the sky's hue, whatever the ground's light does
  EXPECT_NEAR(water_ramp[2].z, -0.06, 0.005);
}

// Scree differs from rock about as in the reference.
TEST_F(MissingClasses, ARelativeThatWasSeenServes) {
  const DerivedRamps out = derived(*seen_);
  EXPECT_THAT(out.notes, Contains(AllOf(HasSubstr("no scree"), HasSubstr("from rock"))));
  EXPECT_THAT(out.notes, Contains(AllOf(HasSubstr("no alpine grass"), HasSubstr("from pasture"))));
  const std::size_t s = index_of(scree);
  const std::size_t r = index_of(rock);
  EXPECT_NEAR(out.ramps[s][1].x - out.ramps[r][1].x,
              0.9 * ((*reference_)[s][1].x - (*reference_)[r][1].x), 0.05);
}

// Without snow and ice they are derived as the lightest classes; without a green class, the
// painting's green is used.
TEST_F(MissingClasses, WithoutARelativeTheWholeGroundServes) {
  SeenRamps rock_only = *seen_;
  for (std::size_t c = 0; c < rock_only.seen.size(); ++c) rock_only.seen[c] = c == index_of(rock);
  const DerivedRamps out = derived(rock_only);
  EXPECT_THAT(out.notes, Contains(AllOf(HasSubstr("no snow"), HasSubstr("lightest thing"))));
  EXPECT_THAT(out.notes, Contains(AllOf(HasSubstr("no pasture"), HasSubstr("green"))));
  EXPECT_GT(out.ramps[index_of(snow)][3].x, 0.9);
  EXPECT_LT(out.ramps[index_of(pasture)][2].y, 0.0);
  EXPECT_GT(out.ramps[index_of(pasture)][2].z, 0.0);
}

TEST(RelativesOf, NobodyIsHisOwnRelative) {
  for (const LandCoverClassInfo& info : land_cover_classes())
    EXPECT_THAT(relatives_of(info.id), testing::Not(Contains(info.id)));
}

}  // namespace
}  // namespace belvedere
