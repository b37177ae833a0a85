#include "tools/cli/layers/fit_sources.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>

#include "base/error.h"
#include "base/text/text_encoding.h"
#include "renderer/image/image_io.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/raster_io.h"
#include "terrain/layers/fit/picture_classes.h"
#include "terrain/layers/fit/picture_haze.h"
#include "tools/cli/commands.h"
#include "tools/cli/layers/ground_climate_options.h"

namespace belvedere::tools {
namespace {

RasterSource source_of(const std::string& path, int band = 1) {
  RasterSource source;
  source.path = path;
  source.band = band;
  return source;
}

// Georeferenced pictures.
bool has_geography(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".tif" || extension == ".tiff" || extension == ".img" || extension == ".vrt";
}

RasterFrame frame_of(const Dem& dem) { return {dem.transform, dem.width(), dem.height(), dem.crs}; }

// A picture without coordinates has one pixel per cell of the DEM; to one with coordinates the DEM
// is resampled.
FitGround read_picture_ground(const FitSources& from, FitFindings& findings, Progress& progress) {
  FitGround ground;
  if (!has_geography(from.image)) {
    if (!from.bands.empty())
      throw Error(ErrorKind::usage, "--bands", "a picture has red, green and blue only",
                  "a GeoTIFF of more bands");
    ground.dem = read_layer_dem(from.dem, from.elevation, progress);
    const Grid<glm::vec3> picture = read_picture(from.image);
    if (picture.width() != ground.dem.width() || picture.height() != ground.dem.height())
      throw Error(
          ErrorKind::input, from.image,
          fmt::format("{}×{} pixels, but {} has {}×{} cells, and the picture is not georeferenced",
                      picture.width(), picture.height(), file_name(from.dem), ground.dem.width(),
                      ground.dem.height()),
          "one pixel for each cell, or a GeoTIFF with coordinates");
    findings.note("the picture has no coordinates and lies on the cells of the DEM");
    ground.rgb = picture;
    for (glm::vec3& colour : *ground.rgb) colour *= 255.0F;
  } else {
    const RasterInfo info = read_raster_info(source_of(from.image));
    const std::vector<int> bands = from.bands.empty() ? std::vector{1, 2, 3} : from.bands;
    if (const int last = *std::max_element(bands.begin(), bands.end()); info.bands < last)
      throw Error(ErrorKind::input, from.image,
                  fmt::format("{} band{}", info.bands, info.bands == 1 ? "" : "s"),
                  from.bands.empty() ? "red, green and blue" : fmt::format("band {}", last));
    RasterFrame frame{info.transform, info.width, info.height, info.crs};
    if (info.crs.empty())
      throw Error(ErrorKind::usage, from.image, "no coordinate system", "a GeoTIFF that has one");
    if (info.geographic || !crs_traits(info.crs).metric)
      frame = choose_frame({source_of(from.image)}, "", 0.0, std::nullopt);
    const auto band = [&](int number) {
      RasterSource source = source_of(from.image, number);
      source.unit_to_m = 1.0;  // no altitudes
      return warp_rasters({source}, frame, progress).cells;
    };
    const Grid<float> red = band(bands[0]);
    const Grid<float> green = band(bands[1]);
    const Grid<float> blue = band(bands[2]);
    if (bands.size() > 3) {
      ground.swir = band(bands[3]);
      for (float& value : *ground.swir) value = std::isfinite(value) ? value : 0.0F;
    }
    ground.rgb = Grid<glm::vec3>(red.width(), red.height());
    for (std::size_t i = 0; i != red.size(); ++i) (*ground.rgb)[i] = {red[i], green[i], blue[i]};
    Raster<float> altitude = warp_rasters({source_of(from.dem)}, frame, progress);
    const RasterInfo dem = read_raster_info(source_of(from.dem));
    if (std::none_of(altitude.cells.begin(), altitude.cells.end(),
                     [](float z) { return std::isfinite(z); }))
      throw Error(ErrorKind::input, from.image,
                  fmt::format("does not overlap {}", file_name(from.dem)),
                  "a picture of the DEM's area");
    if (dem.width != frame.width || dem.height != frame.height ||
        !(dem.transform == frame.transform))
      findings.note(fmt::format("the DEM ({}×{} cells) was resampled to the picture's {}×{} cells",
                                dem.width, dem.height, frame.width, frame.height));
    ground.dem = make_dem(std::move(altitude));
  }
  ground.use = Grid<std::uint8_t>(ground.dem.width(), ground.dem.height());
  float max = 0.0F;
  for (std::size_t i = 0; i != ground.use.size(); ++i) {
    glm::vec3& rgb = (*ground.rgb)[i];
    const bool known = std::isfinite(rgb.x) && std::isfinite(rgb.y) && std::isfinite(rgb.z);
    ground.use[i] = known && ground.dem.filled[i] == 0 ? 1 : 0;
    if (!known) rgb = glm::vec3(0.0F);
    max = std::max({max, rgb.x, rgb.y, rgb.z});
  }
  if (max > 255.0F)
    throw Error(ErrorKind::input, from.image, fmt::format("values up to {}", max),
                "8 bits, 0…255, as a picture is shown");
  if (from.haze) {
    const PictureHaze haze = find_haze(*ground.rgb, ground.dem.altitude_m, ground.use);
    ground.rgb = without_haze(*ground.rgb, ground.dem.altitude_m, haze);
    findings.note(fmt::format("haze taken out: {:.0f}, {:.0f}, {:.0f} of 255 at sea level",
                              haze.at_sea_level.x, haze.at_sea_level.y, haze.at_sea_level.z));
  }
  return ground;
}

// Cells that the user masked are left out, such as fields, which the ground does not explain.
void leave_out_masked(const FitSources& from, FitGround& ground, FitFindings& findings,
                      Progress& progress) {
  if (from.mask.empty()) return;
  const Raster<std::int32_t> mask =
      warp_codes({source_of(from.mask)}, frame_of(ground.dem), progress);
  std::size_t left_out = 0;
  for (std::size_t i = 0; i != ground.use.size(); ++i) {
    if (mask.cells[i] <= 0) continue;
    ground.use[i] = 0;
    ++left_out;
  }
  findings.note(
      fmt::format("{:.1f} % of the cells are masked",
                  100.0 * static_cast<double>(left_out) / static_cast<double>(ground.use.size())));
}

void classes_of_picture(const FitSources& from, const FitGround& ground, KnownGround& known,
                        FitFindings& findings) {
  PictureClassParameters parameters;
  if (!from.regions.empty())
    parameters.regions = read_colour_regions(
        from.regions, [](const std::string& path) { return read_picture(path); });
  parameters.swir = ground.swir ? &*ground.swir : nullptr;
  parameters.grey_hue_deg = from.grey_hue_deg;
  parameters.snow_from_m = from.snow_from_m.value_or(parameters.snow_from_m);
  PictureClasses found =
      picture_classes(*ground.rgb, known.altitude_m, known.cell_m, ground.use, parameters);
  const auto share = [](const Grid<std::uint8_t>& mask) {
    std::size_t set = 0;
    for (const std::uint8_t m : mask) set += m;
    return 100.0 * static_cast<double>(set) / static_cast<double>(mask.size());
  };
  if (found.clouds.found && !found.clouds.shadows)
    findings.note(fmt::format("clouds cover {:.1f} %, by their infrared; no shadows match them",
                              share(found.clouds.cloud)));
  else if (found.clouds.found)
    findings.note(fmt::format(
        "clouds cover {:.1f} %, their shadows {:.1f} %, {} cells {} and {} {} of them: the sun "
        "stands at azimuth {:.0f}°",
        share(found.clouds.cloud), share(found.clouds.shadow), std::abs(found.clouds.shadow_x),
        found.clouds.shadow_x < 0 ? "west" : "east", std::abs(found.clouds.shadow_y),
        found.clouds.shadow_y < 0 ? "north" : "south", found.clouds.sun_azimuth_deg));
  else
    findings.note("no clouds: nothing white has a shadow beside it");
  if (!parameters.regions.empty())
    findings.note(fmt::format("{} classes by {} regions drawn", found.classes.size(),
                              parameters.regions.size()));
  else if (found.lightness)
    findings.note(
        fmt::format("{} classes by lightness: nearly all has one hue", found.classes.size()));
  else
    findings.note(fmt::format("{} classes by hue and saturation, of {} parts of a mixture",
                              found.classes.size(), found.parts));
  findings.note(fmt::format("{:.1f} % of the ground in use is grey", 100.0 * found.grey_share));
  if (from.snow_from_m)
    findings.note(fmt::format("{:.1f} % are white below {:g} m and left out",
                              100.0 * found.low_white_share, *from.snow_from_m));
  known.classes = std::move(found.classes);
  known.labels = std::move(found.labels);
  known.picture = FitPicture{*ground.rgb, found.clouds.shadows
                                              ? std::optional<double>(found.clouds.sun_azimuth_deg)
                                              : std::nullopt};
}

void classes_of_map(const FitSources& from, const FitGround& ground, KnownGround& known,
                    FitFindings& findings, Progress& progress) {
  const Legend legend = read_legend(from.legend);
  const Raster<std::int32_t> codes =
      warp_codes({source_of(from.classes)}, frame_of(ground.dem), progress);
  known.labels.assign(ground.use.size(), no_class);
  std::array<int, 256> number{};
  number.fill(-1);
  std::map<std::int32_t, std::size_t> unknown;
  std::size_t overlapping = 0;
  for (std::size_t i = 0; i != known.labels.size(); ++i) {
    const std::int32_t code = codes.cells[i];
    if (code >= 0) ++overlapping;
    if (ground.use[i] == 0 || code < 0 || legend.nodata.contains(code)) continue;
    const auto entry = legend.entries.find(code);
    if (entry == legend.entries.end()) {
      ++unknown[code];
      continue;
    }
    const LandCoverClass painted_as = entry->second.painted_as;
    int& k = number[static_cast<std::size_t>(painted_as)];
    if (k < 0) {
      k = static_cast<int>(known.classes.size());
      const auto info =
          std::find_if(land_cover_table.begin(), land_cover_table.end(),
                       [&](const LandCoverClassInfo& row) { return row.id == painted_as; });
      known.classes.push_back({std::string(info->name), painted_as, info->rgb});
    }
    known.labels[i] = static_cast<std::uint8_t>(k);
  }
  if (overlapping == 0)
    throw Error(ErrorKind::input, from.classes,
                fmt::format("does not overlap {}", file_name(from.dem)),
                "land cover of the DEM's area");
  const RasterInfo info = read_raster_info(source_of(from.classes));
  if (info.width != ground.dem.width() || info.height != ground.dem.height())
    findings.note(fmt::format("the classes ({}×{} cells) were resampled to the DEM's {}×{} cells",
                              info.width, info.height, ground.dem.width(), ground.dem.height()));
  for (const auto& [code, cells] : unknown)
    findings.note(
        fmt::format("code {} ({} cells) is not in the legend and is left out", code, cells));
}

}  // namespace

FitGround read_fit_ground(const FitSources& from, FitFindings& findings, Progress& progress) {
  FitGround ground;
  if (!from.image.empty()) {
    ground = read_picture_ground(from, findings, progress);
  } else {
    ground.dem = read_layer_dem(from.dem, from.elevation, progress);
    ground.use = Grid<std::uint8_t>(ground.dem.width(), ground.dem.height());
    for (std::size_t i = 0; i != ground.use.size(); ++i)
      ground.use[i] = ground.dem.filled[i] == 0 ? 1 : 0;
  }
  leave_out_masked(from, ground, findings, progress);
  return ground;
}

KnownGround find_ground_classes(const FitSources& from, const FitGround& ground,
                                FitFindings& findings, Progress& progress) {
  KnownGround known;
  known.cell_m = ground.dem.cell_m();
  known.altitude_m = ground.dem.altitude_m;
  progress.begin("finding classes", 0.0);
  if (!from.image.empty())
    classes_of_picture(from, ground, known, findings);
  else
    classes_of_map(from, ground, known, findings, progress);
  return known;
}

}  // namespace belvedere::tools
