#pragma once

#include <gtest/gtest.h>

#include <glm/vec3.hpp>

namespace belvedere::test {

inline void expect_near(glm::vec3 a, glm::vec3 b) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-6F) << "channel " << k;
}

}  // namespace belvedere::test
