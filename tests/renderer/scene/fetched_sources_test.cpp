#include "renderer/scene/fetched_sources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(FetchedSources, AreTheTablesOfAScene) {
  FetchedArea area;
  area.elevation.file = "elevation.tif";
  area.elevation.origin = "Heights, tile \"N47\"";
  area.elevation.licence = "© Surveyors";
  area.elevation.get_from = "belvedere fetch";
  const std::string heights = fetched_sources(area, "data");
  EXPECT_THAT(heights, AllOf(HasSubstr("[[terrain.sources]]\nfile = \"data/elevation.tif\"\n"),
                             HasSubstr("licence = \"© Surveyors\""), HasSubstr("\\\"N47\\\""),
                             Not(HasSubstr("land_cover"))));
  area.land_cover.emplace();
  area.land_cover->file = "land_cover.tif";
  area.land_cover->source.legend = "esa_worldcover";
  EXPECT_THAT(fetched_sources(area, ""),
              AllOf(HasSubstr("[land_cover]\nlegend = \"esa_worldcover\""),
                    HasSubstr("[[land_cover.sources]]\nfile = \"land_cover.tif\"")));
}

}  // namespace
}  // namespace belvedere
