#include "renderer/image/label_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/grids.h"
#include "tests/notes.h"
#include "tests/renderer/image/picture_bytes.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

using namespace std::string_literals;
using testing::ElementsAre;
using testing::FloatNear;
using testing::Property;
using testing::Throws;

class LabelImage : public testing::Test {
 protected:
  // Left red, right blue, between them two columns of a soft edge; `third` fills the lowest rows.
  std::string draw(const std::string& name, const std::string& third) const {
    std::string rows;
    for (const auto [x, y] : test::cells(20, 16)) {
      const std::string mixed = x == 9 ? "\xaa\x30\x55" : "\x55\x30\xaa";
      rows += y >= 12  ? third
              : x < 9  ? std::string("\xff\0\0", 3)
              : x > 10 ? std::string("\0\0\xff", 3)
                       : mixed;
    }
    return write(name, 2, rows);
  }
  std::string write(const std::string& name, int colour_type, const std::string& rows) const {
    const std::string path = folder_ / name;
    test::write_bytes(path, test::make_png(20, 16, 8, colour_type, rows));
    return path;
  }
  test::Folder folder_;
};

TEST_F(LabelImage, ColoursThatAreTheSameAreTheSameLabelInEveryFile) {
  const std::string green("\0\xff\0", 3);
  const LabelImages images =
      read_label_images({draw("a.png", green), draw("b.png", std::string("\0\0\xff", 3))});
  ASSERT_EQ(images.colours.size(), 3U);
  EXPECT_EQ(images.colours[0], (Rgb8{0, 0, 255}));
  EXPECT_EQ(images.colours[1], (Rgb8{0, 255, 0}));
  EXPECT_EQ(images.colours[2], (Rgb8{255, 0, 0}));
  for (int x = 0; x < 20; ++x) {
    EXPECT_EQ(images.labels[0](x, 4), x < 10 ? 2 : 0)
        << x;  // each half of the soft edge goes to its side
    EXPECT_EQ(images.labels[0](x, 15), 1) << x;
    EXPECT_EQ(images.labels[1](x, 15), 0) << x;
  }
}

TEST_F(LabelImage, NumbersStayAsTheyAre) {
  std::string rows(20 * 16, '\3');
  rows[7] = '\xff';
  const LabelImages images = read_label_images({write("a.png", 0, rows)});
  EXPECT_TRUE(images.colours.empty());
  EXPECT_EQ(images.labels[0](0, 0), 3);
  EXPECT_EQ(images.labels[0](7, 0), unused_label);
}

TEST_F(LabelImage, NumbersThatAreNoClassAreNamedWithTheirPosition) {
  std::string rows(20 * 16, '\3');
  rows[7] = '\xff';
  EXPECT_EQ(read_class_mask(write("a.png", 0, rows))(7, 0), unused_label);
  rows[20 * 2 + 5] = rows[20 * 2 + 6] = '\xc8';
  rows[20 * 9 + 1] = '\x64';
  const std::string path = write("b.png", 0, rows);
  const std::string message = test::input_error([&] { read_class_mask(path); });
  EXPECT_NE(message.find("100 (1 pixels, the first at 1, 9)"), std::string::npos) << message;
  EXPECT_NE(message.find("200 (2 pixels, the first at 5, 2)"), std::string::npos) << message;
}

TEST_F(LabelImage, RefusesWhatTellsNoLabels) {
  const std::string drawn = draw("a.png", std::string("\0\xff\0", 3));
  const std::string numbers = write("n.png", 0, std::string(20 * 16, '\3'));
  EXPECT_THROW(read_label_images({drawn, numbers}), Error);
  EXPECT_THROW(read_label_images({numbers, drawn}), Error);
  std::string noise;
  for (int i = 0; i < 20 * 16 * 3; ++i) noise += static_cast<char>(i * 37 % 251);
  EXPECT_THROW(read_label_images({write("noise.png", 2, noise)}), Error);
}

// JPEG leaves blocks of other colours beside edges: here squares 5 steps off, in a drawing with
// hundreds of mixed colours.
TEST_F(LabelImage, ColoursOffByLossesAreTheFrequentOnes) {
  const auto rows = [](int off) {
    std::string out;
    for (const auto [x, y] : test::cells(20, 16)) {
      const int red = x < 10 ? 200 : 40;
      if (x >= 2 && x < 5 && y >= 2 && y < 5)
        out += {static_cast<char>(red - off), '\x30', '\x30'};
      else if (x == 9 || x == 10)
        out += {static_cast<char>(90 + y), static_cast<char>(x), '\x50'};
      else
        out += {static_cast<char>(red), '\x30', '\x30'};
    }
    return out;
  };
  test::Notes notes;
  const LabelImages images = read_label_images({write("a.png", 2, rows(5))}, notes);
  ASSERT_EQ(images.colours.size(), 2U);
  EXPECT_EQ(images.colours[1], (Rgb8{200, 0x30, 0x30}));
  EXPECT_EQ(images.labels[0](3, 3), 1);
  EXPECT_NE(notes.text().find("1 flat colours are within 12 steps of 2"), std::string::npos)
      << notes.text();
  EXPECT_NE(notes.text().find("2.81 %"), std::string::npos) << "9 of 320 pixels: " << notes.text();
  // Farther away it is a label of its own.
  EXPECT_EQ(read_label_images({write("b.png", 2, rows(40))}).colours.size(), 3U);
}

// Numbers saved as RGB lie one step apart and are different labels.
TEST_F(LabelImage, NeighbouringColoursOfALosslessDrawingStayApart) {
  std::string rows;
  for (const auto [x, y] : test::cells(20, 16))
    rows += std::string(3, x < 4 && y < 4 ? '\2' : '\1');
  EXPECT_EQ(read_label_images({write("a.png", 2, rows)}).colours.size(), 2U);
}

Grid<float> shares_of(const std::string& bytes) {
  const test::Folder folder;
  test::write_bytes(folder / "grey.png", bytes);
  return read_grey_share(folder / "grey.png");
}

TEST(GreyShare, IsOfTheRangeOfTheType) {
  EXPECT_THAT(shares_of(test::make_png(3, 1, 8, 0, "\x00\x33\xff"s)),
              ElementsAre(0.F, FloatNear(0.2F, 1e-6F), 1.F));
  EXPECT_THAT(shares_of(test::make_png(4, 1, 4, 0, "\x03\x9f"s)),
              ElementsAre(0.F, FloatNear(0.2F, 1e-6F), FloatNear(0.6F, 1e-6F), 1.F));
  EXPECT_THAT(shares_of(test::make_png(8, 1, 1, 0, "\x25"s)),
              ElementsAre(0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 0.F, 1.F));
  const std::string greys = "\xff\xff\xff\x33\x33\x33"s;
  EXPECT_THAT(shares_of(test::make_png(2, 1, 8, 3, "\x00\x01"s, greys)),
              ElementsAre(1.F, FloatNear(0.2F, 1e-6F)));
}

// Dark pictures of 16 bits are dark, even where no value exceeds those of 8 bits.
TEST(GreyShare, DoesNotDependOnTheValuesThatOccur) {
  EXPECT_THAT(shares_of(test::make_png(3, 1, 16, 0, "\x00\x00\x00\x80\x00\xff"s)),
              ElementsAre(0.F, FloatNear(128.F / 65535.F, 1e-7F), FloatNear(1.F / 257.F, 1e-7F)));
}

TEST(GreyShare, RefusesColour) {
  EXPECT_THAT([] { shares_of(test::make_png(2, 1, 8, 2, "\x05\x05\x05\x05\x06\x05"s)); },
              Throws<Error>(Property(&Error::kind, ErrorKind::input)));
  EXPECT_THAT(shares_of(test::make_png(1, 1, 8, 2, "\xff\xff\xff"s)), ElementsAre(1.F));
}

}  // namespace
}  // namespace belvedere
