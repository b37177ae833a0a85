#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace belvedere {

// Packs bytes like zlib (RFC 1950), by libdeflate: the same bytes for the same level and version,
// on any processor. One for each thread.
class Deflater {
 public:
  // level: 1 packs fastest, 12 smallest
  explicit Deflater(int level);
  ~Deflater();
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  std::vector<std::uint8_t> pack(const void* bytes, std::size_t count) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The checksum of ZIP and PNG (CRC-32), of bytes that follow those of `before`; 0: of the first.
std::uint32_t crc32_after(std::uint32_t before, const void* bytes, std::size_t count);

}  // namespace belvedere
