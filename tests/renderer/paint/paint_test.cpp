#include "renderer/paint/paint.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

using test::make_slope;

}  // namespace
}  // namespace belvedere
