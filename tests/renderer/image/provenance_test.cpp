#include "renderer/image/provenance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(Provenance, NotesSayEverythingAndNothingOfTheMoment) {
  const test::Folder folder;
  const std::string path = folder.write("dem.tif", "metres");
  const Provenance provenance =
      make_provenance("version = 1\n", {{"data/dem.tif", path}, {"data/a.tif", path}});
  const auto notes = to_notes(provenance);
  EXPECT_THAT(notes.at("belvedere:version"), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(notes.at("belvedere:libraries"), HasSubstr("Embree 3."));
  EXPECT_THAT(notes.at("belvedere:libraries"), HasSubstr("GDAL 3."));
  EXPECT_THAT(notes.at("belvedere:instruction_set"), MatchesRegex("SSE.*|AVX.*"));
  EXPECT_EQ(notes.at("belvedere:scene"), "version = 1\n");
  const std::string hash = hash_bytes("metres");
  EXPECT_EQ(notes.at("belvedere:inputs"), hash + "  data/a.tif\n" + hash + "  data/dem.tif\n");
  EXPECT_EQ(notes, to_notes(make_provenance("version = 1\n",
                                            {{"data/dem.tif", path}, {"data/a.tif", path}})));
  for (const auto& [key, text] : notes)
    EXPECT_EQ(text.find(folder.path()), std::string::npos) << key;
  EXPECT_TRUE(to_notes(Provenance{}).empty());
}

}  // namespace
}  // namespace belvedere
