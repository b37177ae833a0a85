#include "renderer/graph/file_bytes.h"

#include <unistd.h>

#include <cerrno>

namespace belvedere {
namespace {

// `move` is pwrite or pread of the remaining bytes.
template <class Move>
int move_all(std::size_t count, int at_end, Move&& move) {
  for (std::size_t done = 0; done < count;) {
    const ::ssize_t moved = move(done, count - done);
    if (moved < 0 && errno == EINTR) continue;
    if (moved <= 0) return moved < 0 ? errno : at_end;
    done += static_cast<std::size_t>(moved);
  }
  return 0;
}

}  // namespace

int write_bytes_at(int file, const std::byte* bytes, std::size_t count, std::uint64_t at) {
  return move_all(count, ENOSPC, [&](std::size_t done, std::size_t left) {
    return ::pwrite(file, bytes + done, left, static_cast<::off_t>(at + done));
  });
}

int read_bytes_at(int file, std::byte* bytes, std::size_t count, std::uint64_t at) {
  return move_all(count, EIO, [&](std::size_t done, std::size_t left) {
    return ::pread(file, bytes + done, left, static_cast<::off_t>(at + done));
  });
}

}  // namespace belvedere
