#include "renderer/image/exr/compositing_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <glm/vec4.hpp>
#include <utility>

#include "base/text/json.h"

namespace belvedere {
namespace {

// Up to four characters, the first in the lowest byte.
std::uint32_t mixed_block(std::string_view block) {
  std::uint32_t k = 0;
  for (std::size_t i = 0; i < block.size(); ++i)
    k |= static_cast<std::uint32_t>(static_cast<unsigned char>(block[i])) << (8 * i);
  return std::rotl(k * 0xcc9e2d51U, 15) * 0x1b873593U;
}

}  // namespace

std::uint32_t murmur_hash3(std::string_view text) {
  std::uint32_t h = 0;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    h ^= mixed_block(text.substr(i, 4));
    if (i + 4 <= text.size()) h = std::rotl(h, 13) * 5U + 0xe6546b64U;
  }
  h ^= static_cast<std::uint32_t>(text.size());
  h = (h ^ (h >> 16)) * 0x85ebca6bU;
  h = (h ^ (h >> 13)) * 0xc2b2ae35U;
  return h ^ (h >> 16);
}

float cryptomatte_id(std::string_view name) {
  std::uint32_t bits = murmur_hash3(name);
  const std::uint32_t exponent = bits >> 23 & 255U;
  if (exponent == 0U || exponent == 255U) bits ^= 1U << 23;
  return std::bit_cast<float>(bits);
}

FileNotes cryptomatte_notes(const std::string& layer, const std::vector<std::string>& names) {
  std::string manifest;
  for (const std::string& name : names)
    manifest += fmt::format("{}{}:\"{:08x}\"", manifest.empty() ? "" : ",", json_quoted(name),
                            std::bit_cast<std::uint32_t>(cryptomatte_id(name)));
  const std::string key =
      "cryptomatte/" + fmt::format("{:08x}", murmur_hash3(layer)).substr(0, 7) + "/";
  return {{key + "name", layer},
          {key + "hash", "MurmurHash3_32"},
          {key + "conversion", "uint32_to_float32"},
          {key + "manifest", "{" + manifest + "}"}};
}

namespace {

using Ids = std::vector<float>;
using Rows = CompositingRows;

constexpr const char* land_cover_layer = "ViewLayer.CryptoLandCover";
constexpr const char* feature_layer = "ViewLayer.CryptoFeature";
constexpr float sky_depth_m = 1e10F;  // as Blender writes it

// By the number of the class.
const Ids& class_ids() {
  static const Ids ids = [] {
    Ids list;
    for (const LandCoverClassInfo& info : land_cover_classes())
      list.push_back(cryptomatte_id(info.name));
    return list;
  }();
  return ids;
}

// Of a pixel that shows terrain `coverage` says how much of it is sky. Of one that shows the sky
// the class of the rest is not known.
glm::vec4 land_cover_ranks(const Rows& rows, const Ids&, std::size_t i) {
  const float share = std::clamp(rows.guidance.coverage[i], 0.F, 1.F);
  const LandCoverClass of = rows.guidance.land_cover[i];
  const glm::vec2 sky = share < 1.F ? glm::vec2(class_ids()[0], 1.F - share) : glm::vec2(0.F);
  if (of == LandCoverClass::sky) return {sky, 0.F, 0.F};
  const glm::vec2 ground(class_ids()[static_cast<std::size_t>(of)], share);
  return sky.y > share ? glm::vec4(sky, ground) : glm::vec4(ground, sky);
}

glm::vec4 feature_ranks(const Rows& rows, const Ids& ids, std::size_t i) {
  const MattePixel& pixel = rows.of_feature[i];
  const auto rank = [&](std::size_t k) {
    return pixel.share[k] == 0 ? glm::vec2(0.F)
                               : glm::vec2(ids.at(pixel.id[k] - 1U), pixel.share[k] / 255.F);
  };
  const std::size_t first = pixel.share[0] >= pixel.share[1] ? 0 : 1;
  return {rank(first), rank(1 - first)};
}

glm::vec4 on_ground(const Rows& rows, const Grid<glm::vec3>& grid, std::size_t i) {
  return rows.guidance.is_sky(i) ? glm::vec4(0.F) : glm::vec4(grid[i], 0.F);
}

// Channels of one name that differ in their last letter.
struct Pass {
  const char* name;
  std::string_view letters;
  ChannelType type;
  glm::vec4 (*value)(const Rows&, const Ids&, std::size_t i);
};

constexpr Pass passes[] = {
    {"ViewLayer.Combined", "RGBA", ChannelType::half,
     [](const Rows& rows, const Ids&, std::size_t i) { return glm::vec4(rows.picture[i], 1.F); }},
    {"ViewLayer.Depth", "Z", ChannelType::float32,
     [](const Rows& rows, const Ids&, std::size_t i) {
       return glm::vec4(std::min(rows.guidance.depth_m[i], sky_depth_m));
     }},
    {"ViewLayer.Position", "XYZ", ChannelType::float32,
     [](const Rows& rows, const Ids&, std::size_t i) {
       return on_ground(rows, rows.guidance.position_m, i);
     }},
    {"ViewLayer.Normal", "XYZ", ChannelType::half,
     [](const Rows& rows, const Ids&, std::size_t i) {
       return on_ground(rows, rows.guidance.normal, i);
     }},
    {"ViewLayer.Shadow", "RGB", ChannelType::half,
     [](const Rows& rows, const Ids&, std::size_t i) {
       return glm::vec4(rows.guidance.shadow[i]);
     }},
    {"ViewLayer.AO", "RGB", ChannelType::half,
     [](const Rows& rows, const Ids&, std::size_t i) {
       return glm::vec4(rows.guidance.sky_view[i]);
     }},
    {"ViewLayer.IndexMA", "X", ChannelType::half,
     [](const Rows& rows, const Ids&, std::size_t i) {
       return glm::vec4(static_cast<float>(rows.guidance.land_cover[i]));
     }},
    {"ViewLayer.CryptoLandCover00", "rgba", ChannelType::float32, land_cover_ranks},
    {"ViewLayer.CryptoFeature00", "rgba", ChannelType::float32, feature_ranks}};

// Each letter of each pass is a channel.
struct PassChannel {
  const Pass* pass;
  int component;
};
const std::vector<PassChannel>& pass_channels() {
  static const std::vector<PassChannel> channels = [] {
    std::vector<PassChannel> list;
    for (const Pass& pass : passes)
      for (int k = 0; k < static_cast<int>(pass.letters.size()); ++k) list.push_back({&pass, k});
    return list;
  }();
  return channels;
}

PartSpec compositing_part() {
  PartSpec part{"passes", {}};
  for (const auto& [pass, k] : pass_channels())
    part.channels.push_back(
        {fmt::format("{}.{}", pass->name, pass->letters.substr(static_cast<std::size_t>(k), 1)),
         pass->type});
  return part;
}

FileNotes with_mattes(FileNotes notes, const std::vector<std::string>& features) {
  std::vector<std::string> classes;
  for (const LandCoverClassInfo& info : land_cover_classes()) classes.emplace_back(info.name);
  notes.merge(cryptomatte_notes(land_cover_layer, classes));
  notes.merge(cryptomatte_notes(feature_layer, features));
  return notes;
}

}  // namespace

const std::vector<std::string>& compositing_channels() {
  static const std::vector<std::string> names = {
      "Z", "coverage.A", "P.X", "N.X", "landcover.id", "shadow.V", "skyview.V", "base.R"};
  return names;
}

CompositingWriter::CompositingWriter(const std::string& path, int width, int height,
                                     const std::vector<std::string>& features, FileNotes notes)
    : writer_(path, width, height, {compositing_part()}, with_mattes(std::move(notes), features)) {
  for (const std::string& name : features) feature_ids_.push_back(cryptomatte_id(name));
}

void CompositingWriter::write_rows(const CompositingRows& rows, int y0) {
  writer_.write_rows(
      0, y0, rows.picture.height(), [&](std::size_t channel, int x, int y, int count, float* out) {
        const auto& [pass, component] = pass_channels()[channel];
        const std::size_t from = rows.picture.index(x, y - y0);
        for (int i = 0; i < count; ++i)
          out[i] = pass->value(rows, feature_ids_, from + static_cast<std::size_t>(i))[component];
      });
}

}  // namespace belvedere
