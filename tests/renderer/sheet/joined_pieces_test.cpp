#include "renderer/sheet/joined_pieces.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "base/error.h"
#include "base/grid_part.h"
#include "tests/files.h"

namespace belvedere {
namespace {

TEST(JoinedPieces, RowsOfARegionComeFromAllPiecesThatTouchThem) {
  const test::Folder folder;
  const WorkFolder work(folder / "work", {{"scene", "a"}}, WorkMode::begin);
  Grid<std::uint16_t> sheet(50, 40);
  for (std::size_t i = 0; i < sheet.size(); ++i) sheet[i] = static_cast<std::uint16_t>(i);
  JoinedPieces joined{work, {}, {5, 3, 47, 38}};
  for (int y = 0; y < 40; y += 16)
    for (int x = 0; x < 47; x += 16) {
      const PixelRect piece = intersection(joined.region, {x, y, x + 16, y + 16});
      joined.pieces.push_back(piece);
      Grid<std::uint16_t> own = part_of(sheet, piece);
      work.keep("panorama", piece, {plane_of(own)});
    }
  for (const auto& [y0, y1] : {std::pair{3, 38}, {3, 4}, {14, 33}, {31, 38}}) {
    Grid<std::uint16_t> rows(42, y1 - y0);
    joined.read("panorama", y0, y1, {plane_of(rows)});
    EXPECT_EQ(rows, part_of(sheet, {5, y0, 47, y1}));
  }
  Grid<std::uint16_t> rows(42, 1);
  test::message_of(ErrorKind::input, [&] { joined.read("guidance", 3, 4, {plane_of(rows)}); });
}

}  // namespace
}  // namespace belvedere
