#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/land_cover_class.h"
#include "renderer/mist/mist_bodies.h"
#include "renderer/paint/air.h"
#include "renderer/paint/guides.h"
#include "renderer/paint/light.h"
#include "renderer/paint/water/water_surface.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/guidance_rays.h"
#include "renderer/trace/light_field.h"
#include "renderer/trace/tracer.h"
#include "terrain/climate/climate.h"
#include "terrain/cover/land_cover_patches.h"
#include "terrain/deform/deform.h"
#include "terrain/generalize/generalize.h"
#include "terrain/generalize/widen_valleys.h"
#include "terrain/io/dem.h"
#include "terrain/io/features.h"
#include "terrain/synthetic/synthetic.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {

// A whole picture as plain values with defaults: the content of a scene file. scene_file turns TOML
// into it and checks every range; the table there is the reference of keys. Lengths in metres,
// angles in degrees.
//
// Parameters that a stage takes from the scene unchanged are members of the stage's own type, so
// each default is written once, beside the stage. Where a scene states something in another form (a
// position by longitude and latitude), the field here takes its default from there.

struct SceneSource {    // a file and where it comes from
  std::string file;     // relative to the scene file or a --data folder
  std::string unit;     // "m", "ft", "us-ft" or empty: the file's own unit
  RasterSource raster;  // without path and unit
  std::string origin;   // who made the data
  std::string licence;
  std::string get_from;  // where to get it; shown when it is missing
};

struct SceneTerrain {
  std::vector<SceneSource> sources;  // empty: synthetic
  std::optional<SyntheticParameters> synthetic;
  DemParameters dem;        // without sources
  double max_mcells = 0.0;  // millions of cells that the ground may have; 0: limited by memory
  // For previews, and no key of scene files: the ground is the level of the data's pyramid with
  // about so many millions of cells, without finer windows. 0: not a preview.
  double preview_mcells = 0.0;
};

struct SceneTown {  // a known town: see terrain/cover/towns.h
  std::string name;
  std::optional<glm::dvec2> position;         // E, N in the scene's CRS
  std::optional<glm::dvec2> position_lonlat;  // or longitude, latitude
  double radius_m = 0.0;                      // required in a scene
};

struct SceneLandCover {
  std::vector<SceneSource> sources;  // empty: by rules
  std::string legend;  // "nlcd", "corine", "esa_worldcover", "fbfm40", or a .csv or .toml file
  std::string rules = "life_zones";  // where there is no source: built-in name or file
  std::string layers;                // a file of surface layers, instead of rules; empty: none
  std::string colours =
      "palette";  // source of the ground's colours: "palette", "layers", "image" or "texture"
  std::string colour_image;   // the image from above, for "image"
  std::string texture;        // a composite, for "texture"
  double texture_m = 0.0;     // side of its pixels on the ground, m; 0: a cell of the DEM
  double colour_share = 1.0;  // weight of those colours against the palette's, 0…1
  double bumps = 1.0;         // factor on the height of the layers' bumps, 0…20
  bool lake_beds = true;  // with colours of layers: lakes are transparent, down to synthetic beds
  std::vector<std::pair<std::string, double>> settings;  // parameters of the rules or layers
  std::vector<SceneTown> towns;       // what the rules take as known about towns …
  std::string rock = "limestone";     // a kind of rock_kinds.h
  std::string sea = "auto";           // "auto" or "none"
  std::optional<double> sea_level_m;  // where the scene gives it
  std::string towns_file;             // … and a table of further ones; empty: none
  VectorSource towns_source;          // of that file, without path
  // Splits classes that a raster does not distinguish: {glacier, rock} turns the raster's rock into
  // glacier where the rules find a glacier.
  std::vector<std::pair<LandCoverClass, LandCoverClass>> refine;
  std::optional<LandCoverClass> unknown;
  std::optional<LandCoverClass> nodata;
  std::vector<std::pair<std::string, double>>
      erode;  // classes that retreat, in steps (land_cover_erosion.h)
  PatchParameters
      patches;  // generalization: small patches are removed, except of the classes that matter
};

struct SceneSeason {
  std::string date;  // "MM-DD"; empty: high summer, with the snow that lasts through it
  std::string frozen_lakes =
      "auto";  // with a winter palette: "auto", by the climate, "always" or "never"
};

struct SceneClimate {       // see terrain/climate/climate.h; default: the climate of the place
  std::string stations;     // a table of stations or a history of the climate; empty: none
  std::string temperature;  // raster of 12 months; empty: none
  double temperature_factor = ClimateParameters{}.temperature_factor;
  std::string rain;  // raster of 12 months or of the year; empty: none
  double rain_factor = ClimateParameters{}.rain_factor;
  double sheltered = ClimateParameters{}.sheltered;
  double warmer_k = ClimateParameters{}.warmer_k;
  double wetter = ClimateParameters{}.wetter;
  double clearings = 0.0;       // -1…1, of the class rules
  std::vector<float> sunshine;  // one share or twelve; empty: a clear sky
  std::optional<double> lapse_k_per_km;
  std::optional<double> wind_from_deg;
  std::optional<double> latitude_deg;  // of a terrain without CRS

  bool operator==(const SceneClimate&) const = default;
};

struct SceneGeneralize {
  std::string preset;  // used where the file gives no weights; empty: none
  GeneralizeParameters bands;
  std::optional<double>
      foreground_to_m;  // up to this distance only foreground; absent: by the horizon …
  std::optional<double> background_from_m;  // … and from here only background, smoothstep between
  std::string curvature = "bounded";        // "bounded" or "plan": becomes bands.curvature
  double print_detail_px = 0.0;             // 0: every band, at any distance
  std::array<double, 2> mask_slope_deg = {
      0, 0};  // original up to the first, generalized from the second; 0, 0: no mask
  bool automatic_mask = false;  // of slope feet
  std::string mask;             // raster; empty: none
  std::vector<std::pair<std::string, double>>
      mask_classes;  // share of the generalization that a class takes
  bool keep_lakes = true;
  bool destripe = false;           // removes stripes from the DEM itself, before everything else
  bool line_integral = false;      // line integral convolution, before the bands
  WidenValleysParameters valleys;  // after the bands
};

struct SceneSummit {  // a summit with its own exaggeration
  std::string name;
  std::optional<glm::dvec2> position;         // E, N in the scene's CRS
  std::optional<glm::dvec2> position_lonlat;  // or longitude, latitude
  SummitExaggeration summit;                  // without its centre
};

struct SceneHandle {  // a piece of ground that is moved: see terrain/deform/handles.h
  std::string name;
  std::optional<glm::dvec2> position;
  std::optional<glm::dvec2> position_lonlat;
  std::optional<double> core_m;               // else half of the radius
  std::array<double, 2> move_m = {0.0, 0.0};  // east, north
  DeformHandle handle{
      .radius_m =
          5000.0};  // without centre, core and move; a scene must set the radius of a handle
};

struct SceneDisplacedPlace {  // a place of the field: see terrain/deform/displacement.h
  std::string name;
  std::optional<glm::dvec2> position;
  std::optional<glm::dvec2> position_lonlat;
  std::array<double, 2> moved_m = {0.0, 0.0};  // to the right, up
  std::array<double, 2> noise_m = {50.0, 50.0};
};

struct SceneDeform {
  // Without summits, handles and places of the field (resolve_deform adds them, at positions in the
  // scene's CRS) and without the values below.
  DeformParameters ground;
  // Absent: derived from the region, see renderer/world/resolve_view.h.
  std::optional<double> exaggeration, exaggeration_base_m;
  std::optional<double> bend_radius_m, bend_crest_m;
  std::vector<SceneSummit> summits;
  std::vector<SceneHandle> handles;
  std::vector<SceneDisplacedPlace> field_places;
  bool allow_folds = false;  // a fold of ground in the picture is a note instead of an error

  // Only these values raise or bend the ground.
  DeformParameters written() const {
    DeformParameters out = ground;
    out.exaggeration = exaggeration.value_or(out.exaggeration);
    out.exaggeration_base_m = exaggeration_base_m.value_or(out.exaggeration_base_m);
    out.bend.radius_m = bend_radius_m.value_or(out.bend.radius_m);
    out.bend.crest_m = bend_crest_m.value_or(out.bend.crest_m);
    return out;
  }
};

struct SceneCamera {
  std::string projection = CameraParameters{}.projection;
  std::optional<glm::dvec2> position;         // E, N in the scene's CRS
  std::optional<glm::dvec2> position_lonlat;  // or longitude, latitude
  std::optional<double> height_m;             // absent: by the region
  bool height_above_ground = false;           // else above the datum
  std::optional<glm::dvec2> look_at;          // E, N: a point on the ground
  std::optional<glm::dvec2> look_at_lonlat;
  std::optional<double> look_at_altitude_m;  // else the ground's altitude, unbent
  std::optional<double> azimuth_deg;         // without look_at; absent: by the region
  std::optional<double> pitch_deg;
  std::optional<double> tilt_deg;  // added to the pitch in both cases
  double field_of_view_deg = CameraParameters{}.field_of_view_deg;
  std::array<double, 2> shift = {0.0, 0.0};
  double view_width_m = CameraParameters{}.view_width_m;
};

struct SceneSun {
  std::optional<double> azimuth_deg;  // absent: the painter's sun
  std::optional<double> altitude_deg;
  std::string time;  // ISO 8601 with zone; azimuth and altitude are then computed for the centre of
                     // the scene
  double radius_deg = painted_sun_radius_deg;  // of the disc: softness of cast shadows
};

struct SceneMist {  // see renderer/mist
  std::string name;
  std::string kind = "sea";                     // "sea", "valley" or "lee"
  std::optional<double> to_m;                   // required for a sea
  std::optional<double> visibility_m, patches;  // absent: by the kind
  std::optional<glm::dvec2> position;           // E, N in the scene's CRS
  std::optional<glm::dvec2> position_lonlat;    // or longitude, latitude
  MistParameters look;                          // without these
};

struct SceneAir {
  AirParameters look;                                 // without distances
  std::optional<double> from_m, scale_m, rim_fade_m;  // absent: by the horizon
  std::vector<SceneMist> mist;
};

struct SceneLightRegion {  // a part of the map with its own light: see renderer/trace/light_field.h
  std::string name;
  std::optional<glm::dvec2> position;         // a circle: its centre, E, N in the scene's CRS
  std::optional<glm::dvec2> position_lonlat;  // or longitude, latitude
  std::optional<double> radius_m;
  std::vector<glm::dvec2> points, points_lonlat;  // or the corners of an outline
  std::string file, layer, where;                 // or the areas of a vector file
  VectorSource source;                            // of the file, without path
  std::string origin, licence, get_from;
  bool optional = false;  // a missing file is a note instead of an error
  std::optional<double> azimuth_deg, altitude_deg, turn_deg;  // of its sun; absent: the scene's
  double strength = LightRegion{}.strength;
  double warmth = LightRegion{}.warmth;
  double blend_m = LightRegion{}.blend_m;
};

struct SceneLightCloud {  // the shadow of a cloud
  std::string name;
  std::optional<glm::dvec2> position;
  std::optional<glm::dvec2> position_lonlat;
  double radius_m = CloudShadow{}.radius_m;
  double strength = CloudShadow{}.strength;
  std::optional<double> blend_m;  // absent: as wide as the radius
};

// One exemplar: painted by the program (picture empty), or a picture with a class mask and perhaps
// guides.
struct SceneExemplar {
  std::string picture;  // file; empty: the program paints one
  std::string model;    // file of a texture model instead
  std::string prefer =
      "texels";  // for the model's classes: "texels" while there are enough, or the "model"
  std::string light = "any";  // ground that the model paints: "lit", "shaded" or "any"
  std::string guidance;       // guidance.exr of the picture, and/or:
  std::string classes;        // grey image of class ids, instead of those of guidance; 255 excludes
  std::string classes_from = "paint";  // of guidance that was not painted with the picture: "paint"
                                       // corrects its classes, "guidance" takes them as they are
  std::string altitude;                // grey image, scaled by altitude_range_m
  std::array<double, 2> altitude_range_m = {0.0, 4000.0};
  std::string distance;  // grey image, scaled by distance_range_m in equal ratios
  std::array<double, 2> distance_range_m = {2000.0, 60000.0};
  std::string trust;              // grey image: how far the place of a pixel is known
  std::string shadow;             // grey image: black in cast shadow, white in the sun
  std::string exclude;            // grey image: pixels that are not black are never copied from
  std::string excluded = "skip";  // what happens to it: "skip", or "fill" it from the paint around
  std::vector<LandCoverClass> serves;  // classes it may be copied for; empty: all
  std::string found_shadow = "guide";  // without a shadow image: what to do with dark, cool pixels:
                                       // "guide", "exclude" or "ignore"
  double stroke_px = 6.0;  // variation larger than this is light, smaller variation is strokes
  std::string origin, licence, get_from;
  bool optional = false;  // a missing file is a note instead of an error
  int width =
      0;  // px of a painted one, 64…16384; 0: from the other at 10 : 7, or both from the print size
  int height = 0;
  std::uint64_t seed = 7;
};

struct SceneStyle {  // of a painting: see renderer/style
  std::string file;  // built-in name or file; empty: none
  double palette = 1.0;
  double brushwork = 1.0;
  double sky = 1.0;
  std::optional<double> scale;  // absent: the style's own
  bool winter = false;          // open ground under the style's snow
  double contour_lines = 1.0;
  double relief = 1.0;
  double canvas = 1.0;
};

struct SceneSynthesis {
  std::optional<bool> enabled;      // copies; absent: where the scene has exemplars, see copies()
  std::string colours = "palette";  // whose colours the picture takes: "palette" or "painting"
  std::string harmonize = "off";    // matching colours of several paintings: "off", "common", or to
                                    // the "first", by class or by "regions"
  bool synthesize_seams = false;    // between paintings, by models of the paint on both sides
  double residual = 0.75;  // share of the base picture's difference added to the texel, 0…1
  std::vector<std::pair<std::string, double>> weights =
      default_guide_weights();  // by guide (renderer/paint/guides.h)
  std::vector<std::pair<LandCoverClass, LandCoverClass>> fallback;
  std::vector<std::pair<std::string, double>>
      class_dissimilarity;              // by two names of classes, "forest/shrub"
  std::optional<double> neighbourhood;  // px, odd, 3…11; absent: by the length of strokes
  double plan_mpx = 4.0;  // Mpx, 0.001…64: texels are chosen for the whole sheet on a picture of it
                          // of at most that size
  SynthesisParameters search;  // without seed, weights, fallback, class dissimilarity and
                               // neighbourhood
};

// Features of one vector file, drawn by the table of kinds (renderer/features/feature_style.h).
struct SceneFeatures {
  std::string source;  // file
  VectorSource file;   // without path
  std::string layer;   // of the file; empty: all that have such features
  std::string where;   // filter by attributes; empty: all
  std::string
      kind;  // a word of the style; with kind_of, for features whose column has no known kind
  std::string kind_of;         // a column that contains kinds; empty: none
  double width_mm = 0.0;       // of the sheet; 0: the style's
  std::string width_of;        // a column with widths in metres of the ground; empty: none
  std::string level_of;        // a column with altitudes of lakes, m; empty: none
  std::string population_of;   // a column with inhabitants of towns; empty: none
  double snap_m = 150.0;       // rivers are moved to the valley bottom within this distance
  bool keep_inferred = false;  // keeps inferred rivers and towns beside those of this file
  std::string origin, licence, get_from;
  bool optional = false;  // a missing file is a note instead of an error
  bool enabled = true;    // otherwise as if it were not there
};

struct SceneLabelFile {  // a file of named things, or of ways
  std::string file;
  VectorSource source;  // without path
  std::string origin, licence, get_from;
  bool optional = false;  // a missing file is a note instead of an error
  bool enabled = true;    // otherwise as if it were not there
};

struct SceneNameByHand {               // what a cartographer decides about one name
  std::string name;                    // as in its file
  std::optional<double> dx_mm, dy_mm;  // LabelPoint::by_hand_mm
  bool hidden = false;
  std::optional<double> rank;  // 1 … 9
  std::string kind;            // a word of the style; empty: as in its file
};

struct SceneLabels {  // names on the picture: see renderer/labels
  std::string style = "classic";
  bool in_picture = false;          // also panorama_names.*, with the names drawn in
  int summits = 0;                  // of the DEM itself
  double min_prominence_m = 150.0;  // of these summits
  std::vector<SceneLabelFile> points, shapes, tracks;
  std::vector<SceneNameByHand> by_hand;

  bool any() const {
    const auto some = [](const std::vector<SceneLabelFile>& files) {
      return std::any_of(files.begin(), files.end(), [](const auto& file) { return file.enabled; });
    };
    return summits > 0 || some(points) || some(shapes) || some(tracks);
  }
};

struct SceneMargin {  // around panorama_names.*: see renderer/labels/margin.h
  std::string title;  // empty: the scene's
  std::string subtitle;
  double frame_mm = 12.0;
  bool legend = true;
  bool scale_bars = true;
  bool directions = true;
  bool sources = true;
};

struct SceneOutput {
  int width = CameraParameters{}.width;
  int height = CameraParameters{}.height;
  double sheet_width_mm = 1200.0;  // strokes are sized in mm of this sheet; dpi follows
  std::vector<std::string> formats = {
      "tif", "png", "exr"};  // extensions of the picture's files (renderer/image/picture_formats.h)
  std::string profile;       // ICC file to convert the TIFF to, RGB or CMYK; empty: `colours`
  std::string colours = "srgb";  // of the TIFF, without a profile: a name of device_colour.h
  std::string intent =
      "perceptual";  // how colours are mapped into the profile or space: a name of device_colour.h
  bool black_point = true;  // maps the picture's black to the device's darkest colour
  double ink_limit = 0.0;   // percent, of CMYK, for the report; 0: the profile's own limit
  std::string ocio_config;
};

struct Scene {
  int version = 1;
  std::string title;
  std::uint64_t seed = 1;
  SceneTerrain terrain;
  SceneLandCover land_cover;
  SceneSeason season;
  SceneClimate climate;
  SceneGeneralize generalize;
  SceneDeform deform;
  SceneCamera camera;
  SceneSun sun;
  SamplingParameters sampling;
  TracerParameters
      tracing;  // its instruction set is fixed where several machines must give the same picture
  LightParameters light;
  WaterParameters water;
  std::vector<SceneLightRegion> light_regions;
  std::vector<SceneLightCloud> light_clouds;
  SceneAir air;
  std::string sky = "any";         // a kind of clouds.h
  std::string palette = "summer";  // built-in name or file
  std::vector<SceneExemplar> exemplars;
  SceneStyle style;
  SceneSynthesis synthesis;
  std::string features_style = "classic";  // built-in name or file
  std::vector<SceneFeatures> features;
  SceneLabels labels;
  std::optional<SceneMargin> margin;
  SceneOutput output;

  bool any_features() const {
    return std::any_of(features.begin(), features.end(),
                       [](const SceneFeatures& block) { return block.enabled; });
  }
  // Whether ground is copied from exemplars. Where only the program's own sheet would be copied, it
  // is painted directly: that sheet has the same strokes.
  bool copies() const { return synthesis.enabled.value_or(!exemplars.empty()); }
  // Pixels in a unit of paint, 0.5 mm of the sheet. Where a picture has fewer than `min` (15 dpi),
  // it is painted as on a smaller sheet that has them: strokes would only be ever more for a pixel,
  // each far below one.
  double pixels_per_unit() const {
    constexpr double min = 0.3;
    return std::max(min, output.width / output.sheet_width_mm * 0.5);
  }
};

}  // namespace belvedere
