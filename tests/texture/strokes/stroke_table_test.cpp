#include "texture/strokes/stroke_table.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string_view>

#include "base/error.h"
#include "base/random.h"
#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {
namespace {

constexpr int table_width = 512;
constexpr int table_height = 384;

// Blocks of all classes side by side, on gentle and steep ground, with glades in the forest and
// ribs of rock in the ice: each kind of stroke occurs somewhere.
Picture patchwork() {
  constexpr int block = 32;
  Picture p = plain_picture(LandCoverClass::rock, table_width, table_height);
  p.guidance.slope_deg = Grid<float>(table_width, table_height);
  p.guidance.relief_s_m = Grid<float>(table_width, table_height, 25.F);
  p.guidance.footprint_m = Grid<float>(table_width, table_height, 15.F);
  p.guidance.built = Grid<float>(table_width, table_height, 0.6F);
  p.ground.accent = Grid<float>(table_width, table_height, -0.8F);
  const auto& classes = land_cover_classes();
  for (const auto [x, y] : test::cells(table_width, table_height)) {
    const int row = y / block;
    const int column = x / (2 * block);
    const auto drawn = random_index(static_cast<std::uint32_t>(classes.size()), 3, column, row);
    LandCoverClass id = classes[drawn].id;
    // Kinds that need certain neighbours do not depend on chance here: forest above pastures,
    // towns large enough for a church.
    if (column == 2)
      id = row % 6 == 0   ? LandCoverClass::forest
           : row % 6 == 1 ? LandCoverClass::pasture
                          : LandCoverClass::settlement;
    if (column < 2) id = row % 6 < 3 ? LandCoverClass::glacier : LandCoverClass::snow;
    if (column == 0 && row % 3 == 0 && x > 28 && x < 37)
      id = LandCoverClass::rock;  // a rib above a stretch of ice
    p.guidance.land_cover(x, y) = id;
    p.guidance.slope_deg(x, y) = column == 1 ? 42.F : row % 2 == 0 ? 5.F : 20.F;
    p.guidance.depth_m(x, y) =
        id == LandCoverClass::sky ? std::numeric_limits<float>::infinity() : 8000.F;
    p.guidance.position_m(x, y) =
        glm::vec3(12.F * static_cast<float>(x), -12.F * static_cast<float>(y), 900.F);
    if (id == LandCoverClass::water && row % 2 == 1)
      p.guidance.position_m(x, y).z -= 6.F * static_cast<float>(y % block);
    if (row == 11) {  // the foreground, in close view
      p.guidance.footprint_m(x, y) = 0.4F;
      p.guidance.position_m(x, y) =
          glm::vec3(0.4F * static_cast<float>(x), -1.2F * static_cast<float>(y), 900.F);
    }
    p.ground.tree_density(x, y) = x % (2 * block) < block ? 0.95F : 0.02F;
  }
  return p;
}

// Some kinds occur in winter only, some on ground that snow covers in winter.
TEST(StrokeTable, EveryKindPaintsInItsLayerAndInNoOther) {
  std::map<std::string_view, std::size_t> of_kind;
  for (const bool winter : {false, true}) {
    Picture p = patchwork();
    p.parameters.winter = winter;
    p.parameters.wind = 2.0;
    p.parameters.foam = true;
    p.parameters.surf_units = 1.0;
    p.parameters.sea_level_m = 900.0;
    const StrokeScene scene = p.scene();
    const auto strokes_of = [&](const StrokeLayers& layers) {
      return static_cast<std::size_t>(paint_strokes(p.ground.colour, p.guidance, p.ground, layers,
                                                    p.parameters, silent_progress())
                                          .stroke_count);
    };
    const StrokeLayers none{
        .sky = false, .ground = false, .accents = false, .breaks = false, .upright = false};
    EXPECT_EQ(strokes_of(none), 0U);
    for (bool StrokeLayers::*const layer :
         {&StrokeLayers::sky, &StrokeLayers::ground, &StrokeLayers::accents, &StrokeLayers::breaks,
          &StrokeLayers::upright}) {
      StrokeLayers one = none;
      one.*layer = true;
      std::size_t grown = 0;
      for (const StrokeKind& kind : stroke_kinds()) {
        if (!is_painted(kind, one)) continue;
        const std::size_t count = grow_strokes(kind.name, scene).size();
        of_kind[kind.name] += count;
        grown += count;
      }
      EXPECT_EQ(strokes_of(one), grown);
    }
  }
  for (const auto& [name, count] : of_kind) EXPECT_GT(count, 0U) << name;
  EXPECT_EQ(of_kind.size(), stroke_kinds().size());
}

TEST(StrokeTable, NamesAndStreamsAreUnique) {
  std::set<std::string_view> names;
  std::set<Stream> streams;
  for (const StrokeKind& kind : stroke_kinds()) {
    EXPECT_FALSE(kind.name.empty());
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_TRUE(streams.insert(kind.stream).second) << kind.name;
  }
}

}  // namespace
}  // namespace belvedere
