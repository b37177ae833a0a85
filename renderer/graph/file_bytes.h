#pragma once

#include <cstddef>
#include <cstdint>

namespace belvedere {

// All bytes at a place of an open file, however often the system interrupts or gives less than asked for. 0, or the system's number of what
// is wrong: no room where it takes no more, an error of reading where the file ends before.
int write_bytes_at(int file, const std::byte* bytes, std::size_t count, std::uint64_t at);
int read_bytes_at(int file, std::byte* bytes, std::size_t count, std::uint64_t at);

}  // namespace belvedere
