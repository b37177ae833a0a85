#include "renderer/press/vector_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(VectorPage, IsAPageOfTheSizeAsked) {
  const test::Folder folder;
  const std::string svg = folder.write(
      "a.svg",
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="5mm" viewBox="0 0 100 50">
    <rect x="0" y="0" width="100" height="50" fill="#ff0000"/></svg>)");
  const std::string pdf = svg_as_pdf(svg, {254.0, 127.0});
  EXPECT_THAT(pdf, StartsWith("%PDF"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 720 360 ]"));
}

TEST(VectorPage, SaysWhatIsNoSvg) {
  const test::Folder folder;
  const auto refused = [](const std::string& file) {
    return test::message_of(ErrorKind::input, [&] { svg_as_pdf(file, {100, 100}); });
  };
  EXPECT_THAT(refused(folder.write("a.svg", "no drawing")), HasSubstr("cannot be read as SVG"));
  EXPECT_THAT(refused(folder / "absent.svg"), HasSubstr("file not found"));
}

}  // namespace
}  // namespace belvedere
