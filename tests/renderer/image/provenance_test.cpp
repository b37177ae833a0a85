#include "renderer/image/provenance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

// XXH3-128 with seed 0 of nothing, as published in xxHash's own test vectors.
TEST(Provenance, HashOfTheEmptyFileIsThePublishedOne) {
  const test::Folder folder;
  EXPECT_EQ(hash_file(folder.write("empty", "")), "99aa06d3014798d86001c324468d497f");
}

// Longer than a read and no multiple of it: streaming must agree with the one-call form of the library.
TEST(Provenance, StreamedHashIsTheHashOfTheBytes) {
  std::string bytes(700'001, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 2654435761U >> 13U);
  const test::Folder folder;
  const std::string path = folder.write("long", bytes);
  EXPECT_EQ(hash_file(path), hash_bytes(bytes));
  bytes[700'000] ^= 1;
  EXPECT_NE(hash_file(path), hash_bytes(bytes));
}

TEST(Provenance, MissingFileIsAnInputError) {
  for (const char* path : {"/nowhere/dem.tif", "/tmp"}) try {
      hash_file(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_THAT(error.what(), HasSubstr(path));
    }
}

TEST(Provenance, NotesSayEverythingAndNothingOfTheMoment) {
  const test::Folder folder;
  const std::string path = folder.write("dem.tif", "metres");
  const Provenance provenance = make_provenance("version = 1\n", {{"data/dem.tif", path}, {"data/a.tif", path}});
  const auto notes = to_notes(provenance);
  EXPECT_THAT(notes.at("belvedere:version"), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(notes.at("belvedere:libraries"), HasSubstr("Embree 3."));
  EXPECT_THAT(notes.at("belvedere:libraries"), HasSubstr("GDAL 3."));
  EXPECT_THAT(notes.at("belvedere:instruction_set"), MatchesRegex("SSE.*|AVX.*"));
  EXPECT_EQ(notes.at("belvedere:scene"), "version = 1\n");
  const std::string hash = hash_bytes("metres");
  EXPECT_EQ(notes.at("belvedere:inputs"), hash + "  data/a.tif\n" + hash + "  data/dem.tif\n");
  EXPECT_EQ(notes, to_notes(make_provenance("version = 1\n", {{"data/dem.tif", path}, {"data/a.tif", path}})));
  for (const auto& [key, text] : notes) EXPECT_EQ(text.find(folder.path()), std::string::npos) << key;
  EXPECT_TRUE(to_notes(Provenance{}).empty());
}

}  // namespace
}  // namespace belvedere
