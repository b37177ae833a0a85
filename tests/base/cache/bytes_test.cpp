#include "base/cache/bytes.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace belvedere {

struct Survey {
  std::string name;
  Grid<float> heights;
  std::vector<std::string> notes;
  Grid<std::array<std::uint8_t, 3>> colours;
  double area = 0.0;
};

void each_field(auto& bytes, FieldsOf<Survey> auto& survey) {
  auto& [name, heights, notes, colours, area] = survey;
  bytes(name, heights, notes, colours, area);
}

namespace {

Survey example() {
  Survey survey{"north", Grid<float>(3, 2, 7.F), {"one", "", "three"}, {}, 0.1};
  survey.heights(2, 1) = -0.F;
  return survey;
}

Bytes joined(const ByteWriter& writer) {
  Bytes all;
  for (const std::span<const std::byte> part : writer.parts())
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

TEST(Bytes, ValuesComeBackAsTheyWere) {
  const Survey survey = example();
  ByteWriter writer;
  const int written = 5;
  writer(survey, written);
  const Bytes bytes = joined(writer);
  EXPECT_EQ(bytes.size(), writer.size());
  ByteReader reader(bytes);
  Survey back;
  int five = 0;
  reader(back);
  EXPECT_FALSE(reader.is_done()) << "a number is left";
  reader(five);
  EXPECT_TRUE(reader.is_done());
  EXPECT_EQ(back.name, survey.name);
  EXPECT_EQ(back.heights, survey.heights);
  EXPECT_EQ(back.notes, survey.notes);
  EXPECT_EQ(back.colours.width(), 0);
  EXPECT_EQ(back.area, 0.1);
  EXPECT_EQ(five, 5);
}

TEST(Bytes, GridsAreNotCopied) {
  const Survey survey = example();
  ByteWriter writer;
  writer(survey.heights);
  EXPECT_EQ(static_cast<const void*>(writer.parts().back().data()), survey.heights.data());
}

// However few bytes are left, and whatever sizes they contain: nothing is read beyond them, and no
// unreasonable size is allocated.
TEST(Bytes, ThatEndTooEarlyAreNotDone) {
  const Survey survey = example();
  ByteWriter writer;
  writer(survey);
  const Bytes bytes = joined(writer);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Bytes part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    ByteReader reader(part);
    Survey back;
    reader(back);
    EXPECT_FALSE(reader.is_done()) << size;
  }
  for (std::size_t i = 0; i < 16; ++i) {
    Bytes wild = bytes;
    wild[i] = std::byte{0xff};
    ByteReader reader(wild);
    Survey back;
    reader(back);
    EXPECT_LT(back.name.size(), bytes.size());
  }
}

}  // namespace
}  // namespace belvedere
