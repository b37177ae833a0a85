#include "renderer/labels/label_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/progress.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class LabelPoints : public testing::Test {
 protected:
  std::vector<LabelPoint> read(const std::string& text) {
    return read_label_points(folder_.write("points.csv", text), "", style_, progress_);
  }
  struct Notes : Progress {
    void note(std::string_view text) override { all += std::string(text) + "\n"; }
    std::string all;
  };
  test::Folder folder_;
  LabelStyle style_ = load_label_style("classic");
  Notes progress_;
};

TEST_F(LabelPoints, SayNameKindRankAndAltitude) {
  const std::vector<LabelPoint> points = read("name,kind,rank,ele,east,north\nA,summit,1,2749.4,10,20\n\"B, C\",hut,,,30,40\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].name, "A");
  EXPECT_EQ(points[0].rank, 1.0);
  EXPECT_EQ(points[0].altitude_m, 2749.4);
  EXPECT_EQ(points[0].place, glm::dvec2(10, 20));
  EXPECT_EQ(points[1].name, "B, C");
  EXPECT_EQ(style_.kinds[static_cast<std::size_t>(points[1].kind)].name, "hut");
  EXPECT_EQ(points[1].rank, 5.0);
  EXPECT_FALSE(points[1].altitude_m);
}

TEST_F(LabelPoints, OfOpenStreetMapsColumns) {
  const std::vector<LabelPoint> points = read("name,natural,elevation,east,north\nA,peak,2000,10,20\nB,saddle,,30,40\n");
  EXPECT_EQ(points[0].kind, style_.find("summit"));
  EXPECT_EQ(points[1].kind, style_.find("pass"));
  EXPECT_EQ(points[0].altitude_m, 2000.0);
}

TEST_F(LabelPoints, WithoutANameOrWithTooLongAOneAreLeftOutAndSaid) {
  const std::string ninety(90, 'x');
  const std::vector<LabelPoint> points = read("name,east,north\n,1,2\n" + ninety + ",3,4\nA,5,6\n");
  ASSERT_EQ(points.size(), 1U);
  EXPECT_THAT(progress_.all, HasSubstr("1 of 3 points have no name"));
  EXPECT_THAT(progress_.all, HasSubstr("1 names of more than 80 letters"));
}

TEST_F(LabelPoints, LettersAreCountedAndNotBytes) {
  std::string eighty;
  for (int i = 0; i < 80; ++i) eighty += "ü";
  EXPECT_EQ(read("name,east,north\n" + eighty + ",1,2\n").size(), 1U);
}

TEST_F(LabelPoints, StrangeKindsAreSaidAndSetAsTheFirst) {
  const std::vector<LabelPoint> points = read("name,kind,east,north\nA,spaceport,1,2\n");
  EXPECT_EQ(points[0].kind, 0);
  EXPECT_THAT(progress_.all, HasSubstr("spaceport"));
}

TEST_F(LabelPoints, WrongNumbersAreRefused) {
  const auto message = [&](const std::string& text) { return test::message_of(ErrorKind::usage, [&] { read(text); }); };
  EXPECT_THAT(message("name,rank,east,north\nA,first,1,2\n"), HasSubstr("points.csv:2"));
  EXPECT_THAT(message("name,rank,east,north\nA,12,1,2\n"), HasSubstr("1 … 9"));
  EXPECT_THAT(message("title,east,north\nA,1,2\n"), HasSubstr("no column of names"));
}

// Of the DEM's summits those remain that no named one stands for.
TEST(UnnamedSummits, AreThoseThatNobodyNamed) {
  const LabelStyle style = load_label_style("classic");
  const GeoTransform transform{0.0, 10000.0, 100.0, 100.0};
  LabelPoint named;
  named.name = "A";
  named.place = transform.to_crs(20.0, 20.0) + glm::dvec2(150.0, 0.0);
  const std::vector<LabelPoint> rest =
      unnamed_summits({{20, 20, 2000.F, 900.F}, {50, 20, 1500.F, 300.F}}, transform, 100.0, {named}, style);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].place, transform.to_crs(50.0, 20.0));
  EXPECT_TRUE(rest[0].name.empty());
  EXPECT_GT(rest[0].rank, 6.0);
  named.kind = style.find("town");
  EXPECT_EQ(unnamed_summits({{20, 20, 2000.F, 900.F}}, transform, 100.0, {named}, style).size(), 1U) << "a town names no summit";
}

}  // namespace
}  // namespace belvedere
