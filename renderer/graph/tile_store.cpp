#include "renderer/graph/tile_store.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <system_error>

#include "base/error.h"
#include "base/parallel.h"

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

namespace {

[[noreturn]] void throw_scratch_error(const std::string& folder, const char* what, int code) {
  throw Error(
      ErrorKind::output, folder, fmt::format("{}: {}", what, std::generic_category().message(code)),
      "enough space for intermediate results: a larger disk, another --out, or more --memory");
}

// Bytes that make a task worthwhile: the first write to memory is slow, and all threads can do it.
constexpr std::size_t bytes_per_task = std::size_t{1} << 18;
constexpr int rows_per_task = 64;

void copy_block(std::byte* to, const std::byte* from, std::size_t bytes) {
  parallel_ranges(bytes, bytes_per_task, [&](std::size_t begin, std::size_t end) {
    std::memcpy(to + begin, from + begin, end - begin);
  });
}

// An unnamed file.
int open_scratch(const std::string& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  std::string name = folder + "/scratch-XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) throw_scratch_error(folder, "cannot create a scratch file in this folder", errno);
  ::unlink(name.c_str());
  return file;
}

}  // namespace

TileStore::TileStore(Place& scratch, int sheet_width, int sheet_height, int tile_px,
                     std::vector<std::size_t> value_bytes)
    : scratch_(scratch),
      width_(sheet_width),
      height_(sheet_height),
      tile_px_(tile_px),
      across_((sheet_width + tile_px - 1) / tile_px),
      down_((sheet_height + tile_px - 1) / tile_px),
      value_bytes_(std::move(value_bytes)),
      tiles_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_)) {
  const std::size_t bytes =
      std::accumulate(value_bytes_.begin(), value_bytes_.end(), std::size_t{0});
  slot_bytes_ = bytes * static_cast<std::size_t>(tile_px_) * static_cast<std::size_t>(tile_px_);
}

TileStore::~TileStore() {
  for (const Tile& tile : tiles_) scratch_.memory_bytes += tile.memory_bytes;
  if (file_ >= 0) ::close(file_);
}

TileStore::Tile& TileStore::tile(int column, int row) {
  return tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) +
                static_cast<std::size_t>(column)];
}
const TileStore::Tile& TileStore::tile(int column, int row) const {
  return tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) +
                static_cast<std::size_t>(column)];
}

PixelRect TileStore::rect(int column, int row) const {
  return {column * tile_px_, row * tile_px_, std::min(width_, (column + 1) * tile_px_),
          std::min(height_, (row + 1) * tile_px_)};
}

bool TileStore::has(int column, int row, PixelRect part) const {
  return intersection(part, tile(column, row).held) == part;
}

void TileStore::put(int column, int row, PixelRect held, const Planes& planes) {
  if (held.empty() || intersection(held, rect(column, row)) != held)
    throw Error(ErrorKind::bug, "tiles", "a rectangle outside the tile");
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < value_bytes_.size(); ++i) {
    if (i >= planes.size() || planes[i].value_bytes != value_bytes_[i] ||
        planes[i].width != held.width() || planes[i].height != held.height())
      throw Error(ErrorKind::bug, "tiles", "planes that do not match the store's");
    bytes += planes[i].bytes();
  }
  drop(column, row);
  Tile& to = tile(column, row);
  if (bytes <= scratch_.memory_bytes) {
    scratch_.memory_bytes -= bytes;
    to.memory = std::make_unique_for_overwrite<std::byte[]>(
        bytes);  // first written by the thread that copies a part
    to.memory_bytes = bytes;
    std::byte* at = to.memory.get();
    for (std::size_t i = 0; i < value_bytes_.size(); at += planes[i].bytes(), ++i)
      copy_block(at, planes[i].values, planes[i].bytes());
  } else {
    if (file_ < 0) file_ = open_scratch(scratch_.folder);
    if (free_slots_.empty()) free_slots_.push_back(slots_++);
    to.slot = free_slots_.back();
    free_slots_.pop_back();
    std::uint64_t at = static_cast<std::uint64_t>(to.slot) * slot_bytes_;
    for (std::size_t i = 0; i < value_bytes_.size(); at += planes[i].bytes(), ++i)
      if (const int code = write_bytes_at(file_, planes[i].values, planes[i].bytes(), at);
          code != 0)
        throw_scratch_error(scratch_.folder, "cannot write a scratch file", code);
  }
  to.held = held;
}

void TileStore::get(int column, int row, PixelRect from, int origin_x, int origin_y,
                    const Planes& wanted) const {
  const Tile& of = tile(column, row);
  const PixelRect area = of.held;
  std::size_t start = 0;  // of the plane in the tile
  for (std::size_t i = 0; i < value_bytes_.size(); ++i) {
    const std::size_t size = value_bytes_[i];
    const std::size_t row_bytes = size * static_cast<std::size_t>(area.width());
    const Plane& to = wanted[i];
    if (to.values != nullptr) {
      const std::size_t first = start + row_bytes * static_cast<std::size_t>(from.y0 - area.y0);
      parallel_ranges(from.height(), rows_per_task, [&](int begin, int end) {
        const std::size_t skipped = first + row_bytes * static_cast<std::size_t>(begin);
        const std::byte* source = nullptr;
        std::unique_ptr<std::byte[]> rows;
        if (of.slot >= 0) {
          const std::size_t bytes = row_bytes * static_cast<std::size_t>(end - begin);
          rows = std::make_unique_for_overwrite<std::byte[]>(bytes);
          source = rows.get();
          const std::uint64_t position =
              static_cast<std::uint64_t>(of.slot) * slot_bytes_ + skipped;
          if (const int code = read_bytes_at(file_, rows.get(), bytes, position); code != 0)
            throw_scratch_error(scratch_.folder, "cannot read a scratch file", code);
        } else {
          source = of.memory.get() + skipped;
        }
        for (int y = begin; y != end; ++y, source += row_bytes)
          std::memcpy(to.values +
                          to.row_bytes() * static_cast<std::size_t>(from.y0 + y - origin_y) +
                          size * static_cast<std::size_t>(from.x0 - origin_x),
                      source + size * static_cast<std::size_t>(from.x0 - area.x0),
                      size * static_cast<std::size_t>(from.width()));
      });
    }
    start += row_bytes * static_cast<std::size_t>(area.height());
  }
}

void TileStore::drop(int column, int row) {
  Tile& old = tile(column, row);
  if (old.held.empty()) return;
  scratch_.memory_bytes += old.memory_bytes;
  if (old.slot >= 0) free_slots_.push_back(old.slot);
  old = {};
}

}  // namespace belvedere
