#include "renderer/image/display_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/mat3x3.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/renderer/image/random_picture.h"

namespace belvedere {
namespace {

using test::Folder;
using test::random_picture;

// IEC 61966-2-1, written independently.
double encode(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

Image grey_ramp(int count, double low, double high) {
  Image out(count, 1);
  for (int x = 0; x < count; ++x)
    out(x, 0) = glm::vec3(static_cast<float>(low + (high - low) * x / (count - 1)));
  return out;
}

Error error_of(const DisplayParameters& parameters) {
  return test::error_of([&] { to_display(Image(1, 1), parameters); });
}

class Color : public testing::Test {
 protected:
  void SetUp() override { ::unsetenv("OCIO"); }
  void TearDown() override { ::unsetenv("OCIO"); }
};

TEST_F(Color, OwnConfigIsTheExactCurve) {
  const Image linear = grey_ramp(70001, 0.0, 1.0);
  const Grid<glm::vec3> encoded = to_display(linear, {});
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const double expected = encode(static_cast<double>(linear[i].x));
    ASSERT_NEAR(encoded[i].x, expected, 1e-6) << linear[i].x;
    ASSERT_EQ(encoded[i].x, encoded[i].y) << "grey stays grey";
    ASSERT_EQ(encoded[i].x, encoded[i].z);
  }
  // The dark end, where 16-bit steps are finest, and light beyond white.
  for (const Image& part : {grey_ramp(20001, 0.0, 0.008), grey_ramp(1001, 1.0, 40.0)}) {
    const Grid<glm::vec3> out = to_display(part, {});
    for (std::size_t i = 0; i < part.size(); ++i)
      ASSERT_NEAR(out[i].x, encode(static_cast<double>(part[i].x)),
                  1e-6 * std::max(1.0f, out[i].x));
  }
}

TEST_F(Color, AcesSpacesAreThosePublished) {
  // AP1 to Rec. 709 with Bradford, as in the ACES documents (S-2014-004 with the usual adaptation),
  // columns of glm are the rows transposed.
  const glm::dmat3 published(1.70505, -0.13026, -0.02400, -0.62179, 1.14080, -0.12897, -0.08326,
                             -0.01055, 1.15297);
  DisplayParameters parameters;
  parameters.working = "acescg";
  parameters.display = "lin_srgb";
  Image primaries(3, 1);
  for (int c = 0; c < 3; ++c) primaries(c, 0)[c] = 1.0f;
  const Grid<glm::vec3> out = to_display(primaries, parameters);
  for (const auto [row, column] : test::cells(3, 3))
    EXPECT_NEAR(out(column, 0)[row], published[column][row], 5e-4) << column << " " << row;
  for (const char* space : {"aces", "acescg"}) {
    parameters.working = space;
    const Grid<glm::vec3> grey = to_display(grey_ramp(11, 0.0, 1.0), parameters);
    for (int x = 0; x < 11; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(grey(x, 0)[c], x / 10.0, 2e-5) << space << ": the grey axis stays neutral";
  }
}

TEST_F(Color, SameBitsForAnyThreads) {
  const Image linear = random_picture(301, 203);
  const Grid<glm::vec3> many = to_display(linear, {});
  const ThreadLimit one(1);
  EXPECT_EQ(to_display(linear, {}), many);
}

constexpr const char* doubling_config = R"(ocio_profile_version: 2
search_path: ""
strictparsing: true
roles:
  default: lin_srgb
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  monitor:
    - !<View> {name: twice, colorspace: srgb}
active_displays: []
active_views: []
colorspaces:
  - !<ColorSpace>
    name: lin_srgb
  - !<ColorSpace>
    name: srgb
    from_scene_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: broken
    from_scene_reference: !<FileTransform> {src: missing.spi1d}
)";

TEST_F(Color, FileAndEnvironmentOverride) {
  const Folder folder("color");
  test::write_bytes(folder / "a.ocio", doubling_config);
  const Image grey(3, 2, glm::vec3(0.3f));
  DisplayParameters parameters;
  parameters.config = folder / "a.ocio";
  EXPECT_NEAR(to_display(grey, parameters)(2, 1).y, 0.6, 1e-6);
  parameters.display = "monitor/twice";
  EXPECT_NEAR(to_display(grey, parameters)(2, 1).y, 0.6, 1e-6);
  ::setenv("OCIO", (folder / "a.ocio").c_str(), 1);
  EXPECT_NEAR(to_display(grey, {})(0, 0).y, 0.6, 1e-6);
  ::setenv("OCIO", "", 1);
  EXPECT_NEAR(to_display(grey, {})(0, 0).y, encode(0.3), 1e-6);
}

TEST_F(Color, FaultsAreNamed) {
  const Folder folder("color");
  const auto expect = [](const DisplayParameters& parameters, const std::string& name) {
    const Error e = error_of(parameters);
    EXPECT_EQ(e.kind(), ErrorKind::input);
    EXPECT_THAT(e.what(), testing::HasSubstr(name));
  };
  DisplayParameters parameters;
  parameters.config = folder / "absent.ocio";
  expect(parameters, "absent.ocio");
  test::write_bytes(folder / "bad.ocio", "this is no config: [");
  parameters.config = folder / "bad.ocio";
  expect(parameters, "bad.ocio");
  test::write_bytes(folder / "a.ocio", doubling_config);
  parameters.config = folder / "a.ocio";
  parameters.display = "broken";
  expect(parameters, "missing.spi1d");
  parameters.display = "monitor/absent";
  expect(parameters, "a.ocio");
  parameters = {};
  parameters.working = "lin_rec2020";
  expect(parameters, "lin_rec2020");
  expect(parameters, "lin_srgb");
  ::setenv("OCIO", "/nowhere/x.ocio", 1);
  expect({}, "/nowhere/x.ocio");
}

}  // namespace
}  // namespace belvedere
