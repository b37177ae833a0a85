#include <gtest/gtest.h>

TEST(Skeleton, Links) { SUCCEED(); }
