#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_deform_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "deform",
       .meaning = "How the ground is raised, bent and moved before rendering; see deformation.md.",
       .keys = {
           {.name = "exaggeration",
            .field = AT(deform.exaggeration),
            .range = {0.1, 10},
            .meaning = "Vertical exaggeration of all altitudes, or of the foreground if "
                       "background_exaggeration is given; 1 is none.",
            .derived = "so that the region's landforms are as tall in the picture as in painted "
                       "panoramas, 1.2 to 2; parallel projections 1"},
           {.name = "background_exaggeration",
            .field = AT(deform.ground.background_exaggeration),
            .range = {0.1, 10},
            .meaning = "Exaggeration far away. Default: the same everywhere."},
           {.name = "foreground_to_m",
            .field = AT(deform.ground.foreground_to_m),
            .range = {0, largest_m},
            .unit = "m",
            .meaning = "Up to this distance only the foreground's exaggeration applies."},
           {.name = "background_from_m",
            .field = AT(deform.ground.background_from_m),
            .range = {0, largest_m},
            .unit = "m",
            .meaning = "From this distance only the background's exaggeration applies; between the "
                       "two they blend."},
           {.name = "exaggeration_base_m",
            .field = AT(deform.exaggeration_base_m),
            .range = {-12000, 9000},
            .unit = "m",
            .meaning = "Altitude that exaggeration does not change: that of the valleys, if "
                       "exaggeration changes with distance.",
            .derived = "0 if the exaggeration is given, else the altitude that a tenth of the "
                       "ground in view lies below"},
           {.name = "earth_curvature",
            .field = AT(deform.ground.earth_curvature),
            .meaning = "Lowers far ground by the curvature of the Earth."},
           {.name = "refraction",
            .field = AT(deform.ground.refraction),
            .range = {0, 0.5},
            .meaning = "Refraction: coefficient k, used with earth_curvature."},
           {.name = "allow_folds",
            .field = AT(deform.allow_folds),
            .meaning =
                "Allows handles to fold the ground in the picture; otherwise a fold is an error."},
       }});
  sections.push_back(
      {.name = "deform.exaggeration_points",
       .kind = SectionKind::list,
       .meaning = "One block for each control point of exaggeration by distance, from near to far, "
                  "instead of a background. A smooth curve passes through them.",
       .keys =
           {
               {.name = "distance_m",
                .field = AT(deform.ground.exaggeration_points[i].distance_m),
                .range = {0, largest_m},
                .unit = "m",
                .meaning = "Distance from the viewer; increases from block to block.",
                .required = true},
               {.name = "factor",
                .field = AT(deform.ground.exaggeration_points[i].factor),
                .range = {0.05, 20},
                .meaning = "Factor there; multiplies the general exaggeration.",
                .required = true},
           },
       .count = [](const Scene& s) { return s.deform.ground.exaggeration_points.size(); },
       .resize = [](Scene& s, std::size_t n) { s.deform.ground.exaggeration_points.resize(n); }});
  sections.push_back(
      {.name = "deform.bend",
       .meaning = "Progressive bend: the near ground tilts towards the viewer like a map, the far "
                  "ground sinks to a horizon. Given as a parabola or by control points.",
       .keys = {
           {.name = "radius_m",
            .field = AT(deform.bend_radius_m),
            .range = {0, 1e9},
            .unit = "m",
            .meaning = "Radius of the bend, 1000 or more; a smaller radius bends more; 0: no bend.",
            .derived = "if no other key of the bend is given, so that the largest view that the "
                       "data cover ends at its horizon; parallel projections are not bent"},
           {.name = "crest_m",
            .field = AT(deform.bend_crest_m),
            .range = {0, largest_m},
            .unit = "m",
            .meaning = "Distance from the viewer at which the bent ground is level.",
            .derived = "0 if radius_m is given, else 0.8 times the distance of the horizon"},
           {.name = "far_from_m",
            .field = AT(deform.ground.bend.far_from_m),
            .range = {0, largest_m},
            .unit = "m",
            .meaning = "Distance beyond which the ground sinks faster."},
           {.name = "far_amount_per_m",
            .field = AT(deform.ground.bend.far_amount_per_m),
            .range = {0, 1},
            .unit = "1/m",
            .meaning = "How much faster: metres per square metre of distance beyond far_from_m."},
       }});
  sections.push_back(
      {.name = "deform.bend.points",
       .kind = SectionKind::list,
       .meaning = "One block for each control point of a bend, from near to far, two or more, "
                  "instead of the parabola. A smooth curve passes through them without "
                  "overshooting. All give drop_m, or all give inclination_deg.",
       .keys =
           {
               {.name = "distance_m",
                .field = AT(deform.ground.bend.points[i].distance_m),
                .range = {0, largest_m},
                .unit = "m",
                .meaning = "Distance from the viewer; increases from block to block.",
                .required = true},
               {.name = "drop_m",
                .field = AT(deform.ground.bend.points[i].drop_m),
                .range = {-1e6, 1e6},
                .unit = "m",
                .meaning = "How far the ground is lowered there."},
               {.name = "inclination_deg",
                .field = AT(deform.ground.bend.points[i].inclination_deg),
                .range = {-80, 80},
                .unit = "°",
                .meaning = "Tilt of level ground there: more than 0 towards the viewer, 0 level as "
                           "at the horizon, less than 0 away."},
           },
       .count = [](const Scene& s) { return s.deform.ground.bend.points.size(); },
       .resize = [](Scene& s, std::size_t n) { s.deform.ground.bend.points.resize(n); }});
  sections.push_back(
      {.name = "deform.summits",
       .kind = SectionKind::list,
       .meaning = "One block for each summit that is exaggerated more, or less, than its "
                  "surroundings. It rises smoothly from the ground around.",
       .keys =
           {
               {.name = "name",
                .field = AT(deform.summits[i].name),
                .meaning = "Name for messages."},
               {.name = "position",
                .field = AT(deform.summits[i].position),
                .range = {-largest_m, largest_m},
                .unit = "m",
                .meaning = "The summit, [E, N] in the scene's CRS."},
               {.name = "position_lonlat",
                .field = AT(deform.summits[i].position_lonlat),
                .unit = "°",
                .meaning = "The summit, [longitude, latitude]; instead of position.",
                .lonlat = true},
               {.name = "radius_m",
                .field = AT(deform.summits[i].summit.radius_m),
                .range = {10, 1e6},
                .unit = "m",
                .meaning = "Radius at which its effect has faded to zero."},
               {.name = "factor",
                .field = AT(deform.summits[i].summit.factor),
                .range = {0.3, 5},
                .meaning = "Factor at the summit; multiplies the general exaggeration."},
               {.name = "base_m",
                .field = AT(deform.summits[i].summit.base_m),
                .range = {-12000, 9000},
                .unit = "m",
                .meaning = "Ground up to this altitude is unchanged; from 200 m above it the full "
                           "factor applies."},
           },
       .count = [](const Scene& s) { return s.deform.summits.size(); },
       .resize = [](Scene& s, std::size_t n) { s.deform.summits.resize(n); }});
  sections.push_back(
      {.name = "deform.handles",
       .kind = SectionKind::list,
       .meaning =
           "One block for each piece of ground that is moved, turned, scaled or raised, with its "
           "land cover and everything on it. Moving least squares interpolate between the pieces.",
       .keys =
           {
               {.name = "name",
                .field = AT(deform.handles[i].name),
                .meaning = "Name for messages."},
               {.name = "position",
                .field = AT(deform.handles[i].position),
                .range = {-largest_m, largest_m},
                .unit = "m",
                .meaning = "Its centre in the undeformed terrain, [E, N] in the scene's CRS."},
               {.name = "position_lonlat",
                .field = AT(deform.handles[i].position_lonlat),
                .unit = "°",
                .meaning = "Its centre, [longitude, latitude]; instead of position.",
                .lonlat = true},
               {.name = "radius_m",
                .field = AT(deform.handles[i].handle.radius_m),
                .range = {0, 1e6},
                .unit = "m",
                .meaning =
                    "Radius beyond which the ground is unchanged; 0: the whole terrain follows."},
               {.name = "core_m",
                .field = AT(deform.handles[i].core_m),
                .range = {0, 1e6},
                .unit = "m",
                .meaning =
                    "Radius within which the ground moves rigidly. Default: half of radius_m."},
               {.name = "move_m",
                .field = AT(deform.handles[i].move_m),
                .range = {-1e6, 1e6},
                .unit = "m",
                .meaning = "Shift, [east, north]."},
               {.name = "rotate_deg",
                .field = AT(deform.handles[i].handle.rotate_deg),
                .range = {-170, 170},
                .unit = "°",
                .meaning =
                    "Rotation about the vertical through the centre, clockwise seen from above."},
               {.name = "scale",
                .field = AT(deform.handles[i].handle.scale),
                .range = {0.2, 5},
                .meaning = "Scale in plan; heights are unchanged."},
               {.name = "raise_m",
                .field = AT(deform.handles[i].handle.raise_m),
                .range = {-5000, 5000},
                .unit = "m",
                .meaning = "Added to the altitudes, before exaggeration."},
               {.name = "pin",
                .field = AT(deform.handles[i].handle.pin),
                .meaning = "Fixes or moves only the centre; the ground around it turns with the "
                           "other handles."},
           },
       .count = [](const Scene& s) { return s.deform.handles.size(); },
       .resize = [](Scene& s, std::size_t n) { s.deform.handles.resize(n); }});
  sections.push_back(
      {.name = "deform.field",
       .meaning =
           "A displacement of the ground that is known at some places and smooth in between, "
           "as belvedere exemplar register finds it in a painting; see registration.md.",
       .keys = {
           {.name = "length_m",
            .field = AT(deform.ground.field.length_m),
            .range = {1, 1e7},
            .unit = "m",
            .meaning = "Distance over which displacements are alike."},
           {.name = "reach_m",
            .field = AT(deform.ground.field.reach_m),
            .range = {1, 1e7},
            .unit = "m",
            .meaning = "Distance within which a place tells whether the ground was moved."},
           {.name = "still_m",
            .field = AT(deform.ground.field.still_m),
            .range = {0.01, 1e6},
            .unit = "m",
            .meaning = "Displacement to expect where no place was moved."},
           {.name = "max_m",
            .field = AT(deform.ground.field.max_m),
            .range = {0.01, 1e6},
            .unit = "m",
            .meaning = "The largest displacement to expect."},
       }});
  sections.push_back(
      {.name = "deform.field.places",
       .kind = SectionKind::list,
       .meaning = "One block for each place whose displacement is known.",
       .keys =
           {
               {.name = "name",
                .field = AT(deform.field_places[i].name),
                .meaning = "Name for messages."},
               {.name = "position",
                .field = AT(deform.field_places[i].position),
                .range = {-largest_m, largest_m},
                .unit = "m",
                .meaning = "The place in the undeformed terrain, [E, N] in the scene's CRS."},
               {.name = "position_lonlat",
                .field = AT(deform.field_places[i].position_lonlat),
                .unit = "°",
                .meaning = "The place, [longitude, latitude]; instead of position.",
                .lonlat = true},
               {.name = "moved_m",
                .field = AT(deform.field_places[i].moved_m),
                .range = {-1e5, 1e5},
                .unit = "m",
                .meaning = "Displacement as seen by the viewer, [to the right, up], after "
                           "exaggeration."},
               {.name = "noise_m",
                .field = AT(deform.field_places[i].noise_m),
                .range = {0.001, 1e5},
                .unit = "m",
                .meaning = "How exactly that is known: standard deviations of both."},
           },
       .count = [](const Scene& s) { return s.deform.field_places.size(); },
       .resize = [](Scene& s, std::size_t n) { s.deform.field_places.resize(n); }});
  return sections;
}

}  // namespace belvedere
