#include "renderer/exemplar/exemplars.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/renderer/world/small_world.h"

namespace belvedere {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

const std::string files = "classes = \"c.png\"";

ScannedPainting scan(const std::string& name) {
  ScannedPainting scan;
  scan.painted.exemplar.name = name;
  scan.painted.picture = Grid<glm::vec3>(4, 3, glm::vec3(0.5F));
  return scan;
}

std::vector<PaintedExemplar> made(const std::vector<std::string>& settings, std::vector<ScannedPainting> scans) {
  return make_exemplars(test::small_scene(settings), View{}, read_palette("summer"), std::move(scans), silent_progress());
}

std::vector<std::string> names(const std::vector<PaintedExemplar>& exemplars) {
  std::vector<std::string> all;
  for (const PaintedExemplar& painted : exemplars) all.push_back(painted.exemplar.name);
  return all;
}

TEST(Exemplars, PaintingsComeInTheOrderOfTheirBlocks) {
  const std::vector<std::string> two = {"exemplar.0={ picture = \"a.png\", " + files + " }",
                                        "exemplar.1={ picture = \"b.png\", " + files + " }"};
  EXPECT_THAT(names(made(two, {scan("a"), scan("b")})), ElementsAre("a", "b"));
  EXPECT_THAT(names(made(two, {{}, scan("b")})), ElementsAre("b")) << "an optional one that is missing";
}

TEST(Exemplars, ABlockWithoutAPictureIsASheetOfItsSize) {
  const std::vector<PaintedExemplar> both =
      made({"exemplar.0={ width = 256, height = 256 }", "exemplar.1={ picture = \"b.png\", " + files + " }"}, {{}, scan("b")});
  ASSERT_THAT(both, SizeIs(2));
  EXPECT_EQ(both[0].picture.width(), 256);
  EXPECT_EQ(both[0].picture.height(), 256);
  EXPECT_TRUE(both[0].base.same_size(both[0].picture)) << "what the program painted has its base picture";
  EXPECT_EQ(both[1].exemplar.name, "b");
}

}  // namespace
}  // namespace belvedere
