// PDF files, read by other programs: Poppler's and qpdf's.
#include "renderer/press/print_pdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/image/icc/press_profile.h"

namespace belvedere {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr double dots_per_inch = 100.0;

Grid<glm::vec3> coloured_squares() {
  Grid<glm::vec3> out(150, 100);
  for (const auto [x, y] : test::cells(150, 100))
    for (int c = 0; c < 3; ++c)
      out(x, y)[c] =
          static_cast<float>(random_uniform(9, x / 10, y / 10, static_cast<std::uint64_t>(c)));
  return out;
}

class PrintPdf : public testing::Test {
 protected:
  PrintPdf() {
    write_tiff16(folder_ / "a.tif", coloured_squares(),
                 {.dots_per_inch = dots_per_inch, .icc_profile = srgb_profile(), .notes = {}});
  }

  PdfReport write(const std::string& name, const PdfParameters& parameters) const {
    Progress progress;
    return write_print_pdf(folder_ / name, find_press_picture(folder_ / "a.tif"), parameters,
                           progress);
  }
  // Output of a program; the test fails where it cannot run.
  std::string say(const std::string& command) const {
    const std::string out = folder_ / "said";
    EXPECT_EQ(std::system(("cd " + folder_.path() + " && " + command + " > said 2>&1").c_str()), 0)
        << test::read_bytes(out);
    return test::read_bytes(out);
  }
  static PdfParameters for_press() {
    PdfParameters parameters;
    parameters.press = test::press_profile();
    return parameters;
  }
  // The numbers of the picture in the file, as qpdf unpacks them.
  std::string numbers(const std::string& file) const {
    std::istringstream list(say("pdfimages -list " + file));
    std::string line;
    std::getline(list, line);
    std::getline(list, line);
    std::getline(list, line);
    std::istringstream words(line);
    std::string word;
    for (int i = 0; i < 11; ++i) words >> word;  // the 11th is the object
    say("qpdf --show-object=" + word + " --filtered-stream-data " + file +
        " | cat > numbers; true");
    return test::read_bytes(folder_ / "numbers");
  }
  test::Folder folder_;
};

TEST_F(PrintPdf, NumbersAreThoseOfThePress) {
  for (const int bits : {8, 16}) {
    PdfParameters parameters = for_press();
    parameters.bits = bits;
    const PdfReport report = write("a.pdf", parameters);
    EXPECT_EQ(report.pages, 1U);
    EXPECT_NEAR(report.picture_mm.x, 150 * 25.4 / dots_per_inch, 1e-3);
    EXPECT_EQ(report.ink.pixels, 150U * 100U);
    const std::string found = numbers("a.pdf");
    const Grid<Inks> inks = PressConversion(parameters.press, parameters.device)
                                .convert(read_picture(folder_ / "a.tif"));
    ASSERT_EQ(found.size(), inks.size() * 4 * static_cast<std::size_t>(bits / 8));
    for (std::size_t i = 0; i < inks.size(); ++i)
      for (std::size_t c = 0; c < 4; ++c) {
        const auto byte = [&](std::size_t at) {
          return static_cast<double>(static_cast<std::uint8_t>(found[at]));
        };
        const std::size_t at = 4 * i + c;
        const double value =
            bits == 16 ? (256.0 * byte(2 * at) + byte(2 * at + 1)) / 65535.0 : byte(at) / 255.0;
        ASSERT_NEAR(value, inks[i][static_cast<int>(c)], bits == 16 ? .51 / 65535.0 : .51 / 255.0)
            << i;
      }
  }
}

TEST_F(PrintPdf, IsBuiltAsPdfXAsks) {
  PdfParameters parameters = for_press();
  parameters.pages = {.bleed_mm = 2.0, .marks = true};
  parameters.title = "Karwendel & Inn";
  write("a.pdf", parameters);
  EXPECT_THAT(say("qpdf --check a.pdf"), HasSubstr("No syntax or stream encoding errors found"));
  const std::string info = say("pdfinfo -box a.pdf");
  EXPECT_THAT(info, HasSubstr("Karwendel & Inn"));
  EXPECT_THAT(info, ContainsRegex("PDF version: *1.6"));
  EXPECT_THAT(
      info, ContainsRegex(
                "BleedBox: *22.68 *22.68 *130.68 *94.68"));  // 8 mm; 150 × 100 pixels of 1/100 inch
  EXPECT_THAT(info,
              ContainsRegex("TrimBox: *28.35 *28.35 *125.01 *89.01"));  // 2 mm less on each side
  EXPECT_THAT(say("pdfinfo -meta a.pdf"),
              HasSubstr("<pdfxid:GTS_PDFXVersion>PDF/X-4</pdfxid:GTS_PDFXVersion>"));
  const std::string bytes = test::read_bytes(folder_ / "a.pdf");
  EXPECT_THAT(bytes, HasSubstr("/S /GTS_PDFX"));
  EXPECT_THAT(bytes, HasSubstr("/Trapped /False"));
  EXPECT_THAT(bytes, HasSubstr("/Separation /All"));
}

TEST_F(PrintPdf, WithoutAPressItIsThePicture) {
  write("a.pdf", {});
  EXPECT_THAT(test::read_bytes(folder_ / "a.pdf"), Not(HasSubstr("GTS_PDFX")));
  const std::string found = numbers("a.pdf");
  const Grid<glm::vec3> as_read = read_picture(folder_ / "a.tif");
  ASSERT_EQ(found.size(), as_read.size() * 3);
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_NEAR(static_cast<std::uint8_t>(found[i]),
                255.0F * as_read[i / 3][static_cast<int>(i % 3)], .51)
        << i;
  say("pdftoppm -r 100 -png a.pdf page");
  const Grid<glm::vec3> page = read_picture(folder_ / "page-1.png");
  const Grid<glm::vec3> squares = coloured_squares();
  ASSERT_TRUE(page.same_size(squares));
  for (const auto [x, y] : test::cells({5, 5, 150, 100}, 10))
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(page(x, y)[c], squares(x, y)[c], .03)
          << x << " " << y << ": by the tables of the program that shows it";
}

TEST_F(PrintPdf, LabelsStayTextAndPrintInBlack) {
  folder_.write(
      "labels.svg",
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 150 100" font-family="sans-serif" font-size="12px">
<text x="10" y="40" fill="#000000">Grosse</text><g opacity=".5"><rect x="9" y="9" width="9" height="9" fill="#000000"/></g>
<text x="10" y="70" fill="#8b1a1a">Seekar</text></svg>)");
  PdfParameters parameters = for_press();
  parameters.labels = folder_ / "labels.svg";
  write("a.pdf", parameters);
  const std::string text = say("pdftotext a.pdf -");
  EXPECT_THAT(text, HasSubstr("Grosse"));
  EXPECT_THAT(text, HasSubstr("Seekar"));
  EXPECT_THAT(say("pdffonts a.pdf"), ContainsRegex("yes yes"));
  say("qpdf --qdf --object-streams=disable a.pdf plain.pdf");
  const std::string plain = test::read_bytes(folder_ / "plain.pdf");
  EXPECT_THAT(plain, HasSubstr("/DefaultRGB"));
  EXPECT_THAT(plain, Not(HasSubstr("\n0 0 0 rg")));
  EXPECT_THAT(plain, Not(HasSubstr("/CS /DeviceRGB")));
  EXPECT_THAT(plain, HasSubstr(" rg")) << "the red one keeps its colour";
}

TEST_F(PrintPdf, TilesAreSeveralPagesOfOnePicture) {
  PdfParameters parameters;
  parameters.width_mm = 500.0;
  parameters.pages.paper_mm = glm::dvec2(297, 210);
  const PdfReport report = write("a.pdf", parameters);
  EXPECT_EQ(report.pages, 4U);  // 500 × 333 mm on 277 × 190
  EXPECT_THAT(say("pdfinfo a.pdf"), ContainsRegex("Pages: *4"));
  EXPECT_LT(test::read_bytes(folder_ / "a.pdf").size(), 100000U) << "the picture is there once";
}

TEST_F(PrintPdf, SameBytesForAnyThreads) {
  {
    const ThreadLimit limit(1);
    write("a.pdf", for_press());
  }
  write("b.pdf", for_press());
  EXPECT_EQ(test::read_bytes(folder_ / "a.pdf"), test::read_bytes(folder_ / "b.pdf"));
}

TEST_F(PrintPdf, FaultsLeaveNoFile) {
  write_png8(folder_ / "b.png", coloured_squares(), {});
  Progress progress;
  const auto no_size = [&] {
    write_print_pdf(folder_ / "b.pdf", find_press_picture(folder_ / "b.png"), {}, progress);
  };
  EXPECT_THAT(test::usage_error(no_size), HasSubstr("--width-mm"));
  PdfParameters parameters;
  parameters.labels = folder_.write("text.svg", "no drawing");
  EXPECT_THAT(test::input_error([&] { write("c.pdf", parameters); }), HasSubstr("text.svg"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "c.pdf"));
  EXPECT_THAT(test::message_of(ErrorKind::output,
                               [&] {
                                 write_print_pdf("/dev/full/a.pdf",
                                                 find_press_picture(folder_ / "a.tif"), {},
                                                 progress);
                               }),
              HasSubstr("/dev/full"));
}

}  // namespace
}  // namespace belvedere
