#include "renderer/image/exr/match_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

TEST(MatchFile, HoldsEveryMatchAndThePictures) {
  const test::Folder folder;
  // Two bands, the second short.
  MatchField matches(37, 100);
  for (const auto [x, y] : test::cells(37, 100))
    if ((x + y) % 5 != 0)
      matches(x, y) = {static_cast<std::uint16_t>(x % 2), static_cast<std::uint16_t>(30000 + x),
                       static_cast<std::uint16_t>(7 * y)};
  const std::string note = to_note({{"a painting.jpg", 32000, 900}, {"b.png", 31000, 700}});
  MatchWriter writer(folder / "m.exr", 37, 100, note, {{"other", "kept"}});
  for (int y0 = 0; y0 < 100; y0 += ExrWriter::band_rows) {
    MatchField band(37, std::min(ExrWriter::band_rows, 100 - y0));
    std::copy_n(matches.row(y0), band.size(), band.data());
    writer.write_rows(band, y0);
  }
  writer.finish();
  const Grid<std::uint32_t> exemplar = read_id_channel(folder / "m.exr", "exemplar");
  const Grid<std::uint32_t> x = read_id_channel(folder / "m.exr", "x");
  const Grid<std::uint32_t> y = read_id_channel(folder / "m.exr", "y");
  ASSERT_EQ(exemplar.width(), 37);
  ASSERT_EQ(exemplar.height(), 100);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    ASSERT_EQ(exemplar[i], matches[i].exemplar) << i;
    ASSERT_EQ(x[i], matches[i].x) << i;
    ASSERT_EQ(y[i], matches[i].y) << i;
  }
  const FileNotes notes = read_image_info(folder / "m.exr").notes;
  EXPECT_EQ(notes.at("other"), "kept");
  const std::vector<MatchedPicture> pictures =
      parse_matched_pictures("m.exr", notes.at(matched_pictures_note));
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[0].name, "a painting.jpg");
  EXPECT_EQ(pictures[1].width, 31000);
  EXPECT_THAT(test::input_error([] { parse_matched_pictures("m.exr", "0 5 x\n"); }),
              testing::HasSubstr("m.exr"));
}

}  // namespace
}  // namespace belvedere
