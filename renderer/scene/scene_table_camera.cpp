#include "base/instruction_set.h"
#include "renderer/image/icc/device_colour.h"
#include "renderer/image/picture_formats.h"
#include "renderer/scene/scene_table.h"
#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

std::vector<std::string> projection_choices() {
  std::vector<std::string> names;
  for (const Projection& projection : projections()) names.emplace_back(projection.name);
  return names;
}

}  // namespace

std::vector<SceneSection> make_camera_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "camera",
       .meaning = "Position of the viewer and direction of the view.",
       .keys = {
           {.name = "projection",
            .field = AT(camera.projection),
            .meaning = "Projection; see below.",
            .text = TextKind::choice,
            .choices = projection_choices()},
           {.name = "position",
            .field = AT(camera.position),
            .range = {-largest_m, largest_m},
            .unit = "m",
            .meaning = "Viewpoint, [E, N] in the scene's CRS."},
           {.name = "position_lonlat",
            .field = AT(camera.position_lonlat),
            .unit = "°",
            .meaning = "Viewpoint, [longitude, latitude]; instead of position.",
            .lonlat = true},
           {.name = "height_m",
            .field = AT(camera.height_m),
            .range = {-12000, 1e6},
            .unit = "m",
            .meaning =
                "Altitude of the viewpoint above sea level; exaggeration does not change it.",
            .derived = "so that the line of sight touches the bent level ground at the horizon; "
                       "3000 with height_above_ground and in parallel projections"},
           {.name = "height_above_ground",
            .field = AT(camera.height_above_ground),
            .meaning = "Measures the height from the ground below the viewpoint instead of from "
                       "sea level."},
           {.name = "look_at",
            .field = AT(camera.look_at),
            .range = {-largest_m, largest_m},
            .unit = "m",
            .meaning = "Point at the centre of the picture, [E, N] in the scene's CRS; instead of "
                       "azimuth and pitch."},
           {.name = "look_at_lonlat",
            .field = AT(camera.look_at_lonlat),
            .unit = "°",
            .meaning = "The same as [longitude, latitude].",
            .lonlat = true},
           {.name = "look_at_altitude_m",
            .field = AT(camera.look_at_altitude_m),
            .range = {-12000, 1e5},
            .unit = "m",
            .meaning = "Altitude of that point. Default: on the ground."},
           {.name = "azimuth_deg",
            .field = AT(camera.azimuth_deg),
            .range = {-360, 360},
            .unit = "°",
            .meaning = "Direction of view, clockwise from north: 180 looks south.",
            .derived =
                "of 24 directions, the one that shows most; parallel projections look north"},
           {.name = "pitch_deg",
            .field = AT(camera.pitch_deg),
            .range = {-90, 90},
            .unit = "°",
            .meaning = "Angle of the view direction above the horizontal: -90 is straight down.",
            .derived = "so that an eighth of the picture is sky; parallel projections -20"},
           {.name = "tilt_deg",
            .field = AT(camera.tilt_deg),
            .range = {-45, 45},
            .unit = "°",
            .meaning = "Added to the pitch, also with look_at: more than 0 turns the view up and "
                       "shows more sky.",
            .derived = "with look_at, so that an eighth of the picture is sky (0 keeps the point "
                       "at the centre); otherwise 0"},
           {.name = "field_of_view_deg",
            .field = AT(camera.field_of_view_deg),
            .range = {1, 360},
            .unit = "°",
            .meaning =
                "Horizontal field of view; the table below gives the limit of each projection."},
           {.name = "shift",
            .field = AT(camera.shift),
            .range = {-1, 1},
            .meaning =
                "Middle of the projection from the picture's centre, [right, down] in widths "
                "of the picture: of a painting that was cropped on one side."},
           {.name = "view_width_m",
            .field = AT(camera.view_width_m),
            .range = {1, 1e7},
            .unit = "m",
            .meaning = "Width of the view on the ground, for parallel projections."},
       }});
  sections.push_back(
      {.name = "sun",
       .meaning = "The sun, by direction or by date and time.",
       .keys = {
           {.name = "azimuth_deg",
            .field = AT(sun.azimuth_deg),
            .range = {-360, 360},
            .unit = "°",
            .meaning = "Direction the light comes from, clockwise from north: 315 is northwest.",
            .derived = "upper left of the picture, as painters place it: 112 less than the azimuth "
                       "of the view"},
           {.name = "altitude_deg",
            .field = AT(sun.altitude_deg),
            .range = {-90, 90},
            .unit = "°",
            .meaning = "Height above the horizon. Below 0 only the sky lights the land.",
            .derived = "31, as painters place it"},
           {.name = "time",
            .field = AT(sun.time),
            .meaning = "Date and time with zone, \"2024-06-21T17:30:00+02:00\"; instead of azimuth "
                       "and altitude.",
            .text = TextKind::time},
           {.name = "radius_deg",
            .field = AT(sun.radius_deg),
            .range = {0, 10},
            .unit = "°",
            .meaning = "Radius of the sun's disc: larger gives softer edges of cast shadows (the "
                       "real sun has 0.27)."},
       }});
  return sections;
}

std::vector<SceneSection> make_output_sections() {
  std::vector<SceneSection> sections;
  sections.push_back({.name = "output",
                      .meaning = "The sheet.",
                      .keys = {
                          {.name = "width",
                           .field = AT(output.width),
                           .range = {16, 65535},
                           .unit = "px",
                           .meaning = "Width of the picture."},
                          {.name = "height",
                           .field = AT(output.height),
                           .range = {16, 65535},
                           .unit = "px",
                           .meaning = "Height of the picture."},
                          {.name = "sheet_width_mm",
                           .field = AT(output.sheet_width_mm),
                           .range = {10, 20000},
                           .unit = "mm",
                           .meaning = "Width in print; the size of strokes and trees and the "
                                      "resolution in dpi follow from it."},
                          {.name = "formats",
                           .field = AT(output.formats),
                           .meaning = "Formats of the picture, by file extension; see below.",
                           .choices = picture_extensions()},
                          {.name = "profile",
                           .field = AT(output.profile),
                           .meaning = "ICC file that the TIFF is converted to: RGB of a printer, "
                                      "or CMYK of a press. Default: `colours`.",
                           .text = TextKind::file},
                          {.name = "colours",
                           .field = AT(output.colours),
                           .meaning = "Colour space of the TIFF if there is no `profile`.",
                           .text = TextKind::choice,
                           .choices = colour_space_names()},
                          {.name = "intent",
                           .field = AT(output.intent),
                           .meaning = "Rendering intent for colours outside the profile or space.",
                           .text = TextKind::choice,
                           .choices = rendering_intent_names()},
                          {.name = "black_point",
                           .field = AT(output.black_point),
                           .meaning = "Maps the picture's black to the darkest colour of profile "
                                      "or space (black point compensation)."},
                          {.name = "ink_limit",
                           .field = AT(output.ink_limit),
                           .range = {0, 400},
                           .unit = "%",
                           .meaning = "Total ink above which pixels are counted and reported; 0: "
                                      "the maximum of the press profile's own tables."},
                          {.name = "ocio_config",
                           .field = AT(output.ocio_config),
                           .meaning = "OpenColorIO config to use instead of the program's own.",
                           .text = TextKind::file},
                      }});
  return sections;
}

namespace {

std::vector<std::string> instruction_set_choices() {
  std::vector<std::string> names = {"any"};
  names.insert(names.end(), instruction_sets().begin(), instruction_sets().end());
  return names;
}

}  // namespace

std::vector<SceneSection> make_sampling_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "sampling",
       .meaning = "Samples per pixel: quality against time.",
       .keys = {
           {.name = "pixel_samples",
            .field = AT(sampling.pixel_samples),
            .range = {1, 16},
            .meaning = "Camera rays per pixel: 1, 4, 9 or 16."},
           {.name = "shadow_rays",
            .field = AT(sampling.shadow_rays),
            .range = {1, 64},
            .meaning = "Rays to the sun's disc per pixel, for cast shadows."},
           {.name = "sky_directions",
            .field = AT(sampling.sky_directions),
            .range = {0, 256},
            .meaning =
                "Directions in which the open sky is searched, for shade in valleys; 0: off."},
           {.name = "sky_reach_m",
            .field = AT(sampling.sky_reach_m),
            .range = {1, 1e6},
            .unit = "m",
            .meaning = "Distance up to which terrain hides the sky."},
           {.name = "instruction_set",
            .field = AT(tracing.instruction_set),
            .meaning = "Vector instructions for ray tracing: auto takes the best that the machine "
                       "has; a named set makes several machines give the same picture to the last "
                       "bit. A machine that lacks it refuses.",
            .text = TextKind::choice,
            .choices = instruction_set_choices()},
       }});
  return sections;
}

}  // namespace belvedere
