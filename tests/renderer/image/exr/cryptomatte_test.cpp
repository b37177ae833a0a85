#include "renderer/image/exr/cryptomatte.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace belvedere {
namespace {

std::uint32_t bits_of(const char* name) {
  return std::bit_cast<std::uint32_t>(cryptomatte_id(name));
}

// Published values of MurmurHash3_x86_32 with seed 0.
TEST(Cryptomatte, HashIsMurmurHash3) {
  EXPECT_EQ(murmur_hash3(""), 0U);
  EXPECT_EQ(murmur_hash3("test"), 0xba6bd213U);
  EXPECT_EQ(murmur_hash3("Hello, world!"), 0xc0363e43U);
  EXPECT_EQ(murmur_hash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723U);
}

// Ids of the sample files of the specification.
TEST(Cryptomatte, IdsAreThoseOfTheSpecification) {
  EXPECT_EQ(bits_of("bunny"), 0x13851a76U);
  EXPECT_EQ(bits_of("default"), 0x42c9679fU);
}

// 0x8047664c would be subnormal, 0xffa5d8d1 no number: only their exponents change.
TEST(Cryptomatte, EveryIdIsANumber) {
  EXPECT_EQ(murmur_hash3("class138"), 0x8047664cU);
  EXPECT_EQ(bits_of("class138"), 0x80c7664cU);
  EXPECT_EQ(murmur_hash3("class190"), 0xffa5d8d1U);
  EXPECT_EQ(bits_of("class190"), 0xff25d8d1U);
  EXPECT_TRUE(std::isnormal(cryptomatte_id("")));
}

TEST(Cryptomatte, NotesNameTheLayerByItsHash) {
  const FileNotes notes = cryptomatte_notes("ViewLayer.CryptoLandCover", {"sky", "a \"b\""});
  EXPECT_EQ(notes.size(), 4U);
  EXPECT_EQ(notes.at("cryptomatte/c8b75a6/name"), "ViewLayer.CryptoLandCover");
  EXPECT_EQ(notes.at("cryptomatte/c8b75a6/hash"), "MurmurHash3_32");
  EXPECT_EQ(notes.at("cryptomatte/c8b75a6/conversion"), "uint32_to_float32");
  EXPECT_THAT(notes.at("cryptomatte/c8b75a6/manifest"),
              testing::StartsWith("{\"sky\":\"d12be799\",\"a \\\"b\\\"\":\""));
  EXPECT_EQ(cryptomatte_notes("x", {}).begin()->first.size(),
            std::string("cryptomatte/0123456/conversion").size());
}

}  // namespace
}  // namespace belvedere
