#include "renderer/image/exr/exr_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/image/exr/mixed_channels.h"
#include "tests/renderer/image/picture_bytes.h"

namespace belvedere {
namespace {

using test::kind_of;
using namespace std::string_literals;
using test::Folder;
using test::id_value;
using test::mixed_parts;
using test::tone_value;
using test::write_mixed;
using test::z_value;

TEST(ExrWriter, RoundTripOfMixedChannels) {
  const Folder folder("exr");
  for (const auto& [width, height] :
       {std::pair{130, 200}, std::pair{64, 64}, std::pair{1, 1}, std::pair{65, 63}}) {
    const std::string path = folder / "a.exr";
    write_mixed(path, width, height);
    const Grid<float> z = read_channel(path, "Z");
    const Grid<float> tone = read_channel(path, "tone.V");
    const Grid<std::uint32_t> ids = read_id_channel(path, "landcover.id");
    ASSERT_EQ(z.width(), width);
    ASSERT_EQ(z.height(), height);
    for (const auto [x, y] : test::cells(width, height)) {
      ASSERT_EQ(z(x, y), z_value(x, y));
      ASSERT_NEAR(tone(x, y), tone_value(x, y), 0x1p-12);  // half: 11 bits below 1, rounded
      ASSERT_EQ(ids(x, y), id_value(x, y)) << x << " " << y;
    }
    EXPECT_EQ(folder.count(), 1u) << "no temporary file stays";
  }
}

TEST(ExrWriter, HeaderSaysWhatIsInIt) {
  const Folder folder("exr");
  write_mixed(folder / "a.exr", 100, 70);
  const ImageInfo info = read_image_info(folder / "a.exr");
  EXPECT_EQ(info.width, 100);
  EXPECT_EQ(info.height, 70);
  EXPECT_EQ(info.format, "openexr");
  ASSERT_EQ(info.parts.size(), 2u);
  EXPECT_EQ(info.parts[0].name, "float");
  EXPECT_EQ(info.parts[0].channels, mixed_parts[0].channels);
  EXPECT_EQ(info.parts[1].channels, mixed_parts[1].channels);
  EXPECT_EQ(info.notes, (FileNotes{{"camera", "perspective"}, {"scene", "a = 1\nb = \"é\"\n"}}));
}

TEST(ExrWriter, SameBytesForAnyThreadsAndBands) {
  const Folder folder("exr");
  {
    const ThreadLimit one(1);
    write_mixed(folder / "one.exr", 300, 200, 64);
  }
  {
    const ThreadLimit two(2);
    write_mixed(folder / "two.exr", 300, 200, 64);
    write_mixed(folder / "whole.exr", 300, 200, 256);
  }
  EXPECT_EQ(test::read_bytes(folder / "one.exr"), test::read_bytes(folder / "two.exr"));
  // Bands of another height change the order of tiles in the file, so only the values must match.
  EXPECT_EQ(read_channel(folder / "one.exr", "tone.V"),
            read_channel(folder / "whole.exr", "tone.V"));
}

TEST(ExrWriter, LargeNumbersStayFinite) {
  const Folder folder("exr");
  Image picture(2, 1, glm::vec3(1e9f, -1e9f, std::numeric_limits<float>::infinity()));
  write_exr(folder / "a.exr", picture, {});
  const Grid<glm::vec3> again = read_picture(folder / "a.exr");
  EXPECT_EQ(again(0, 0), glm::vec3(65504.0f, -65504.0f, std::numeric_limits<float>::infinity()));
}

TEST(ExrWriter, RefusesRowsOutOfPlace) {
  const Folder folder("exr");
  const std::vector<float> band(10 * 128 * 2);
  ExrWriter writer(folder / "a.exr", 10, 128, {mixed_parts[0]}, {});
  EXPECT_EQ(kind_of([&] { writer.write_rows(0, 64, 64, band); }), ErrorKind::bug);
  EXPECT_EQ(kind_of([&] { writer.write_rows(0, 0, 63, band); }), ErrorKind::bug);
  EXPECT_EQ(kind_of([&] { writer.write_rows(1, 0, 64, band); }), ErrorKind::bug);
  writer.write_rows(0, 0, 64, band);
  EXPECT_EQ(kind_of([&] { writer.finish(); }), ErrorKind::bug);
  EXPECT_EQ(kind_of([&] {
              ExrWriter(folder / "b.exr", 10, 10, {mixed_parts[0]}, {{"channels", "x"}});
            }),
            ErrorKind::bug);
}

TEST(ExrWriter, WithoutFinishTheOldFileStays) {
  const Folder folder("exr");
  test::write_bytes(folder / "a.exr", "old");
  {
    ExrWriter writer(folder / "a.exr", 10, 10, {mixed_parts[0]}, {});
    writer.write_rows(0, 0, 10, std::vector<float>(200));
  }
  EXPECT_EQ(test::read_bytes(folder / "a.exr"), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(ExrReader, MissingChannelIsNamedWithThoseThatAreThere) {
  const Folder folder("exr");
  write_mixed(folder / "a.exr", 10, 10);
  EXPECT_EQ(kind_of([&] { read_id_channel(folder / "a.exr", "Z"); }), ErrorKind::input);
  EXPECT_EQ(kind_of([&] { read_channel(folder / "a.exr", "landcover.id"); }), ErrorKind::input);
  EXPECT_THAT(test::input_error([&] { read_channel(folder / "a.exr", "ridge.V"); }),
              testing::AllOf(testing::HasSubstr("a.exr"), testing::HasSubstr("ridge.V"),
                             testing::HasSubstr("landcover.id")));
}

TEST(ExrReader, AnyCutIsFound) {
  const Folder folder("exr");
  write_mixed(folder / "a.exr", 130, 130);
  const std::string whole = test::read_bytes(folder / "a.exr");
  for (const double part : {0.001, 0.01, 0.1, 0.5, 0.9, 0.999}) {
    test::write_bytes(folder / "b.exr",
                      std::string_view(whole).substr(
                          0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
    EXPECT_EQ(kind_of([&] {
                read_channel(folder / "b.exr", "Z");
                read_id_channel(folder / "b.exr", "landcover.id");
              }),
              ErrorKind::input)
        << part;
  }
}

}  // namespace
}  // namespace belvedere
