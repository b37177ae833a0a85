#include "renderer/image/picture_hash.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <map>
#include <string_view>

#include "renderer/image/image_io.h"
#include "renderer/image/provenance.h"

namespace belvedere {
namespace {

// Values are in memory as they are hashed.
static_assert(std::endian::native == std::endian::little);

template <class T>
std::string hash_of(const Grid<T>& values) {
  static_assert(sizeof(T) == 4);
  return hash_bytes(
      std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
}

// One channel at a time, so that memory does not grow with their number.
std::vector<ChannelHash> hash_exr(const std::string& path, const ImageInfo& info) {
  std::map<std::string, bool> is_id;
  for (const PartSpec& part : info.parts)
    for (const ChannelSpec& channel : part.channels)
      is_id[channel.name] = channel.type == ChannelType::uint32;
  std::vector<ChannelHash> out;
  for (const auto& [name, id] : is_id)
    out.push_back(
        {name, id ? hash_of(read_id_channel(path, name)) : hash_of(read_channel(path, name))});
  return out;
}

std::vector<ChannelHash> hash_colours(const std::string& path) {
  Grid<float> alpha;
  const Grid<glm::vec3> picture = read_picture(path, &alpha);
  std::vector<ChannelHash> out;
  Grid<float> channel(picture.width(), picture.height());
  for (int c = 0; c < 3; ++c) {
    std::transform(picture.begin(), picture.end(), channel.begin(),
                   [c](const glm::vec3& colour) { return colour[c]; });
    out.push_back({std::string(1, "RGB"[c]), hash_of(channel)});
  }
  if (std::any_of(alpha.begin(), alpha.end(), [](float v) { return v != 1.F; }))
    out.push_back({"A", hash_of(alpha)});
  return out;
}

}  // namespace

PictureHash hash_picture(const std::string& path) {
  const ImageInfo info = read_image_info(path);
  PictureHash out;
  out.channels = info.format == "openexr" ? hash_exr(path, info) : hash_colours(path);
  std::string all = fmt::format("{} {}\n", info.width, info.height);
  for (const ChannelHash& one : out.channels) all += one.channel + " " + one.hash + "\n";
  out.whole = hash_bytes(all);
  return out;
}

}  // namespace belvedere
