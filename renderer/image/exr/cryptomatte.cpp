#include "renderer/image/exr/cryptomatte.h"

#include <fmt/core.h>

#include <bit>

#include "base/text/json.h"

namespace belvedere {
namespace {

// Up to four characters, the first in the lowest byte.
std::uint32_t mixed_block(std::string_view block) {
  std::uint32_t k = 0;
  for (std::size_t i = 0; i < block.size(); ++i)
    k |= static_cast<std::uint32_t>(static_cast<unsigned char>(block[i])) << (8 * i);
  return std::rotl(k * 0xcc9e2d51U, 15) * 0x1b873593U;
}

}  // namespace

std::uint32_t murmur_hash3(std::string_view text) {
  std::uint32_t h = 0;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    h ^= mixed_block(text.substr(i, 4));
    if (i + 4 <= text.size()) h = std::rotl(h, 13) * 5U + 0xe6546b64U;
  }
  h ^= static_cast<std::uint32_t>(text.size());
  h = (h ^ (h >> 16)) * 0x85ebca6bU;
  h = (h ^ (h >> 13)) * 0xc2b2ae35U;
  return h ^ (h >> 16);
}

float cryptomatte_id(std::string_view name) {
  std::uint32_t bits = murmur_hash3(name);
  const std::uint32_t exponent = bits >> 23 & 255U;
  if (exponent == 0U || exponent == 255U) bits ^= 1U << 23;
  return std::bit_cast<float>(bits);
}

FileNotes cryptomatte_notes(const std::string& layer, const std::vector<std::string>& names) {
  std::string manifest;
  for (const std::string& name : names)
    manifest += fmt::format("{}{}:\"{:08x}\"", manifest.empty() ? "" : ",", json_quoted(name),
                            std::bit_cast<std::uint32_t>(cryptomatte_id(name)));
  const std::string key =
      "cryptomatte/" + fmt::format("{:08x}", murmur_hash3(layer)).substr(0, 7) + "/";
  return {{key + "name", layer},
          {key + "hash", "MurmurHash3_32"},
          {key + "conversion", "uint32_to_float32"},
          {key + "manifest", "{" + manifest + "}"}};
}

}  // namespace belvedere
