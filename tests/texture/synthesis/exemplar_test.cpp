#include "texture/synthesis/exemplar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Exemplar exemplar_of(int width, int height) {
  Exemplar exemplar;
  exemplar.name = "alps";
  exemplar.picture = Grid<Rgb8>(width, height);
  exemplar.guides.label = Grid<std::uint8_t>(width, height, 3);
  return exemplar;
}

std::string refused_exemplar(const Exemplar& exemplar, ErrorKind kind = ErrorKind::usage) {
  return test::message_of(kind, [&] { check_exemplar(exemplar); });
}

TEST(Exemplar, IsAPictureWithALabelForEachTexel) {
  Exemplar exemplar = exemplar_of(8, 5);
  EXPECT_NO_THROW(check_exemplar(exemplar));
  exemplar.guides.label = Grid<std::uint8_t>(8, 4);
  EXPECT_THAT(refused_exemplar(exemplar),
              AllOf(HasSubstr("\"alps\""), HasSubstr("labels of 8 × 4"), HasSubstr("8 × 5")));
  exemplar.guides.label = {};
  EXPECT_THAT(refused_exemplar(exemplar), HasSubstr("no labels"));
  exemplar.picture = {};
  EXPECT_THAT(refused_exemplar(exemplar), HasSubstr("no picture"));
}

TEST(Exemplar, ItsGuidesAreCheckedAsThoseOfATarget) {
  Exemplar exemplar = exemplar_of(8, 5);
  exemplar.guides.guides = {{"tone", Grid<std::uint8_t>(5, 8)}};
  EXPECT_THAT(refused_exemplar(exemplar), AllOf(HasSubstr("\"alps\""), HasSubstr("\"tone\"")));
}

// Positions in it are stored in two numbers of 16 bits.
TEST(Exemplar, SidesHaveALimit) {
  EXPECT_NO_THROW(check_exemplar(exemplar_of(Exemplar::largest_side, 1)));
  EXPECT_NO_THROW(check_exemplar(exemplar_of(1, Exemplar::largest_side)));
  EXPECT_THAT(refused_exemplar(exemplar_of(Exemplar::largest_side + 1, 1), ErrorKind::limit),
              HasSubstr("32767"));
  EXPECT_THAT(refused_exemplar(exemplar_of(1, Exemplar::largest_side + 1), ErrorKind::limit),
              HasSubstr("32767"));
}

}  // namespace
}  // namespace belvedere
