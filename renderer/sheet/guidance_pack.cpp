#include "renderer/sheet/guidance_pack.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <glm/vec2.hpp>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.h"
#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "renderer/image/exr/half_floats.h"

namespace belvedere {
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
              "\"" + name + "\" is not a channel of a picture's guidance", names + "; or none");
}

}  // namespace

GuidanceChoice read_guidance_choice(const std::string& text) {
  if (text == "none") return std::vector<std::string>();
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

void keep_chosen(GuidanceBuffers& guidance, const GuidanceChoice& choice) {
  if (!choice) return;
  for (const GuidanceChannel& channel : guidance_channels()) {
    const auto names_it = [&](const std::string& name) { return is_of(channel, name); };
    if (std::none_of(choice->begin(), choice->end(), names_it))
      std::visit([&](auto member) { (guidance.*member) = {}; }, channel.member);
  }
}

}  // namespace belvedere
