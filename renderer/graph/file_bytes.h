#pragma once

#include <cstddef>
#include <cstdint>

namespace belvedere {

// Reads or writes all bytes at a position of an open file, despite interruptions and partial
// transfers. Returns 0 or an errno: no space where no more can be written, a read error where the
// file ends early.
int write_bytes_at(int file, const std::byte* bytes, std::size_t count, std::uint64_t at);
int read_bytes_at(int file, std::byte* bytes, std::size_t count, std::uint64_t at);

}  // namespace belvedere
