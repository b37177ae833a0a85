#include "renderer/trace/camera_reduced.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(ReducedCamera, HasTheRaysOfTheWholePicture) {
  for (const Projection& projection : projections()) {
    const std::unique_ptr<Camera> whole =
        make_camera({.projection = std::string(projection.name), .width = 1001, .height = 600});
    const std::unique_ptr<const Camera> reduced = make_reduced_camera(*whole, 4);
    EXPECT_EQ(reduced->size(), glm::ivec2(251, 150)) << "rounded up";
    const Ray a = whole->ray({400.0, 120.0});
    const Ray b = reduced->ray({100.0, 30.0});
    EXPECT_EQ(a.origin, b.origin) << projection.name;
    EXPECT_EQ(a.direction, b.direction);
    const auto position = reduced->project(b.origin + b.direction * 5000.0);
    ASSERT_TRUE(position.has_value());
    EXPECT_NEAR(position->x, 100.0, 1e-6);
    EXPECT_NEAR(position->y, 30.0, 1e-6);
  }
}

}  // namespace
}  // namespace belvedere
