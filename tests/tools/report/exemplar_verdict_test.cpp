#include "tools/report/exemplar_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "tests/files.h"

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

ExemplarFindings findings() {
  ExemplarFindings out;
  out.name = [](std::uint8_t label) { return "class " + std::to_string(label); };
  out.value = [](const std::string&, int value) { return std::to_string(20 * value) + " m"; };
  return out;
}
ClassSurvey sound() {
  ClassSurvey of;
  of.label = 4;
  of.texels = 200000;
  of.inside = 1000;
  return of;
}

TEST(ExemplarVerdict, ASoundClassHasNoFlaws) {
  EXPECT_THAT(describe_flaws(sound(), findings()), IsEmpty());
}

TEST(ExemplarVerdict, EachFlawIsASentence) {
  ClassSurvey of = sound();
  of.texels = 2499;
  EXPECT_THAT(describe_flaws(of, findings()),
              ElementsAre(HasSubstr("only 2 499 texels: at least about 2 500")));
  of = sound();
  of.inside = 0;
  EXPECT_THAT(describe_flaws(of, findings()), ElementsAre(HasSubstr("only along borders")));
  of = sound();
  of.left_right = {.known = true, .clique = 0.3, .colour = 0.0};
  of.checkerboard = {.known = true, .clique = 0.1, .colour = 0.0};
  EXPECT_THAT(describe_flaws(of, findings()),
              ElementsAre(HasSubstr("painted differently (0.30, chance gives 0.10)")));
  of.checkerboard.clique = 0.13;  // what chance gives is nearly as much
  EXPECT_THAT(describe_flaws(of, findings()), IsEmpty());
  of = sound();
  of.guides.push_back(
      {.name = "altitude", .lowest = 0, .highest = 0, .low = 0, .high = 0, .gaps = {{50, 70}}});
  of.guides.push_back(
      {.name = "slope", .lowest = 0, .highest = 0, .low = 0, .high = 0, .gaps = {{5, 30}}});
  EXPECT_THAT(describe_flaws(of, findings()),
              ElementsAre("no texels at altitudes 1000 m to 1400 m"))
      << "of other guides gaps do no harm";
}

TEST(ExemplarVerdict, SaysWhatServesAndWhatIsEnough) {
  EXPECT_EQ(describe_service(sound()), "serves up to 800 000 pixels");
  NeededClassTexels demand{.available = {.label = 4, .texels = 100, .pixels = 400}};
  EXPECT_EQ(describe_needed_texels(demand), "enough: 400 pixels need it, 400 can be served");
  demand.available.pixels = 401;
  EXPECT_THAT(describe_needed_texels(demand),
              AllOf(HasSubstr("too few"), HasSubstr("101 texels would be needed, there are 100")));
  demand.guides = {{{.name = "altitude", .covered = 0.9, .square = 0.0}, 0.5}};
  EXPECT_THAT(describe_needed_texels(demand), Not(HasSubstr("altitude")));
  demand.guides = {{{.name = "altitude", .covered = 0.89, .square = 0.0}, 12345.6},
                   {{.name = "tone", .covered = 1.0, .square = 0.0}, 3.0}};
  EXPECT_THAT(describe_needed_texels(demand),
              AllOf(HasSubstr("only 89 % of its pixels find texels of their altitude"),
                    HasSubstr("altitude costs most, 12 345 a pixel"), Not(HasSubstr("tone"))));
}

TEST(ExemplarVerdict, TextureModelsAreNamedWithWhatTheyPaint) {
  ExemplarFindings found = findings();
  EXPECT_THAT(findings_json(found).str(), Not(HasSubstr("models")));
  found.models.push_back({.name = "meadow.model", .labels = {10, 6}, .always = false});
  found.models.push_back({.name = "lake.model", .labels = {1}, .always = true});
  EXPECT_THAT(findings_text(found),
              AllOf(HasSubstr("meadow.model: a texture model, without texels; paints class 10, "
                              "class 6 where paintings have no texels"),
                    HasSubstr("lake.model: a texture model, without texels; paints class 1\n")));
  EXPECT_THAT(findings_json(found).str(),
              AllOf(HasSubstr("\"lake.model\""), HasSubstr("\"always\": true")));
}

TEST(ExemplarVerdict, TextAndJsonTellTheSame) {
  ExemplarFindings all = findings();
  const ExemplarSurvey survey{.texels = 400000, .excluded = 4000, .classes = {sound()}};
  all.paintings.push_back({"p.png", 800, 500, survey});
  EXPECT_THAT(findings_text(all),
              AllOf(HasSubstr("p.png: 800 × 500 texels, 1.0 % of them never copied"),
                    HasSubstr("800 000"), Not(HasSubstr("for this picture"))));
  EXPECT_THAT(findings_json(all).str(),
              AllOf(HasSubstr("\"serves_pixels\": 800000"), Not(HasSubstr("\"asked\""))));
  all.target_known = true;
  all.demands.push_back({.available = {.label = 4, .texels = 200000, .pixels = 5}});
  all.missing.emplace_back(std::uint8_t{9}, 12345.0);
  EXPECT_THAT(findings_text(all),
              AllOf(HasSubstr("class 4: enough"),
                    HasSubstr("class 9: no texels at all, but 12 345 pixels need it")));
  EXPECT_THAT(findings_json(all).str(),
              AllOf(HasSubstr("\"guides\": []"), HasSubstr("\"pixels\": 12345")));
  all.stand_ins.push_back({5, 4, 2000.0});
  all.explained.push_back({.name = "tone", .explained = 0.34, .difference = 900.0});
  EXPECT_THAT(findings_text(all),
              AllOf(HasSubstr("class 5: no texels of its own, 2 000 pixels copy from class 4"),
                    HasSubstr("guides explain of the paint's variance: tone 34 %")));
  EXPECT_THAT(findings_json(all).str(), HasSubstr("\"copies_from\": 4"));
}

TEST(ExemplarReportPage, ShowsThePaintingItsClassesAndCharts) {
  Exemplar painting{
      .name = "p.png", .picture = Grid<Rgb8>(64, 48, Rgb8{10, 200, 30}), .guides = {}};
  painting.guides.label = Grid<std::uint8_t>(64, 48, 7);
  painting.guides.guides.push_back({"altitude", Grid<std::uint8_t>(64, 48, 100)});
  ExemplarFindings findings;
  findings.name = [](std::uint8_t label) { return "class " + std::to_string(label); };
  findings.value = [](const std::string&, int value) { return std::to_string(value); };
  findings.paintings.push_back({painting.name, 64, 48, survey_exemplar(painting)});
  const test::Folder folder;
  write_exemplar_report(folder.path(), {painting}, {}, findings, "belvedere exemplar check");
  const std::string page = test::read_bytes(folder / "index.html");
  EXPECT_THAT(page, AllOf(HasSubstr("\"id\": \"verdict\""), HasSubstr("class 7"),
                          HasSubstr("belvedere exemplar check")));
  EXPECT_THAT(page, AllOf(HasSubstr("\"texels_inside\": 3072"), HasSubstr("\"coverage\": {")));
  // Every picture of the page is there.
  std::size_t shown = 0;
  for (std::size_t at = page.find("\"src\": \""); at != std::string::npos;
       at = page.find("\"src\": \"", at + 1), ++shown) {
    const std::size_t begin = at + 8;
    EXPECT_GT(read_image_info(folder / page.substr(begin, page.find('"', begin) - begin)).width, 0);
  }
  EXPECT_EQ(shown, 3U) << "painting, classes, a swatch";
}

}  // namespace
}  // namespace belvedere::tools
