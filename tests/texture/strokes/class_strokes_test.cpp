#include "texture/strokes/class_strokes.h"

#include <gtest/gtest.h>

#include "tests/texture/strokes/stroke_picture.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {
namespace {

// A class with a missing number in its row would be painted in one grey, or not at all.
TEST(ClassStrokes, OfEveryClassWithAWashAreInRange) {
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    using enum LandCoverClass;
    if (info.id == sky || info.id == water || info.id == rock)
      continue;  // all their strokes are of special kinds
    EXPECT_GT(strokes_of(info.id).wash_length, 0.F) << info.name;
    EXPECT_GT(strokes_of(info.id).wash_width, 0.F) << info.name;
    EXPECT_GT(strokes_of(info.id).wash_wander_rad, 0.F) << info.name;
  }
}

// Every class of the table is painted: strokes cover the canvas.
TEST(ClassStrokes, CoverEveryClassOfGround) {
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    if (info.id == LandCoverClass::sky) continue;
    Picture p = plain_picture(info.id, 96, 72);
    p.guidance.depth_m = Grid<float>(96, 72, 9000.F);
    const Grid<glm::vec3> bare(96, 72, glm::vec3(1.F, 0.F, 1.F));
    const Grid<glm::vec3> painted =
        paint_strokes(bare, p.guidance, p.scene().base, {}, p.parameters, silent_progress())
            .picture;
    int covered = 0;
    for (std::size_t i = 0; i < bare.size(); ++i) covered += painted[i].y > 0.1F ? 1 : 0;
    EXPECT_GT(covered, 9 * static_cast<int>(bare.size()) / 10) << info.name;
  }
}

}  // namespace
}  // namespace belvedere
