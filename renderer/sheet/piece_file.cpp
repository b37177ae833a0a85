#include "renderer/sheet/piece_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "renderer/graph/tile_store.h"
#include "renderer/image/provenance.h"

namespace belvedere {
namespace {

constexpr std::size_t hash_chars = 32;
constexpr std::size_t longest_head = 4096;

std::string head_of(const PieceKey& key) {
  return fmt::format("belvedere piece 1\njob {}\nproduct {}\nrectangle {} {} {} {}\n", key.job,
                     key.product, key.rect.x0, key.rect.y0, key.rect.x1, key.rect.y1);
}

[[noreturn]] void throw_write_error(const std::string& path, const char* what, int code) {
  throw Error(ErrorKind::output, path,
              fmt::format("{}: {}", what, std::generic_category().message(code)));
}

// A name that no other process and no other thread of this one uses at the same time.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> count{0};
  return fmt::format("{}.{}-{}.tmp", path, static_cast<long>(::getpid()), count.fetch_add(1));
}

struct OpenFile {
  explicit OpenFile(int file) : descriptor(file) {}
  ~OpenFile() {
    if (descriptor >= 0) ::close(descriptor);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor;
};

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return file ? std::move(text).str() : std::string();
}

}  // namespace

void write_piece(const std::string& path, const PieceKey& key, const Planes& planes) {
  std::string content = head_of(key) + "planes";
  std::size_t bytes = 0;
  for (const Plane& plane : planes) {
    content += fmt::format(" {}", plane.value_bytes);
    bytes += plane.bytes();
  }
  content += "\n\n";
  content.reserve(content.size() + bytes + hash_chars);
  for (const Plane& plane : planes)
    content.append(reinterpret_cast<const char*>(plane.values), plane.bytes());
  content += hash_bytes(content);

  const std::string temporary = temporary_name(path);
  OpenFile file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (file.descriptor < 0) throw_write_error(path, "cannot be created", errno);
  const auto give_up = [&](const char* what, int code) {
    ::unlink(temporary.c_str());
    throw_write_error(path, what, code);
  };
  const auto* bytes_of_content = reinterpret_cast<const std::byte*>(content.data());
  if (const int code = write_bytes_at(file.descriptor, bytes_of_content, content.size(), 0);
      code != 0)
    give_up("cannot be written", code);
  // Some systems report a full disk only now.
  if (::fdatasync(file.descriptor) != 0) give_up("cannot be flushed to disk", errno);
  const int closed = ::close(file.descriptor);
  file.descriptor = -1;
  if (closed != 0) give_up("cannot be closed", errno);
  if (::rename(temporary.c_str(), path.c_str()) != 0) give_up("cannot be renamed", errno);
}

bool is_whole_piece(const std::string& path, const PieceKey& key) {
  const std::string content = read_file(path);
  const std::string head = head_of(key);
  if (content.size() < head.size() + hash_chars || content.compare(0, head.size(), head) != 0)
    return false;
  const std::string_view all(content);
  return hash_bytes(all.substr(0, all.size() - hash_chars)) == all.substr(all.size() - hash_chars);
}

PieceLayout read_piece_layout(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(longest_head, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t planes = head.find("\nplanes");
  const std::size_t end = head.find("\n\n", planes);
  if (planes == std::string::npos || end == std::string::npos)
    throw Error(ErrorKind::input, path, "is not a finished piece");
  PieceLayout layout;
  std::istringstream numbers(head.substr(planes + 7, end - planes - 7));
  for (std::size_t bytes = 0; numbers >> bytes;) layout.value_bytes.push_back(bytes);
  layout.begin = end + 2;
  std::error_code code;
  const std::uint64_t size = std::filesystem::file_size(path, code);
  if (code || size < layout.begin + hash_chars) throw Error(ErrorKind::input, path, "is truncated");
  layout.bytes = size - layout.begin - hash_chars;
  return layout;
}

void read_piece_rows(const std::string& path, const PieceKey& key, int y0, int y1, int origin_x,
                     const Planes& to) {
  const PieceLayout layout = read_piece_layout(path);
  const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.descriptor < 0)
    throw Error(ErrorKind::input, path, "this finished piece cannot be opened");
  const auto width = static_cast<std::size_t>(key.rect.width());
  // It was whole when it was found; since then another program may have changed it.
  std::uint64_t bytes = 0;
  for (const Plane& plane : to)
    bytes += width * static_cast<std::uint64_t>(key.rect.height()) * plane.value_bytes;
  if (layout.bytes != bytes ||
      !std::equal(to.begin(), to.end(), layout.value_bytes.begin(), layout.value_bytes.end(),
                  [](const Plane& plane, std::size_t size) { return plane.value_bytes == size; }))
    throw Error(ErrorKind::input, path, "this finished piece was changed by another program",
                "the same command again, which makes this piece again");
  std::uint64_t start = layout.begin;
  std::vector<std::byte> rows;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const std::size_t size = layout.value_bytes[i];
    rows.resize(width * size * static_cast<std::size_t>(y1 - y0));
    const std::uint64_t first = start + width * size * static_cast<std::uint64_t>(y0 - key.rect.y0);
    if (read_bytes_at(file.descriptor, rows.data(), rows.size(), first) != 0)
      throw Error(ErrorKind::input, path, "this finished piece cannot be read");
    const int x0 = std::max(key.rect.x0, origin_x);
    const int x1 = std::min(key.rect.x1, origin_x + static_cast<int>(to[i].row_bytes() / size));
    for (int y = 0; y < y1 - y0 && x0 < x1; ++y)
      std::memcpy(to[i].values + to[i].row_bytes() * static_cast<std::size_t>(y) +
                      size * static_cast<std::size_t>(x0 - origin_x),
                  rows.data() + size * (width * static_cast<std::size_t>(y) +
                                        static_cast<std::size_t>(x0 - key.rect.x0)),
                  size * static_cast<std::size_t>(x1 - x0));
    start += width * size * static_cast<std::uint64_t>(key.rect.height());
  }
}

std::string read_piece_bytes(const std::string& path) {
  const PieceLayout layout = read_piece_layout(path);
  const std::string content = read_file(path);
  if (content.size() < layout.begin + layout.bytes)
    throw Error(ErrorKind::input, path, "is truncated");
  return content.substr(layout.begin, layout.bytes);
}

}  // namespace belvedere
