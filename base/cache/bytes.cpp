#include "base/cache/bytes.h"

namespace belvedere {

std::uint64_t ByteWriter::size() const {
  std::uint64_t sum = 0;
  for (const std::span<const std::byte> part : parts_) sum += part.size();
  return sum;
}

void ByteWriter::add(const void* bytes, std::size_t count) {
  if (count > 0) parts_.emplace_back(static_cast<const std::byte*>(bytes), count);
}

void ByteWriter::put_number(std::uint64_t number) {
  add(&numbers_.emplace_back(number), sizeof number);
}

bool ByteReader::has(std::uint64_t count, std::uint64_t bytes_each) {
  if (count > left_ / bytes_each) failed_ = true;
  return !failed_;
}

bool ByteReader::copy(void* to, std::size_t count) {
  if (!has(count, 1)) return false;
  if (count == 0) return true;
  if (source_ != nullptr) {
    failed_ = !(*source_)(to, count);
  } else {
    std::memcpy(to, rest_.data(), count);
    rest_ = rest_.subspan(count);
  }
  left_ -= count;
  return !failed_;
}

std::uint64_t ByteReader::take_number() {
  std::uint64_t number = 0;
  copy(&number, sizeof number);
  return number;
}

}  // namespace belvedere
