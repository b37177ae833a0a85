#include "base/cache/content_hash.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

// XXH3-128 with seed 0 of nothing, as published in xxHash's own test vectors.
TEST(ContentHash, HashOfTheEmptyFileIsThePublishedOne) {
  const test::Folder folder;
  EXPECT_EQ(hash_file(folder.write("empty", "")), "99aa06d3014798d86001c324468d497f");
}

// Longer than a read and no multiple of it: streaming must agree with the one-call form of the
// library.
TEST(ContentHash, StreamedHashIsTheHashOfTheBytes) {
  std::string bytes(700'001, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<char>(i * 2654435761U >> 13U);
  const test::Folder folder;
  const std::string path = folder.write("long", bytes);
  EXPECT_EQ(hash_file(path), hash_bytes(bytes));
  bytes[700'000] ^= 1;
  EXPECT_NE(hash_file(path), hash_bytes(bytes));
}

TEST(ContentHash, MissingFileIsAnInputError) {
  for (const char* path : {"/nowhere/dem.tif", "/tmp"}) try {
      hash_file(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_THAT(error.what(), HasSubstr(path));
    }
}

TEST(ContentHash, PartsMakeTheHashOfTheWhole) {
  ContentHash hash;
  EXPECT_EQ(hash.digits(), hash_bytes(""));
  hash.add("moun", 4);
  hash.add("tains", 5);
  EXPECT_EQ(hash.digits(), hash_bytes("mountains"));
}

}  // namespace
}  // namespace belvedere
