#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "base/error.h"
#include "base/guidance_buffers.h"

namespace belvedere {

// The table of all guidance channels. Reading and writing files, the sheet of example panels,
// docs/guidance.md and the tests use it, so a new channel is a row here, its member in
// GuidanceBuffers and the stage that fills it.

// The grid in the buffers; std::visit gives it with its value type.
using GuidanceMember =
    std::variant<Grid<float> GuidanceBuffers::*, Grid<glm::vec2> GuidanceBuffers::*,
                 Grid<glm::vec3> GuidanceBuffers::*, Grid<LandCoverClass> GuidanceBuffers::*,
                 Grid<std::uint32_t> GuidanceBuffers::*>;

enum class ChannelKind {
  number,       // a number, or independent components
  direction,    // unit vector, or zero; normalized again after reading, since half is not exact
  class_id,     // a LandCoverClass
  stroke_id,    // counts from 1
  pixel_index,  // row-major index of a pixel of the same picture; changes when the picture is
                // cropped
};

// Type of the values in a file: half if 11 bits are enough, uint32 for ids, which are never
// filtered.
enum class ChannelStorage { half, float32, uint32 };

// Which stage fills a channel, and so which pictures may lack it. Scanned paintings have the
// channels that were drawn or derived for them, of whatever kind.
enum class ChannelMaker {
  trace,    // trace_guidance: every picture of a terrain has it
  relief,   // renderer/rock: every picture with light
  light,    // tone and base picture: every picture with light
  strokes,  // only example paintings whose strokes the program made
};

struct GuidanceChannel {
  GuidanceMember member;
  std::array<std::string_view, 3> names =
      {};                      // in the file, one for each component; "" for unused ones
  std::string_view part = {};  // part of the file; channels used together share one
  ChannelStorage type = ChannelStorage::half;
  ChannelKind kind = ChannelKind::number;
  ChannelMaker maker = ChannelMaker::trace;
  std::string_view unit = {};  // "" if it has none
  std::string_view meaning = {};
  glm::vec3 sky{0.F};  // components of sky pixels; ids as numbers
  std::optional<glm::vec3> paper =
      {};  // components of bare paper between the panels of a sheet, if different from sky

  std::size_t components() const;
};

// In the order of the file; the channels of a part are adjacent.
std::span<const GuidanceChannel> guidance_channels();
const GuidanceChannel& channel_of(GuidanceMember member);

// The table in Markdown, with a header and one row per grid.
std::string describe_guidance_channels();

// Whether the buffers have that channel, in their size.
bool has_channel(const GuidanceBuffers& guidance, GuidanceMember member);
// Checks the channels that a stage needs, once when it starts. Throws Error(kind) if a channel is
// absent or differs in size from the depths, with the stage, the channel and what fills it.
void require_channels(const GuidanceBuffers& guidance, std::initializer_list<GuidanceMember> needed,
                      const std::string& where, ErrorKind kind = ErrorKind::bug);

// A value from its components.
template <class T>
T value_of(glm::vec3 components) {
  if constexpr (std::is_same_v<T, glm::vec3>) {
    return components;
  } else if constexpr (std::is_same_v<T, glm::vec2>) {
    return {components.x, components.y};
  } else {
    return static_cast<T>(components.x);
  }
}

// Makes the grid of a channel with one value everywhere.
void fill_channel(GuidanceBuffers& guidance, const GuidanceChannel& channel, int width, int height,
                  glm::vec3 components);

}  // namespace belvedere
