#include "renderer/labels/sheet_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "base/grid.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/text/hex_colour.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

const char* const family = "DejaVu Sans, sans-serif";

// All kinds of shapes across tiles' borders, letters of several scripts among them.
Drawing busy() {
  Drawing drawing{.size_px = {700, 400}, .shapes = {}};
  const TextStyle type{.family = family, .size_px = 37.0};
  int y = 50;
  for (const char* words :
       {"Birkkarspitze 2749 m", "Ελληνικά и русский", "جبل الشيخ", "הר חרמון", "山と渓谷"}) {
    drawing.shapes.push_back(DrawnText{.text = words,
                                       .type = type,
                                       .at = {350.3, y},
                                       .anchor = .5,
                                       .colour = "#102040",
                                       .halo = "#ffffff",
                                       .halo_px = 4.0});
    y += 61;
  }
  drawing.shapes.push_back(DrawnText{.text = "Hinterautal",
                                     .type = {.family = family, .size_px = 30.0, .spacing = .3},
                                     .colour = "#205020",
                                     .halo = "#ffffee",
                                     .halo_px = 3.0,
                                     .along = {{20, 380}, {200, 340}, {420, 330}, {690, 390}}});
  drawing.shapes.push_back(DrawnCircle{.centre = {128, 128},
                                       .radius_px = 20,
                                       .fill = "#ffcc00",
                                       .stroke = "#000000",
                                       .width_px = 1.3});
  drawing.shapes.push_back(DrawnPath{.points = {{3.1, 5.2}, {640.7, 301.3}, {30, 390}},
                                     .fill = {},
                                     .stroke = "#b3202a",
                                     .width_px = 4.2,
                                     .dashes_px = {9, 6}});
  return drawing;
}

Grid<glm::vec3> painted(const SheetPainter& painter, PixelRect part) {
  Grid<glm::vec3> pixels(part.width(), part.height(), glm::vec3(.3F, .5F, .7F));
  painter.paint(pixels, {part.x0, part.y0});
  return pixels;
}

TEST(SheetPainter, AnyPartHasThePixelsOfTheWhole) {
  const SheetPainter painter(busy());
  const Grid<glm::vec3> whole = painted(painter, {0, 0, 700, 400});
  EXPECT_GT(std::count_if(whole.begin(), whole.end(),
                          [](glm::vec3 p) { return p != glm::vec3(.3F, .5F, .7F); }),
            20000);
  for (const PixelRect part :
       {PixelRect{1, 1, 700, 400}, {127, 0, 129, 400}, {0, 63, 700, 65}, {333, 111, 600, 222}})
    EXPECT_TRUE(painted(painter, part) == part_of(whole, part)) << part.x0 << ',' << part.y0;
}

TEST(SheetPainter, ThreadsChangeNothing) {
  const SheetPainter painter(busy());
  const Grid<glm::vec3> many = painted(painter, {0, 0, 700, 400});
  const ThreadLimit one(1);
  EXPECT_TRUE(painted(painter, {0, 0, 700, 400}) == many);
}

// A rectangle on the pixels' borders covers them whole; half a pixel is a half.
TEST(SheetPainter, CoversWhatAShapeCovers) {
  const SheetPainter painter(
      {.size_px = {300, 300},
       .shapes = {DrawnPath{.points = {{120, 120}, {140.5, 120}, {140.5, 140}, {120, 140}},
                            .closed = true,
                            .fill = "#ff8000",
                            .stroke = {}}}});
  const Grid<glm::vec3> pixels = painted(painter, {0, 0, 300, 300});
  const glm::vec3 paint(1.0F, 128.0F / 255.0F, 0.0F);
  EXPECT_EQ(pixels(120, 120), paint);
  EXPECT_EQ(pixels(139, 139), paint);
  EXPECT_EQ(pixels(119, 130), glm::vec3(.3F, .5F, .7F));
  EXPECT_NEAR(pixels(140, 130).r, .5 * (1.0 + .3), .004);
  EXPECT_NEAR(pixels(140, 130).b, .5 * .7, .004);
}

// The halo lies around the letters, never over them: text without it covers the same pixels in full
// ink.
TEST(SheetPainter, HalosLieBelowTheirLetters) {
  DrawnText text{.text = "Tirol",
                 .type = {.family = family, .size_px = 60.0},
                 .at = {20, 80},
                 .colour = "#000000"};
  const Grid<glm::vec3> bare =
      painted(SheetPainter({.size_px = {300, 120}, .shapes = {text}}), {0, 0, 300, 120});
  text.halo = "#ffffff";
  text.halo_px = 5.0;
  const Grid<glm::vec3> haloed =
      painted(SheetPainter({.size_px = {300, 120}, .shapes = {text}}), {0, 0, 300, 120});
  int ink = 0, light = 0;
  for (std::size_t i = 0; i < bare.size(); ++i) {
    if (bare[i] == glm::vec3(0.0F)) {
      ++ink;
      EXPECT_EQ(haloed[i], glm::vec3(0.0F));
    }
    if (haloed[i] == glm::vec3(1.0F)) ++light;
  }
  EXPECT_GT(ink, 300);
  EXPECT_GT(light, 300);
}

// Noise with names on it: dark and light letters, level and along a line, over a track.
Drawing named() {
  Drawing drawing{.size_px = {500, 300}, .shapes = {}};
  drawing.shapes.push_back(
      DrawnPath{.points = {{0, 0}, {499, 299}}, .fill = {}, .stroke = "#b3202a", .width_px = 6.0});
  const auto name = [&](const char* words, glm::dvec2 at, const char* colour) {
    return DrawnText{.text = words,
                     .type = {.family = family, .size_px = 40.0},
                     .at = at,
                     .colour = colour,
                     .halo = "#ffffff",
                     .halo_px = 4.0,
                     .halo_contrast = 4.5};
  };
  drawing.shapes.push_back(name("Habicht", {30, 90}, "#14161f"));
  drawing.shapes.push_back(name("Zillertal", {210, 180}, "#fdf9ee"));
  drawing.shapes.push_back(name("Inn", {}, "#0b2f55"));
  std::get<DrawnText>(drawing.shapes.back()).along = {{50, 280}, {250, 250}, {450, 280}};
  return drawing;
}

Grid<glm::vec3> ground() {
  Grid<glm::vec3> picture(500, 300);
  for (const auto [x, y] : test::cells(500, 300))
    for (int c = 0; c < 3; ++c)
      picture(x, y)[c] = static_cast<float>(random_uniform(9, 500 * y + x, c)) *
                         (.3F + .7F * static_cast<float>(x) / 500.0F);
  return picture;
}

// A part that reads the painting as far around it as the painter says, to the bit.
TEST(SheetPainter, HalosOfThePaintingAreTheSameInAnyPart) {
  const SheetPainter painter(named());
  const Grid<glm::vec3> picture = ground();
  const auto painted_with = [&](PixelRect part, int reach) {
    const PixelRect read = intersection({0, 0, 500, 300}, grown(part, reach));
    const Grid<glm::vec3> around = part_of(picture, read);
    const PictureWindow window{around, {read.x0, read.y0}};
    Grid<glm::vec3> pixels = part_of(picture, part);
    painter.paint(pixels, {part.x0, part.y0}, &window);
    return pixels;
  };
  const int reach = painter.halo_reach();
  const Grid<glm::vec3> whole = painted_with({0, 0, 500, 300}, reach);
  EXPECT_FALSE(whole == picture);
  for (const PixelRect part : {PixelRect{60, 60, 200, 120}, {127, 0, 129, 300}, {0, 170, 500, 171}})
    EXPECT_TRUE(painted_with(part, reach) == part_of(whole, part)) << part.x0 << ',' << part.y0;
  EXPECT_FALSE(painted_with({60, 60, 200, 120}, reach / 2) == part_of(whole, {60, 60, 200, 120}))
      << "half the reach is not enough";
}

// Beside the letters every pixel has the contrast, whatever is painted there.
TEST(SheetPainter, LettersStandOutOfThePainting) {
  Drawing drawing = named();
  const Grid<glm::vec3> picture = ground();
  const PictureWindow window{picture, {0, 0}};
  Grid<glm::vec3> pixels = picture;
  SheetPainter(drawing).paint(pixels, {0, 0}, &window);
  // The same letters black on white, and grown by two pixels.
  Drawing letters{.size_px = drawing.size_px, .shapes = {drawing.shapes[1]}};
  auto& name = std::get<DrawnText>(letters.shapes[0]);
  const glm::vec3 ink = colour_of_hex(name.colour).value();
  name.colour = "#000000";
  name.halo.clear();
  name.halo_contrast = 0.0;
  Grid<glm::vec3> mask(500, 300, glm::vec3(1.0F));
  SheetPainter(letters).paint(mask, {0, 0});
  int beside = 0;
  for (const auto [x, y] : test::cells({2, 2, 498, 298})) {
    bool near_letter = false;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) near_letter |= mask(x + dx, y + dy) == glm::vec3(0.0F);
    if (!near_letter || mask(x, y) != glm::vec3(1.0F)) continue;
    ++beside;
    EXPECT_GE(contrast(pixels(x, y), ink), 4.45) << x << ',' << y;
  }
  EXPECT_GT(beside, 500);
}

// Letters one by one are as wide as the whole line, in any script.
TEST(SheetPainter, LettersAddUpToTheirLine) {
  const TextMeasure measure;
  for (const char* words :
       {"Östliche Karwendelspitze", "جبل الشيخ", "e\u0301a\u0308", "山と渓谷"}) {
    const TextStyle type{.family = family, .size_px = 40.0};
    double sum = 0.0;
    for (const TextLetter& letter : measure.letters(words, type)) sum += letter.width_px;
    EXPECT_NEAR(sum, measure.measure(words, type).width_px, .1) << words;
  }
}

Grid<glm::vec3> noise(int width, int height) {
  Grid<glm::vec3> picture(width, height);
  for (std::size_t i = 0; i < picture.size(); ++i)
    for (int c = 0; c < 3; ++c)
      picture[i][c] = static_cast<float>(random_uniform(5, static_cast<std::int64_t>(i), c));
  return picture;
}

TEST(PaintHalo, ContrastIsThatOfWcag) {
  EXPECT_NEAR(contrast(glm::vec3(0.0F), glm::vec3(1.0F)), 21.0, 1e-9);
  EXPECT_NEAR(contrast(glm::vec3(.3F), glm::vec3(.3F)), 1.0, 1e-9);
  EXPECT_NEAR(luminance({0.0F, 1.0F, 0.0F}), .7152, 1e-9);
}

// Whatever is painted, letters have the contrast that is asked for.
TEST(PaintHalo, LettersHaveTheirContrastOnAnyPaint) {
  const HaloAim dark{.letters = {.08F, .09F, .12F}, .contrast = 4.5, .lightens = true};
  const HaloAim light{.letters = {.99F, .98F, .93F}, .contrast = 4.5, .lightens = false};
  const Grid<glm::vec3> paints = noise(40, 40);
  for (std::size_t i = 0; i < paints.size(); ++i) {
    EXPECT_GE(contrast(halo_colour(paints[i], dark), dark.letters), 4.5 - 1e-4);
    EXPECT_GE(contrast(halo_colour(paints[i], light), light.letters), 4.5 - 1e-4);
  }
  for (const float grey : {0.0F, 1.0F}) {
    EXPECT_GE(contrast(halo_colour(glm::vec3(grey), dark), dark.letters), 4.5 - 1e-4);
    EXPECT_GE(contrast(halo_colour(glm::vec3(grey), light), light.letters), 4.5 - 1e-4);
  }
}

// On ground that is light enough the halo is almost the ground, in the same hue.
TEST(PaintHalo, IsThePaintWhereThatIsLightEnough) {
  const glm::vec3 meadow(.72F, .78F, .55F);
  const glm::vec3 halo = halo_colour(meadow, {.letters = glm::vec3(.1F), .contrast = 4.0});
  EXPECT_GT(halo.g, meadow.g);
  for (int c = 0; c < 3; ++c) EXPECT_LT(halo[c] - meadow[c], .06F);
  EXPECT_NEAR(halo.b / halo.g, meadow.b / meadow.g, .02);
}

TEST(PaintHalo, IsALighterGreenOnGreen) {
  const glm::vec3 green(.4F, .55F, .3F);
  const glm::vec3 halo = halo_colour(green, {.letters = glm::vec3(.1F), .contrast = 6.5});
  EXPECT_GT(halo.g, 1.15F * green.g);
  EXPECT_NEAR(halo.b / halo.g, green.b / green.g, .05);
}

TEST(PaintHalo, OfEvenPaintIsEvenAndOfAPointAHill) {
  const Grid<glm::vec3> even(30, 30, glm::vec3(.25F, .5F, .75F));
  const Grid<glm::vec3> same = blurred({even, {0, 0}}, {5, 5, 20, 20}, 3);
  for (std::size_t i = 0; i < same.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(same[i][c], even[0][c], 1e-5F);
  Grid<glm::vec3> point(41, 41, glm::vec3(0.0F));
  point(20, 20) = glm::vec3(1.0F);
  const Grid<glm::vec3> hill = blurred({point, {0, 0}}, {0, 0, 41, 41}, 2);
  EXPECT_GT(hill(20, 20).g, hill(22, 20).g);
  EXPECT_GT(hill(22, 20).g, hill(25, 20).g);
  EXPECT_EQ(hill(20 + halo_reach_px(2) + 1, 20), glm::vec3(0.0F));
  EXPECT_NEAR(hill(22, 20).g, hill(18, 20).g, 1e-6);
}

// The same bits from any window that has the reach, and others with half of it.
TEST(PaintHalo, AnyWindowWithItsReachGivesTheSameBits) {
  const Grid<glm::vec3> picture = noise(90, 80);
  const PixelRect rect{40, 30, 60, 50};
  const Grid<glm::vec3> whole = part_of(blurred({picture, {0, 0}}, {0, 0, 90, 80}, 4), rect);
  const auto through = [&](int reach) {
    const Grid<glm::vec3> window = part_of(picture, grown(rect, reach));
    return blurred({window, {rect.x0 - reach, rect.y0 - reach}}, rect, 4);
  };
  EXPECT_TRUE(through(halo_reach_px(4)) == whole);
  EXPECT_FALSE(through(halo_reach_px(4) / 2) == whole);
}

}  // namespace
}  // namespace belvedere
