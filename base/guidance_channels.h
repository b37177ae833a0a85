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

// The one table of what guidance buffers hold. Files and their reading, the sheet of example panels, the README and the tests take the
// channels from it, so that a new one is a row here, its member in GuidanceBuffers and the stage that fills it.

// Which grid of the buffers; std::visit gives it with the type of its values.
using GuidanceMember = std::variant<Grid<float> GuidanceBuffers::*, Grid<glm::vec2> GuidanceBuffers::*, Grid<glm::vec3> GuidanceBuffers::*,
                                    Grid<LandCoverClass> GuidanceBuffers::*, Grid<std::uint32_t> GuidanceBuffers::*>;

enum class ChannelKind {
  number,       // a number, or components that are numbers of their own
  direction,    // unit vector, or zero where there is none; made unit again after reading, as half is not exact
  class_id,     // a LandCoverClass
  stroke_id,    // counts from 1
  pixel_index,  // row-major index of a pixel of the same picture: moves with the picture
};

// How values lie in a file: half where 11 bits are enough, uint32 for ids, which are never filtered.
enum class ChannelStorage { half, float32, uint32 };

// Who fills a channel, and so who may lack it. Scanned paintings have what was drawn or found for them, of whatever kind.
enum class ChannelMaker {
  trace,    // trace_guidance: every picture of a terrain has it
  relief,   // renderer/rock: every picture with light
  light,    // tone and base picture: every picture with light
  strokes,  // example paintings whose strokes the program laid itself; no other picture
};

struct GuidanceChannel {
  GuidanceMember member;
  std::array<std::string_view, 3> names = {};  // in the file, one for each component; "" where there are fewer
  std::string_view part = {};                  // of the file: what is used together stands together
  ChannelStorage type = ChannelStorage::half;
  ChannelKind kind = ChannelKind::number;
  ChannelMaker maker = ChannelMaker::trace;
  std::string_view unit = {};  // "" where it has none
  std::string_view meaning = {};
  glm::vec3 sky{0.F};                   // component by component, where the picture shows sky; ids as numbers
  std::optional<glm::vec3> paper = {};  // the same of bare paper between the panels of a sheet, where it differs from sky

  std::size_t components() const;
};

// In the order of the file; the channels of a part follow each other.
std::span<const GuidanceChannel> guidance_channels();
const GuidanceChannel& channel_of(GuidanceMember member);

// The table as Markdown for people: a head and one row for each grid.
std::string describe_guidance_channels();

// Whether the buffers have that channel, in their size.
bool has_channel(const GuidanceBuffers& guidance, GuidanceMember member);
// What a stage needs, checked once at its entrance. Throws Error(kind) where a channel is absent or has another size than the depths,
// naming the stage, the channel and what fills it.
void require_channels(const GuidanceBuffers& guidance, std::initializer_list<GuidanceMember> needed, const std::string& where,
                      ErrorKind kind = ErrorKind::bug);

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

// Makes the grid of a channel with one value all over.
void fill_channel(GuidanceBuffers& guidance, const GuidanceChannel& channel, int width, int height, glm::vec3 components);

}  // namespace belvedere
