#include "renderer/image/picture_diff.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "base/parallel.h"
#include "renderer/image/image_io.h"
#include "renderer/image/provenance.h"

namespace belvedere {
namespace {

double distance(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

// d(i) is the absolute difference of pixel i. Sums run in a fixed order, so that the figures do not
// depend on threads.
template <class Distance>
ChannelDifference summarize(const std::string& name, std::size_t count, Distance&& d) {
  ChannelDifference out;
  out.name = name;
  if (count == 0) return out;
  const auto pixels = static_cast<double>(count);
  out.mean = deterministic_sum(count, d) / pixels;
  out.rms =
      std::sqrt(deterministic_sum(count, [&](std::size_t i) { return d(i) * d(i); }) / pixels);
  out.differing_share =
      deterministic_sum(count, [&](std::size_t i) { return d(i) > 0.0 ? 1.0 : 0.0; }) / pixels;
  for (std::size_t i = 0; i < count; ++i) out.max = std::max(out.max, d(i));
  return out;
}

std::map<std::string, bool> channels_of(const ImageInfo& info) {
  std::map<std::string, bool> is_id;
  for (const PartSpec& part : info.parts)
    for (const ChannelSpec& channel : part.channels)
      is_id[channel.name] = channel.type == ChannelType::uint32;
  return is_id;
}

// One channel at a time, so that memory does not grow with their number.
void compare_exr(const std::string& a, const std::string& b, const ImageInfo& info_a,
                 const ImageInfo& info_b, PictureDifference& out) {
  const auto channels_a = channels_of(info_a);
  const auto channels_b = channels_of(info_b);
  for (const auto& [name, is_id] : channels_b)
    if (!channels_a.contains(name))
      out.mismatches.push_back(fmt::format("channel {} is only in {}", name, b));
  for (const auto& [name, is_id] : channels_a) {
    const auto other = channels_b.find(name);
    if (other == channels_b.end()) {
      out.mismatches.push_back(fmt::format("channel {} is only in {}", name, a));
    } else if (other->second != is_id) {
      out.mismatches.push_back(
          fmt::format("channel {} contains ids in one file and values in the other", name));
    } else if (is_id) {
      const Grid<std::uint32_t> ids_a = read_id_channel(a, name);
      const Grid<std::uint32_t> ids_b = read_id_channel(b, name);
      out.channels.push_back(summarize(
          name, ids_a.size(), [&](std::size_t i) { return ids_a[i] == ids_b[i] ? 0.0 : 1.0; }));
      out.channels.back().is_id = true;
    } else {
      const Grid<float> values_a = read_channel(a, name);
      const Grid<float> values_b = read_channel(b, name);
      out.channels.push_back(summarize(name, values_a.size(), [&](std::size_t i) {
        return distance(values_a[i], values_b[i]);
      }));
    }
  }
}

void compare_colours(const std::string& a, const std::string& b, PictureDifference& out) {
  Grid<float> alpha_a;
  Grid<float> alpha_b;
  const Grid<glm::vec3> colours_a = read_picture(a, &alpha_a);
  const Grid<glm::vec3> colours_b = read_picture(b, &alpha_b);
  static constexpr std::array<const char*, 3> names = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c)
    out.channels.push_back(
        summarize(names[static_cast<std::size_t>(c)], colours_a.size(),
                  [&](std::size_t i) { return distance(colours_a[i][c], colours_b[i][c]); }));
  const auto opaque = [](const Grid<float>& alpha) {
    return std::all_of(alpha.begin(), alpha.end(), [](float v) { return v == 1.F; });
  };
  if (!opaque(alpha_a) || !opaque(alpha_b))
    out.channels.push_back(summarize(
        "A", alpha_a.size(), [&](std::size_t i) { return distance(alpha_a[i], alpha_b[i]); }));
}

}  // namespace

PictureDifference compare_pictures(const std::string& a, const std::string& b) {
  const ImageInfo info_a = read_image_info(a);
  const ImageInfo info_b = read_image_info(b);
  PictureDifference out;
  out.width = info_a.width;
  out.height = info_a.height;
  if (info_a.width != info_b.width || info_a.height != info_b.height) {
    out.mismatches.push_back(fmt::format("{} × {} pixels against {} × {}", info_a.width,
                                         info_a.height, info_b.width, info_b.height));
    return out;
  }
  if (info_a.format == "openexr" && info_b.format == "openexr")
    compare_exr(a, b, info_a, info_b, out);
  else
    compare_colours(a, b, out);
  return out;
}

bool is_same(const PictureDifference& difference, const DifferenceLimits& limits) {
  // Written so that a nan is never within a limit.
  return difference.mismatches.empty() &&
         std::all_of(difference.channels.begin(), difference.channels.end(),
                     [&](const ChannelDifference& c) {
                       return c.mean <= limits.mean && (c.is_id || c.max <= limits.max);
                     });
}

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
