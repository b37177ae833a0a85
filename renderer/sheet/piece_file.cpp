#include "renderer/sheet/piece_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/vec2.hpp>
#include <sstream>
#include <system_error>
#include <utility>
#include <variant>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/graph/tile_store.h"
#include "renderer/image/exr/compositing_file.h"
#include "renderer/image/exr/exr_reader.h"
#include "renderer/image/provenance.h"

namespace belvedere {
namespace {

constexpr std::size_t hash_chars = 32;
constexpr std::size_t longest_head = 4096;
constexpr const char* blender_choice = "blender";

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

namespace {

std::size_t bytes_of(ChannelStorage type) { return type == ChannelStorage::half ? 2 : 4; }

// Calls f(channel, grid, component) for every component that the buffers have.
template <class Buffers, class F>
void for_each_component(Buffers& guidance, F&& f) {
  for (const GuidanceChannel& channel : guidance_channels())
    std::visit(
        [&](auto member) {
          auto& grid = guidance.*member;
          if (grid.empty()) return;
          for (std::size_t k = 0; k < channel.components(); ++k) f(channel, grid, k);
        },
        channel.member);
}

// Stride between values of one component: one for plain numbers.
template <class T>
constexpr std::size_t stride = std::is_same_v<T, glm::vec2>   ? 2
                               : std::is_same_v<T, glm::vec3> ? 3
                                                              : 1;

template <class T>
constexpr bool is_number =
    std::is_same_v<T, float> || std::is_same_v<T, glm::vec2> || std::is_same_v<T, glm::vec3>;

// The planes of the available components, each created and filled by its own fill(values), side by
// side.
using FillPlane = std::function<void(std::vector<std::byte>& values)>;
PackedGuidance make_planes(const std::vector<std::pair<ChannelStorage, FillPlane>>& components,
                           int width, int height) {
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  PackedGuidance packed;
  packed.values.resize(components.size());
  parallel_ranges(components.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p != end; ++p) {
      packed.values[p].resize(count * bytes_of(components[p].first));
      components[p].second(packed.values[p]);
    }
  });
  for (std::size_t p = 0; p < components.size(); ++p)
    packed.planes.push_back(
        {packed.values[p].data(), bytes_of(components[p].first), width, height});
  return packed;
}

}  // namespace

GuidanceBuffers sheet_guidance_like(glm::dvec3 origin_m) {
  GuidanceBuffers like;
  like.origin_m = origin_m;
  for (const GuidanceChannel& channel : guidance_channels())
    if (channel.maker != ChannelMaker::strokes) fill_channel(like, channel, 1, 1, channel.sky);
  return like;
}

PackedGuidance blank_packed(const GuidanceBuffers& like, int width, int height) {
  std::vector<std::pair<ChannelStorage, FillPlane>> components;
  for_each_component(like, [&](const GuidanceChannel& channel, const auto&, std::size_t) {
    components.emplace_back(channel.type, [](std::vector<std::byte>&) {});
  });
  return make_planes(components, width, height);
}

PackedGuidance pack_guidance(const GuidanceBuffers& guidance) {
  std::vector<std::pair<ChannelStorage, FillPlane>> components;
  glm::ivec2 size(0);  // with any channels: distances need not be among them
  for_each_component(guidance, [&](const GuidanceChannel& channel, const auto& grid,
                                   [[maybe_unused]] std::size_t k) {
    size = {grid.width(), grid.height()};
    using T = typename std::decay_t<decltype(grid)>::value_type;
    if constexpr (is_number<T>)
      components.emplace_back(channel.type, [&channel, &grid, k](std::vector<std::byte>& values) {
        std::byte* to = values.data();
        const float* from = reinterpret_cast<const float*>(grid.data()) + k;
        if (channel.type == ChannelStorage::half)
          to_halves(from, stride<T>, grid.size(), reinterpret_cast<std::uint16_t*>(to));
        else
          for (std::size_t i = 0; i < grid.size(); ++i)
            std::memcpy(to + 4 * i, from + stride<T> * i, 4);
      });
    else
      components.emplace_back(channel.type, [&grid](std::vector<std::byte>& values) {
        for (std::size_t i = 0; i < grid.size(); ++i) {
          const auto id = static_cast<std::uint32_t>(grid[i]);
          std::memcpy(values.data() + 4 * i, &id, 4);
        }
      });
  });
  return make_planes(components, size.x, size.y);
}

GuidanceBuffers unpack_guidance(const PackedGuidance& packed, const GuidanceBuffers& like) {
  GuidanceBuffers guidance;
  guidance.origin_m = like.origin_m;
  const int width = packed.planes.front().width;
  const int height = packed.planes.front().height;
  for (const GuidanceChannel& channel : guidance_channels())
    std::visit(
        [&](auto member) {
          if (!(like.*member).empty())
            guidance.*member = typename std::decay_t<decltype(guidance.*member)>(width, height);
        },
        channel.member);
  std::size_t p = 0;
  for_each_component(guidance, [&](const GuidanceChannel& channel, auto& grid, std::size_t k) {
    using T = typename std::decay_t<decltype(grid)>::value_type;
    const std::byte* from = packed.values[p++].data();
    if constexpr (is_number<T>) {
      float* to = reinterpret_cast<float*>(grid.data()) + k;
      if (channel.type == ChannelStorage::half)
        from_halves(reinterpret_cast<const std::uint16_t*>(from), grid.size(), to, stride<T>);
      else
        for (std::size_t i = 0; i < grid.size(); ++i)
          std::memcpy(to + stride<T> * i, from + 4 * i, 4);
    } else {
      for (std::size_t i = 0; i < grid.size(); ++i) {
        std::uint32_t id = 0;
        std::memcpy(&id, from + 4 * i, 4);
        grid[i] = static_cast<T>(id);
      }
    }
  });
  return guidance;
}

namespace {

// Channels of strokes belong to exemplar paintings only.
bool has_sheet(const GuidanceChannel& channel) { return channel.maker != ChannelMaker::strokes; }

bool is_of(const GuidanceChannel& channel, const std::string& name) {
  return !name.empty() &&
         std::find(channel.names.begin(), channel.names.end(), name) != channel.names.end();
}

[[noreturn]] void refuse(const std::string& name) {
  std::string names;
  for (const GuidanceChannel& channel : guidance_channels())
    if (has_sheet(channel)) names += (names.empty() ? "" : ", ") + std::string(channel.names[0]);
  throw Error(ErrorKind::usage, "--channels",
              "\"" + name + "\" is not a channel of a picture's guidance",
              names + fmt::format("; or none, or {}", blender_choice));
}

}  // namespace

GuidanceChoice read_guidance_choice(const std::string& text) {
  if (text == "none") return std::vector<std::string>();
  if (text == blender_choice) return std::vector<std::string>{text};
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    const auto known = [&](const GuidanceChannel& channel) {
      return has_sheet(channel) && is_of(channel, name);
    };
    if (std::none_of(guidance_channels().begin(), guidance_channels().end(), known)) refuse(name);
    names.push_back(name);
    begin = end + 1;
  }
  return names;
}

bool is_for_blender(const GuidanceChoice& choice) {
  return choice && choice->size() == 1 && choice->front() == blender_choice;
}

void keep_chosen(GuidanceBuffers& guidance, const GuidanceChoice& choice) {
  if (!choice) return;
  const std::vector<std::string>& chosen =
      is_for_blender(choice) ? compositing_channels() : *choice;
  for (const GuidanceChannel& channel : guidance_channels()) {
    const auto names_it = [&](const std::string& name) { return is_of(channel, name); };
    if (std::none_of(chosen.begin(), chosen.end(), names_it))
      std::visit([&](auto member) { (guidance.*member) = {}; }, channel.member);
  }
}

}  // namespace belvedere
