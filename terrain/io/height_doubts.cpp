#include "terrain/io/height_doubts.h"

#include <fmt/core.h>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

std::string doubt_of_position(const RasterFile& file) {
  if (file.crs().empty()) return {};
  const std::string doubt = doubt_of_place(file.crs(), centre_of(file));
  return doubt.empty() ? doubt
                       : fmt::format("{}: lies at {}; check its coordinate system (`crs`)",
                                     file.source().path, doubt);
}

// Refuses a band of colours: a picture of the terrain instead of a DEM.
void refuse_colours(const RasterFile& file) {
  const BandMeaning meaning = file.meaning();
  if (!meaning.palette && !meaning.colour) return;
  throw Error(ErrorKind::input, file.source().path,
              meaning.palette
                  ? fmt::format("band {} contains indices of a colour palette, not heights",
                                file.source().band)
                  : fmt::format("is a colour picture (band {} of {} is {}), not heights",
                                file.source().band, file.bands(), meaning.name),
              "the elevation model itself, with heights as numbers; tiles whose colours encode "
              "heights (Terrarium, Mapbox) must be decoded first");
}

}  // namespace

void check_height_sources(const std::vector<RasterSource>& sources, Progress& progress) {
  for (const RasterSource& source : sources) {
    const RasterFile file(source);
    refuse_colours(file);
    if (file.meaning().bytes)
      progress.note(
          fmt::format("{}: has 8 bits, so heights are limited to 0…255; check that it is not a "
                      "shaded relief or "
                      "another picture",
                      source.path));
    if (const double feet = file.undeclared_foot_m(); feet > 0.0)
      progress.note(fmt::format(
          "{}: its coordinate system is in feet, but its heights have no unit and are read as "
          "metres; if they are feet too, set `unit = \"{}\"`",
          source.path, feet == 0.3048 ? "ft" : "us-ft"));
    if (const std::string doubt = doubt_of_position(file); !doubt.empty()) progress.note(doubt);
  }
}

void note_height_range(const std::string& where, float lowest_m, float highest_m,
                       Progress& progress) {
  if (highest_m > highest_ground_m)
    progress.note(
        fmt::format("{}: altitudes from {:.0f} to {:.0f} m exceed the highest mountain; check "
                    "whether the unit is feet (`unit`), or set `highest_m` or `nodata`",
                    where, lowest_m, highest_m));
  if (lowest_m < lowest_ground_m)
    progress.note(
        fmt::format("{}: altitudes from {:.0f} to {:.0f} m are below the deepest sea; set "
                    "`lowest_m`, or `nodata` to the value of cells without a height",
                    where, lowest_m, highest_m));
}

}  // namespace belvedere
