#include "base/guidance_buffers.h"

#include <fmt/core.h>

#include <algorithm>

namespace belvedere {
namespace {

using B = GuidanceBuffers;
using enum ChannelStorage;
using enum ChannelKind;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr glm::vec3 up{0.F, 0.F, 1.F};
constexpr glm::vec3 one{1.F, 0.F, 0.F};

// Names and parts are the file format and must not change. New channels go to the end of a part or
// into a new part.
const GuidanceChannel channels[] = {
    {.member = &B::depth_m,
     .names = {"Z"},
     .part = "depth",
     .type = float32,
     .unit = "m",
     .meaning = "distance from the eye along the ray; infinite is sky",
     .sky = {infinity, 0.F, 0.F}},
    {.member = &B::coverage,
     .names = {"coverage.A"},
     .part = "depth",
     .meaning = "share of the pixel that is terrain, 0…1"},
    {.member = &B::front,
     .names = {"front.A"},
     .part = "depth",
     .meaning = "share of the pixel that shows the surface described by its values, 0…1; less than "
                "1 at depth edges",
     .sky = one},
    {.member = &B::silhouette,
     .names = {"silhouette.V"},
     .part = "depth",
     .meaning = "depth discontinuities, 0…1, on the nearer side"},
    {.member = &B::footprint_m,
     .names = {"footprint.V"},
     .part = "depth",
     .type = float32,
     .unit = "m",
     .meaning = "distance on the ground that one pixel covers"},
    {.member = &B::position_m,
     .names = {"P.X", "P.Y", "P.Z"},
     .part = "position",
     .type = float32,
     .unit = "m",
     .meaning = "position on the ground before bending and exaggeration: east, north, up, relative "
                "to the origin in the header"},
    {.member = &B::altitude_m,
     .names = {"altitude.V"},
     .part = "position",
     .type = float32,
     .unit = "m",
     .meaning = "altitude above the vertical datum"},
    {.member = &B::normal,
     .names = {"N.X", "N.Y", "N.Z"},
     .part = "normal",
     .kind = direction,
     .meaning = "unit normal of the drawn ground: generalized and exaggerated, not bent",
     .sky = up},
    {.member = &B::normal_detail,
     .names = {"Nd.X", "Nd.Y", "Nd.Z"},
     .part = "normal",
     .kind = direction,
     .meaning = "unit normal with all detail: exaggerated, not generalized",
     .sky = up},
    {.member = &B::normal_smooth,
     .names = {"Ns.X", "Ns.Y", "Ns.Z"},
     .part = "normal",
     .kind = direction,
     .meaning = "unit normal of the large forms: generalized, smoothed over 120 m",
     .sky = up},
    {.member = &B::land_cover,
     .names = {"landcover.id"},
     .part = "class",
     .type = uint32,
     .kind = class_id,
     .unit = "id",
     .meaning = "land-cover class; the legend is in the header"},
    {.member = &B::slope_deg,
     .names = {"slope.V"},
     .part = "terrain",
     .unit = "°",
     .meaning = "slope of the ground without exaggeration"},
    {.member = &B::aspect_deg,
     .names = {"aspect.V"},
     .part = "terrain",
     .unit = "°",
     .meaning = "direction in which that slope faces, clockwise from north"},
    {.member = &B::fall_line,
     .names = {"fallline.X", "fallline.Y"},
     .part = "terrain",
     .kind = direction,
     .meaning =
         "unit direction of steepest descent in the image, to the right and down; 0 where flat"},
    {.member = &B::ridge,
     .names = {"ridge.V"},
     .part = "terrain",
     .meaning = "ridges above 0, valleys below, -1…1"},
    {.member = &B::relief_s_m,
     .names = {"relief.S"},
     .part = "terrain",
     .unit = "m",
     .meaning = "height above the mean of the surrounding ground: small forms (180 m)"},
    {.member = &B::relief_m_m,
     .names = {"relief.M"},
     .part = "terrain",
     .unit = "m",
     .meaning = "… medium forms (750 m)"},
    {.member = &B::relief_l_m,
     .names = {"relief.L"},
     .part = "terrain",
     .unit = "m",
     .meaning = "… large forms (1.8 km)"},
    {.member = &B::valley_height_m,
     .names = {"valley.V"},
     .part = "terrain",
     .unit = "m",
     .meaning = "height above the lowest ground within 900 m"},
    {.member = &B::rim_m,
     .names = {"rim.V"},
     .part = "terrain",
     .type = float32,
     .unit = "m",
     .meaning =
         "distance on the ground to the edge of the data; more by mountains far above the region"},
    {.member = &B::built,
     .names = {"built.V"},
     .part = "terrain",
     .meaning = "building density: 0 open land, 0.3 a village, 1 the centre of a large town"},
    {.member = &B::grain,
     .names = {"grain.X", "grain.Y"},
     .part = "terrain",
     .meaning = "direction of fields and streets on the ground: cosine and sine of twice the angle "
                "from east, times the confidence 0…1"},
    {.member = &B::flow,
     .names = {"flow.V"},
     .part = "terrain",
     .unit = "log₁₀ m²",
     .meaning = "base-10 logarithm of the upstream area in m²"},
    {.member = &B::shadow,
     .names = {"shadow.V"},
     .part = "light",
     .meaning = "1 in the sun … 0 in cast shadow",
     .sky = one},
    {.member = &B::sky_view,
     .names = {"skyview.V"},
     .part = "light",
     .meaning = "share of the sky that is visible, 0…1",
     .sky = one,
     .paper = glm::vec3(0.F)},  // tells paper from painted sky
    {.member = &B::tone,
     .names = {"tone.V"},
     .part = "light",
     .maker = ChannelMaker::light,
     .meaning = "the scalar light, 0…1"},
    {.member = &B::base,
     .names = {"base.R", "base.G", "base.B"},
     .part = "base",
     .maker = ChannelMaker::light,
     .meaning = "the picture without strokes, scene-linear"},
    {.member = &B::rock_height,
     .names = {"rock.V"},
     .part = "rock",
     .maker = ChannelMaker::relief,
     .unit = "0.5 mm",
     .meaning = "height of the drawn rock spurs above their wall"},
    {.member = &B::rock_facet,
     .names = {"rock.id"},
     .part = "rock",
     .type = uint32,
     .maker = ChannelMaker::relief,
     .unit = "id",
     .meaning =
         "plane of rock, where planes of one large spur have the upper 16 bits in common, or of "
         "near ground; 0: none"},
    {.member = &B::rock_tone,
     .names = {"rock.tone"},
     .part = "rock",
     .maker = ChannelMaker::relief,
     .meaning = "light on the rock spurs; on other near ground what its forms add to the tone"},
    {.member = &B::rock_cover,
     .names = {"rock.turf", "rock.snow"},
     .part = "rock",
     .maker = ChannelMaker::relief,
     .meaning = "shares of turf and of snow on the treads of rock, 0…1"},
    {.member = &B::painted_class,
     .names = {"painted.id"},
     .part = "paint",
     .type = uint32,
     .kind = class_id,
     .maker = ChannelMaker::strokes,
     .unit = "id",
     .meaning = "class with the thickest paint"},
    {.member = &B::painted_from,
     .names = {"painted.from"},
     .part = "paint",
     .type = uint32,
     .kind = pixel_index,
     .maker = ChannelMaker::strokes,
     .unit = "pixel",
     .meaning = "pixel at which that stroke starts, as a row-major index"},
    {.member = &B::stroke,
     .names = {"stroke.id"},
     .part = "paint",
     .type = uint32,
     .kind = stroke_id,
     .maker = ChannelMaker::strokes,
     .unit = "id",
     .meaning = "number of the stroke on top, from 1; 0 is bare canvas"},
    {.member = &B::ground_from,
     .names = {"ground.from"},
     .part = "paint",
     .type = uint32,
     .kind = pixel_index,
     .maker = ChannelMaker::strokes,
     .unit = "pixel",
     .meaning = "as `painted.from`, in the layer without trees and houses"},
};

const char* made_by(ChannelMaker maker) {
  switch (maker) {
    case ChannelMaker::trace:
      return "filled by trace_guidance";
    case ChannelMaker::relief:
      return "filled by make_rock_relief";
    case ChannelMaker::light:
      return "filled by make_tone and make_paint_ground";
    case ChannelMaker::strokes:
      return "present in example paintings of the program";
  }
  return "";
}

}  // namespace

std::size_t GuidanceChannel::components() const {
  return static_cast<std::size_t>(std::count_if(
      names.begin(), names.end(), [](std::string_view name) { return !name.empty(); }));
}

std::span<const GuidanceChannel> guidance_channels() { return channels; }

const GuidanceChannel& channel_of(GuidanceMember member) {
  for (const GuidanceChannel& channel : channels)
    if (channel.member == member) return channel;
  throw Error(ErrorKind::bug, "guidance channels", "a grid that is not in the table");
}

bool has_channel(const GuidanceBuffers& guidance, GuidanceMember member) {
  return std::visit(
      [&](auto grid) {
        return !(guidance.*grid).empty() && (guidance.*grid).same_size(guidance.depth_m);
      },
      member);
}

void require_channels(const GuidanceBuffers& guidance, std::initializer_list<GuidanceMember> needed,
                      const std::string& where, ErrorKind kind) {
  for (const GuidanceMember& member : needed) {
    if (has_channel(guidance, member)) continue;
    const GuidanceChannel& channel = channel_of(member);
    const auto [width, height] = std::visit(
        [&](auto grid) { return std::pair((guidance.*grid).width(), (guidance.*grid).height()); },
        member);
    const std::string found =
        width * height == 0
            ? "guidance has no channel"
            : fmt::format("guidance has {} × {} pixels in the channel", width, height);
    throw Error(kind, where, fmt::format("{} {}", found, channel.names[0]),
                fmt::format("{} × {} pixels, the size of the depth channel; {}", guidance.width(),
                            guidance.height(), made_by(channel.maker)));
  }
}

void fill_channel(GuidanceBuffers& guidance, const GuidanceChannel& channel, int width, int height,
                  glm::vec3 components) {
  std::visit(
      [&](auto member) {
        using Values = std::decay_t<decltype(guidance.*member)>;
        guidance.*member = Values(width, height, value_of<typename Values::value_type>(components));
      },
      channel.member);
}

}  // namespace belvedere
