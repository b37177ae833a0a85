#include "tools/report/register_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

PairFinding finding(bool wrong, double view_px, double others_px, std::size_t near_by) {
  return {.wrong = wrong,
          .doubted = false,
          .view_px = view_px,
          .others_px = others_px,
          .deviations = others_px / 3.0,
          .nearest_m = 900.0,
          .near_by = near_by};
}

TEST(RegisterPage, SaysOfEachPairWhatWasFound) {
  const auto words = [](const PairFinding& of) { return pair_words(of, 3.0).sentence; };
  EXPECT_THAT(words(finding(true, 90.0, 90.0, 0)), HasSubstr("none near by confirms it"));
  EXPECT_THAT(words(finding(true, 90.0, 90.0, 1)), HasSubstr("one pair near by says otherwise"));
  EXPECT_THAT(words(finding(true, 90.0, 90.0, 3)), HasSubstr("3 pairs near by say otherwise"));
  EXPECT_THAT(words(finding(false, 90.0, 4.0, 3)), HasSubstr("was moved, as other pairs say"));
  EXPECT_THAT(words(finding(false, 90.0, 40.0, 0)), HasSubstr("two more pairs"));
  EXPECT_THAT(words(finding(false, 90.0, 40.0, 2)), HasSubstr("one more pair"));
  EXPECT_THAT(words(finding(false, 4.0, 4.0, 2)), HasSubstr("where the others say"));
  PairFinding sure = finding(false, 90.0, 90.0, 0);
  sure.doubted = true;
  EXPECT_THAT(words(sure), HasSubstr("sure: kept"));
  PairFinding folding = finding(false, 90.0, 90.0, 1);
  folding.would_fold = true;
  EXPECT_THAT(words(folding), HasSubstr("would fold"));
}

RegisterReportInput example() {
  RegisterReportInput input;
  input.painting = "painting.jpg";
  input.registration.frame.size_px = {1200.0, 600.0};
  input.registration.sigma_px = 3.0;
  input.registration.findings = {finding(false, 4.0, 3.0, 2), finding(true, 90.0, 80.0, 0),
                                 finding(false, 5.0, 9.0, 2)};
  for (int i = 0; i < 3; ++i) {
    const ControlPair pair{
        .pixel = {200.0 + 300.0 * i, 300.0}, .name = "Spitze " + std::to_string(i), .line = i + 2};
    input.pairs.push_back(pair);
  }
  input.picture = Grid<glm::vec3>(120, 60, glm::vec3(0.5F));
  input.ground = {Grid<float>(120, 60, 1000.F), Grid<float>(120, 60, 9000.F),
                  Grid<float>(120, 60, 2.F)};
  input.light.regions = Grid<RegisteredRegion>(4, 2);
  return input;
}

TEST(RegisterPage, SaysWhereForestEndsAndSnowBegins) {
  RegisteredCover cover{{1650.0, 0.0, false}, {1910.0, 3080.0, false}};
  EXPECT_THAT(cover_words(cover), AllOf(HasSubstr("forest ends at 1650 m, by the climate of the "
                                                  "place at 1910 m"),
                                        HasSubstr("does not tell where snow begins")));
  cover.lines.winter = true;
  EXPECT_THAT(cover_words(cover), HasSubstr("It is winter"));
}

TEST(RegisterPage, SaysWhereTheLightComesFrom) {
  RegisteredLight light;
  light.bearing_deg = 180.0;  // the viewer looks south
  EXPECT_THAT(light_words(light), HasSubstr("does not tell"));
  light.sun = {300.0, 30.0, 0.3, 0.3, 0.1, 5000};
  EXPECT_THAT(light_words(light),
              AllOf(HasSubstr("from the viewer's right"), HasSubstr("azimuth 300°"),
                    HasSubstr("30 %"), HasSubstr("20 % more")));
  light.sun.azimuth_deg = 92.0;
  EXPECT_THAT(light_words(light), HasSubstr("from the left:"));
  light.sun.azimuth_deg = 0.0;
  EXPECT_THAT(light_words(light), HasSubstr("from behind the viewer"));
  light.sun.azimuth_deg = 181.0;
  EXPECT_THAT(light_words(light), HasSubstr("from behind the mountains:"));
}

TEST(RegisterPage, OrdersPairsWorstFirst) {
  EXPECT_THAT(pairs_worst_first(example().registration), ElementsAre(1, 2, 0));
}

TEST(RegisterPage, IsAPageWithThePairsAndPictures) {
  const test::Folder folder;
  RegisterReportInput input = example();
  write_register_report(folder / "", input);
  EXPECT_THAT(test::read_bytes(folder / "index.html"), HasSubstr("They alone are fitted"));
  input.painted_places = 87;
  write_register_report(folder / "", input);
  const std::string page = test::read_bytes(folder / "index.html");
  EXPECT_THAT(page, HasSubstr("87 patches of ground"));
  EXPECT_THAT(page, AllOf(HasSubstr("Spitze 1"), HasSubstr("none near by confirms it")));
  const std::string json = test::read_bytes(folder / "report.json");
  EXPECT_LT(json.find("Spitze 1"), json.find("Spitze 0"));
  EXPECT_THAT(json, AllOf(HasSubstr("\"sigma_px\""), HasSubstr("\"projection\"")));
  EXPECT_TRUE(std::filesystem::exists(folder / "registered.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "trust_map.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "light.png"));
}

TEST(RegisterPage, NamesMountainsThatWereMovedAndPairsThatWouldFoldTheGround) {
  const test::Folder folder;
  RegisterReportInput input = example();
  write_register_report(folder / "", input);
  const std::string plain = test::read_bytes(folder / "index.html");
  EXPECT_EQ(plain.find("moved as a whole"), std::string::npos);
  EXPECT_EQ(plain.find("fold over itself"), std::string::npos);
  input.registration.mountains = {{{5000.0, 7000.0}, 40000.0, {0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0}}};
  input.registration.held_back = 2;
  input.registration.valleys_m = 300.0;
  write_register_report(folder / "", input);
  EXPECT_THAT(test::read_bytes(folder / "index.html"),
              AllOf(HasSubstr("moved as a whole"), HasSubstr("2 pairs or patches count for less"),
                    HasSubstr("300 m wider")));
  EXPECT_THAT(test::read_bytes(folder / "report.json"),
              AllOf(HasSubstr("\"mountains\""), HasSubstr("\"rotate_deg\"")));
}

}  // namespace
}  // namespace belvedere::tools
