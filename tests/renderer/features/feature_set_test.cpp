#include "renderer/features/feature_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Sources : public testing::Test {
 protected:
  std::string write(const std::string& features) const {
    return folder_.write("roads.geojson",
                         "{\"type\": \"FeatureCollection\", \"features\": [" + features + "]}");
  }
  static std::string line(const std::string& properties) {
    return "{\"type\": \"Feature\", \"properties\": {" + properties +
           "}, \"geometry\": {\"type\": \"LineString\", \"coordinates\": [[11, 47], [11.1, 47]]}}";
  }
  FeatureSet read(const FeatureSource& source) const {
    return read_feature_set(load_feature_style("classic"), {source}, normalize_crs("EPSG:32632"));
  }
  const FeatureKind& kind_of(const FeatureSet& set, std::size_t i) const {
    return set.style.kinds[static_cast<std::size_t>(set.features[i].kind)];
  }
  test::Folder folder_;
};

TEST_F(Sources, KindsComeFromAColumn) {
  const std::string file =
      write(line("\"highway\": \"primary\", \"w\": \"7,5 m\"") + "," +
            line("\"highway\": \"Footway\", \"w\": \"wide\"") + "," +
            line("\"highway\": \"elevator\"") + "," + line("\"highway\": \"house\""));
  const FeatureSet set =
      read({.file = file, .kind_of = "highway", .width_of = "w", .key = "features.0"});
  ASSERT_EQ(set.features.size(), 2U);
  EXPECT_EQ(kind_of(set, 0).name, "main_road");
  EXPECT_FLOAT_EQ(set.features[0].real_m, 7.5F);
  EXPECT_EQ(kind_of(set, 1).name, "path");
  EXPECT_FLOAT_EQ(set.features[1].real_m, static_cast<float>(kind_of(set, 1).real_m))
      << "no length: the style's";
  const SourceReading& reading = set.readings[0];
  EXPECT_EQ(reading.read, 4U);
  EXPECT_EQ(reading.taken, 2U);
  EXPECT_EQ(reading.wrong_width, 1U);
  EXPECT_EQ(reading.unknown.at("elevator"), 1U);
  EXPECT_EQ(reading.wrong_shape, 1U) << "a house is no line";
  EXPECT_LT(reading.low.x, reading.high.x);
}

TEST_F(Sources, OrAreSaid) {
  const std::string file = write(line("\"highway\": \"elevator\""));
  const FeatureSet set =
      read({.file = file, .kind = "railway", .width_mm = 1.25, .key = "features.0"});
  ASSERT_EQ(set.features.size(), 1U);
  EXPECT_EQ(kind_of(set, 0).name, "railway");
  EXPECT_FLOAT_EQ(set.features[0].width_mm, 1.25F);
  // With a column, the features whose kind is unknown.
  const FeatureSet rest =
      read({.file = file, .kind = "track", .kind_of = "highway", .key = "features.0"});
  EXPECT_EQ(kind_of(rest, 0).name, "track");
  EXPECT_FLOAT_EQ(rest.features[0].width_mm, static_cast<float>(kind_of(rest, 0).width_mm));
}

TEST_F(Sources, AWordThatTheStyleDoesNotKnowIsSaidWithThoseItKnows) {
  const std::string file = write(line(""));
  EXPECT_THAT(test::message_of(ErrorKind::usage,
                               [&] { read({.file = file, .kind = "raod", .key = "features.3"}); }),
              AllOf(HasSubstr("features.3.kind"), HasSubstr("did you mean \"road\""),
                    HasSubstr("motorway")));
}

}  // namespace
}  // namespace belvedere
