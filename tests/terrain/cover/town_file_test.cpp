#include "terrain/cover/town_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/files.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

using test::message_of;
using test::Notes;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(TownFile, RadiusIsThatOfACircleOf170SquareMetresAHead) {
  EXPECT_NEAR(town_radius_m(100000.0), 2326.2, 0.1);
  EXPECT_DOUBLE_EQ(town_radius_m(40000.0), 2.0 * town_radius_m(10000.0));
  EXPECT_EQ(town_radius_m(0.0), 0.0);
  // Towns that the Karwendel scene has by radius have about this size.
  EXPECT_NEAR(town_radius_m(132000.0), 2600.0, 200.0);  // Innsbruck
  EXPECT_NEAR(town_radius_m(14000.0), 950.0, 100.0);    // Schwaz
}

TEST(TownFile, RadiusHasTheLastWordAndRowsWithoutSizeAreNoted) {
  const test::Folder folder;
  Notes notes;
  const std::vector<KnownTown> towns =
      read_towns(folder.write("t.csv",
                              "name,east,north,population,radius_m\nA,1,2,10000,\nB,3,4,10000,"
                              "700\nC,5,6,,\nD,7,8,0,\n"),
                 "", notes);
  ASSERT_EQ(towns.size(), 2U);
  EXPECT_EQ(towns[0].name, "A");
  EXPECT_EQ(towns[0].position, glm::dvec2(1.0, 2.0));
  EXPECT_EQ(towns[0].radius_m, town_radius_m(10000.0));
  EXPECT_EQ(towns[1].radius_m, 700.0);
  EXPECT_THAT(notes.all, ElementsAre(HasSubstr("2 of 4 towns")));
  // A file without names also works.
  EXPECT_EQ(
      read_towns(folder.write("u.csv", "east,north,radius_m\n1,2,300\n"), "", notes).at(0).name,
      "");
}

TEST(TownFile, RefusesWhatIsNoSize) {
  const test::Folder folder;
  const auto refused = [&](const std::string& text) {
    const std::string file = folder.write("t.csv", text);
    return message_of(ErrorKind::usage, [&] { read_towns(file, "", silent_progress()); });
  };
  EXPECT_THAT(refused("name,east,north,size\nA,1,2,3\n"),
              AllOf(HasSubstr("name, east, north, size"), HasSubstr("radius_m or population")));
  EXPECT_THAT(refused("east,north,radius_m\n1,2,large\n"),
              AllOf(HasSubstr("t.csv:2"), HasSubstr("radius_m is \"large\"")));
  EXPECT_THAT(refused("east,north,population\n1,2,-5\n"), HasSubstr("0 or more"));
  EXPECT_THAT(refused("east,north,radius_m\n1,2,60000\n"), HasSubstr("at most 50000 m"));
}

}  // namespace
}  // namespace belvedere
