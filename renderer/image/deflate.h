#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace belvedere {

// Packs bytes as zlib does (RFC 1950), by libdeflate: the same bytes for the same level and version, on any processor. One for each thread.
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

}  // namespace belvedere
