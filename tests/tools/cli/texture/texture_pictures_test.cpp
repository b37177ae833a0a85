// Typical user pictures, given to every command of textures: with alpha, of 16 bits, CMYK, damaged,
// too small, too large.
#include "tools/cli/texture/texture_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/grids.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/texture/statistical/texture_crops.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class TexturePictures : public Program {
 protected:
  std::string write_meadow(const std::string& name, int width, int height) const {
    const Grid<Rgb8> crop = test::meadow_crop(width, height);
    return write_picture(name, width, height, [&](int x, int y) {
      return glm::vec3(crop(x, y)[0], crop(x, y)[1], crop(x, y)[2]) / 255.F;
    });
  }
  // The same of 16 bits a channel: between the levels of 8.
  std::string write_fine(const std::string& name, int width, int height) const {
    const Grid<Rgb8> crop = test::meadow_crop(width, height);
    Grid<glm::vec3> picture(width, height);
    for (const auto [x, y] : test::cells(width, height))
      picture(x, y) = (glm::vec3(crop(x, y)[0], crop(x, y)[1], crop(x, y)[2]) * 256.F +
                       static_cast<float>((7 * x + 3 * y) % 99)) /
                      65535.F;
    write_tiff16(path(name), picture, {});
    return path(name);
  }
  // The same with alpha, clear in columns left of `opaque_from`.
  std::string write_clear(const std::string& name, int width, int height, int opaque_from) const {
    const Grid<Rgb8> crop = test::meadow_crop(width, height);
    std::string rows;
    for (const auto [x, y] : test::cells(width, height)) {
      for (const std::uint8_t c : crop(x, y)) rows += static_cast<char>(c);
      rows += static_cast<char>(x < opaque_from ? 0 : 255);
    }
    return write(name, test::make_png(width, height, 8, 6, rows));
  }
  // Learned once.
  std::string write_model() const {
    if (model_.empty()) {
      const std::string crop = write_meadow("learnt.png", 72, 64);
      EXPECT_EQ(run({"texture", "learn", crop, "--types", "16", "--begin", "white", "--out",
                     path("m.model"), "-q"})
                    .status,
                0);
      model_ = read_bytes(path("m.model"));
    }
    return write("m.model", model_);
  }
  void refused(const std::vector<std::string>& arguments, int status,
               const std::string& word) const {
    EXPECT_THAT(run(arguments), Ends(status, HasSubstr(word)))
        << arguments[0] << arguments[1] << arguments[0] << " " << arguments[1];
    EXPECT_FALSE(std::filesystem::exists(path("x.png")));
    EXPECT_FALSE(std::filesystem::exists(path("x.model")));
  }
  // Every command that reads a painting, with `picture` for it.
  std::vector<std::vector<std::string>> readers(const std::string& picture, const std::string& hole,
                                                const std::string& model) const {
    const std::string good = write_meadow("good.png", 72, 64);
    return {{"texture", "learn", picture, "--out", path("x.model")},
            {"composite", "learn", picture, "--labels", hole, "--out", path("x.model")},
            {"texture", "fill", picture, "--hole", hole, "--model", model, "--out", path("x.png")},
            {"texture", "seam", good, picture, "--out", path("x.png")},
            {"texture", "correct", picture, "--to", good, "--out", path("x.png")},
            {"texture", "correct", good, "--to", picture, "--out", path("x.png")},
            {"exemplar", "segment", picture, "--out", path("x.png")}};
  }
  static inline std::string model_;
};

TEST_F(TexturePictures, WhatCannotBeReadIsNamedByEveryCommand) {
  const std::string hole =
      write_labels("hole.tif", 72, 64, [](int x, int) { return x < 20 ? 1 : 0; });
  const std::string model = write_model();
  const std::string cmyk = write("cmyk.jpg", test::cmyk_jpeg);
  const std::string whole = read_bytes(write_meadow("whole.png", 72, 64));
  const std::string cut = write("cut.png", whole.substr(0, whole.size() / 2));
  for (const auto& arguments : readers(cmyk, hole, model)) refused(arguments, 3, "CMYK");
  for (const auto& arguments : readers(cut, hole, model)) refused(arguments, 3, "cut.png");
  for (const auto& arguments : readers(write("text.png", "no picture"), hole, model))
    refused(arguments, 3, "text.png");
  refused({"texture", "erode", cmyk, "--out", path("series")}, 3, "cmyk.jpg");
  refused({"texture", "erode", write_meadow("colours.png", 50, 50), "--out", path("series")}, 3,
          "colours.png");
}

TEST_F(TexturePictures, ClearPixelsAreNotPaint) {
  const std::string clear = write_clear("clear.png", 100, 64, 20);
  ASSERT_THAT(run({"texture", "learn", clear, "--types", "16", "--begin", "white", "--out",
                   path("m.model")}),
              Ends(0, HasSubstr("1280 transparent pixels")));
  refused({"texture", "learn", write_clear("most.png", 72, 64, 60), "--out", path("x.model")}, 3,
          "768 pixels that are opaque");
  refused({"texture", "seam", clear, write_meadow("good.png", 100, 64), "--out", path("x.png")}, 3,
          "1280 transparent pixels");
  EXPECT_THAT(run({"texture", "correct", clear, "--to", path("good.png"), "--out", path("c.png")}),
              Ends(0, HasSubstr("1280 transparent pixels of clear.png")));
  // Transparent pixels do not influence the fill beside them: whatever their hidden colour, the
  // result is the same.
  const std::string hole = write_labels("hole.tif", 100, 64, [](int x, int y) {
    return x >= 20 && x < 40 && y > 20 && y < 40 ? 1 : 0;
  });
  std::string red = read_bytes(clear);
  const Grid<Rgb8> crop = test::meadow_crop(100, 64);
  std::string rows;
  for (const auto [x, y] : test::cells(100, 64))
    if (x < 20)
      rows += std::string("\xff\0\0\0", 4);
    else
      rows += {static_cast<char>(crop(x, y)[0]), static_cast<char>(crop(x, y)[1]),
               static_cast<char>(crop(x, y)[2]), '\xff'};
  const std::string other = write("red.png", test::make_png(100, 64, 8, 6, rows));
  const auto fill = [&](const std::string& scan, const std::string& out) {
    EXPECT_THAT(run({"texture", "fill", scan, "--hole", hole, "--model", path("m.model"), "--out",
                     path(out)}),
                Ends(0, HasSubstr("1280 transparent pixels")));
    return read_picture(path(out));
  };
  const Grid<glm::vec3> one = fill(clear, "one.png");
  const Grid<glm::vec3> two = fill(other, "two.png");
  for (const auto [x, y] : test::cells({20, 0, 100, 64}))
    ASSERT_EQ(one(x, y), two(x, y)) << x << ", " << y;
}

TEST_F(TexturePictures, SixteenBitsStayWhereNothingIsMade) {
  const std::string model = write_model();
  const std::string fine = write_fine("fine.tif", 80, 70);
  const std::string hole = write_labels("hole.tif", 80, 70, [](int x, int y) {
    return x > 30 && x < 50 && y > 20 && y < 50 ? 1 : 0;
  });
  const Grid<glm::vec3> before = read_picture(fine);
  const Outcome filled =
      run({"texture", "fill", fine, "--hole", hole, "--model", model, "--out", path("filled.tif")});
  ASSERT_EQ(filled.status, 0) << filled.err;
  EXPECT_THAT(filled.err, Not(HasSubstr("8 bits")));
  const Grid<glm::vec3> after = read_picture(path("filled.tif"));
  int changed = 0;
  for (const auto [x, y] : test::cells(80, 70)) {
    const bool inside = x > 30 && x < 50 && y > 20 && y < 50;
    if (!inside) {
      ASSERT_EQ(after(x, y), before(x, y));
    }
    changed += after(x, y) != before(x, y) ? 1 : 0;
  }
  EXPECT_GT(changed, 400);
  ASSERT_THAT(
      run({"texture", "fill", fine, "--hole", hole, "--model", model, "--out", path("filled.png")}),
      Ends(0, AllOf(HasSubstr("fine.tif"), HasSubstr("8 bits"), HasSubstr(".tif"))));

  const std::string blue = write_picture("blue.png", 80, 70, [](int x, int y) {
    return glm::vec3(.1F, .2F, .5F + .01F * static_cast<float>((x * 5 + y * 3) % 17));
  });
  ASSERT_EQ(run({"texture", "seam", fine, blue, "--band-px", "12", "--out", path("seam.tif"), "-q"})
                .status,
            0);
  const Grid<glm::vec3> joined = read_picture(path("seam.tif"));
  for (const auto [x, y] : test::cells(80 - 12, 70)) ASSERT_EQ(joined(x, y), before(x, y));
}

TEST_F(TexturePictures, MasksThatSayNothingAreNamed) {
  const std::string model = write_model();
  const std::string crop = write_meadow("crop.png", 72, 64);
  const std::string none = write_labels("none.tif", 72, 64, [](int, int) { return 0; });
  EXPECT_THAT(
      run({"texture", "fill", crop, "--hole", none, "--model", model, "--out", path("same.png")}),
      Ends(0, HasSubstr("marks nothing")));
  EXPECT_EQ(read_picture(path("same.png")), read_picture(crop));
  EXPECT_THAT(run({"texture", "erode", none, "--steps", "2", "--out", path("series")}),
              Ends(0, HasSubstr("marks nothing")));
  EXPECT_THAT(
      run({"texture", "erode", none, "--label", "9", "--steps", "2", "--out", path("series")}).err,
      HasSubstr("the number 9"));
  const std::string small = write_labels("small.tif", 70, 64, [](int, int) { return 1; });
  refused({"texture", "fill", crop, "--hole", small, "--model", model, "--out", path("x.png")}, 3,
          "70 × 64");
  refused({"texture", "fill", crop, "--hole", crop, "--model", model, "--out", path("x.png")}, 3,
          "crop.png");
}

TEST_F(TexturePictures, SizesHaveTheirLimits) {
  const std::string model = write_model();
  refused({"texture", "make", model, "--size", "20000x20000", "--out", path("x.png")}, 5,
          "20000 × 20000");
  refused({"texture", "make", model, "--window", "0,0,20000,20000", "--out", path("x.png")}, 5,
          "20000 × 20000");
  refused({"texture", "make", model, "--window", "0,0,0,9", "--out", path("x.png")}, 5, "0 × 9");
  refused({"texture", "make", model, "--size", "0x9", "--out", path("x.png")}, 2, "--size");
  refused({"texture", "make", model, "--size", "9x9x9", "--out", path("x.png")}, 2, "");
  refused({"texture", "make", model, "--size", "9", "--out", path("x.png")}, 2, "--size");
  const std::string narrow = write_meadow("narrow.png", 40, 64);
  refused({"texture", "seam", write_meadow("good.png", 72, 64), narrow, "--out", path("x.png")}, 3,
          "40 × 64");
}

TEST_F(TexturePictures, NothingIsWrittenOverWhatIsRead) {
  const std::string model = write_model();
  const std::string crop = write_meadow("crop.png", 72, 64);
  const std::string hole =
      write_labels("hole.tif", 72, 64, [](int x, int) { return x < 20 ? 1 : 0; });
  const std::string before = read_bytes(crop);
  const std::string again =
      path("../" + std::filesystem::path(path("")).parent_path().filename().string() + "/crop.png");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"texture", "learn", crop, "--out", again},
        {"texture", "fill", crop, "--hole", hole, "--model", model, "--out", again},
        {"texture", "seam", crop, crop, "--out", again},
        {"texture", "correct", crop, "--to", crop, "--out", again},
        {"composite", "learn", crop, "--labels", hole, "--out", again},
        {"exemplar", "segment", crop, "--out", again}})
    refused(arguments, 2, "is also an input");
  EXPECT_EQ(read_bytes(crop), before);
}

}  // namespace
}  // namespace belvedere
