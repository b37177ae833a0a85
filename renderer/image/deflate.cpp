#include "renderer/image/deflate.h"

#include <libdeflate.h>

#include <new>

namespace belvedere {

struct Deflater::State {
  libdeflate_compressor* compressor = nullptr;
  std::vector<std::uint8_t> room;  // size of the largest result so far
};

Deflater::Deflater(int level) : state_(std::make_unique<State>()) {
  state_->compressor = libdeflate_alloc_compressor(level);
  if (state_->compressor == nullptr) throw std::bad_alloc();
}

Deflater::~Deflater() { libdeflate_free_compressor(state_->compressor); }

std::vector<std::uint8_t> Deflater::pack(const void* bytes, std::size_t count) const {
  std::vector<std::uint8_t>& room = state_->room;
  const std::size_t bound = libdeflate_zlib_compress_bound(state_->compressor, count);
  if (room.size() < bound) room.resize(bound);
  const std::size_t packed =
      libdeflate_zlib_compress(state_->compressor, bytes, count, room.data(), room.size());
  return {room.begin(), room.begin() + static_cast<std::ptrdiff_t>(packed)};
}

std::uint32_t crc32_after(std::uint32_t before, const void* bytes, std::size_t count) {
  return libdeflate_crc32(before, bytes, count);
}

}  // namespace belvedere
