// exemplar compare, as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class ExemplarCompare : public Program {
 protected:
  void SetUp() override {
    stripes_ = write_picture("stripes.png", 200, 150, [](int x, int) { return glm::vec3(x % 40 < 20 ? 0.3F : 0.7F); });
    for (int k = 0; k < 2; ++k)
      noise_[k] = write_picture("noise" + std::to_string(k) + ".png", 200, 150, [k](int x, int y) {
        return glm::vec3(0.8F, 0.5F, 0.4F) * static_cast<float>(0.7 + 0.3 * random_uniform(static_cast<std::uint64_t>(k), x, y, 0));
      });
  }
  Outcome compare(std::vector<std::string> more) const {
    more.insert(more.begin(), {"exemplar", "compare", "-q"});
    return run(more);
  }
  std::string stripes_, noise_[2];
};

TEST_F(ExemplarCompare, SetsPicturesSideBySideAndSaysWhereTheFirstStandsAlone) {
  const Outcome outcome = compare({stripes_, noise_[0], noise_[1]});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr(" 1  stripes.png (200 × 150)"), HasSubstr(" 3  noise1.png"),
                    ContainsRegex("sharpness +1\\.00 +3\\.[89][0-9] +3\\.[89][0-9] +1 below\n"),
                    ContainsRegex("coherence +1\\.00 .* 1 above\n"), ContainsRegex("hue 0–30° red, % +0 +100 +100 +1 below\n")));
  const Outcome both = compare({noise_[0], stripes_, noise_[1], "--own", "2"});
  EXPECT_THAT(both.out, ContainsRegex("saturation, mean .* 2 below\n")) << "only noise1.png is the measure then";
}

TEST_F(ExemplarCompare, ScalesAndCutsBeforeItMeasures) {
  const Outcome scaled = compare({noise_[0], noise_[1], "--scale", "1", "--scale", "0.75"});
  EXPECT_THAT(scaled.out, AllOf(HasSubstr(" 1  noise0.png (200 × 150)"), HasSubstr(" 2  noise1.png (150 × 112, scaled by 0.75)")));
  // 200 px of 100 mm and of 125 mm: 2 and 1.6 px a millimetre.
  EXPECT_THAT(compare({noise_[0], noise_[1], "--mm", "100", "--mm", "125"}).out,
              AllOf(HasSubstr("noise0.png (160 × 120, scaled by 0.8)"), HasSubstr("noise1.png (200 × 150)")));
  EXPECT_THAT(compare({noise_[0], "--part", "0", "0.2", "0.5", "1"}).out, HasSubstr("noise0.png (100 × 120)"));
}

TEST_F(ExemplarCompare, IsJsonForMachines) {
  EXPECT_THAT(compare({stripes_, "--json"}).out, AllOf(HasSubstr("\"stroke_length_px\": 120"), HasSubstr("\"hue_shares\": [")));
}

TEST_F(ExemplarCompare, RefusesWhatCannotBeCompared) {
  EXPECT_EQ(compare({noise_[0], noise_[1], "--scale", "0.5"}).status, 2);
  EXPECT_EQ(compare({noise_[0], "--scale", "1", "--mm", "100"}).status, 2);
  EXPECT_EQ(compare({noise_[0], "--part", "0.5", "0", "0.4", "1"}).status, 2);
  EXPECT_EQ(compare({path("absent.png")}).status, 3);
  const Outcome small = compare({noise_[0], "--scale", "0.5"});
  EXPECT_EQ(small.status, 2);
  EXPECT_THAT(small.err, AllOf(HasSubstr("noise0.png"), HasSubstr("100 × 75 pixels after scaling"), HasSubstr("at least 96")));
}

}  // namespace
}  // namespace belvedere
