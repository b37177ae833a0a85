#include "tools/cli/new/new_options.h"
#include "tools/options/options.h"

namespace belvedere::tools {

void add_new_options(CommandOptions& command, NewOptions& options) {
  command.add_option(
      "DEM", options.dems,
      "Elevation of the region: one file, or several that are joined; or use --at to fetch it");
  command.add_option("--out", options.out, "The scene file to write")
      .type_name("FILE")
      .required()
      .files(FileUse::writes);
  command.add_flag("--force", options.force, "Replaces an existing scene file");
  command
      .add_option(
          "--pictures", options.pictures,
          "Renders small pictures of all proposals to this folder, with the sheet proposals.png")
      .type_name("DIR")
      .files(FileUse::folder);
  command.add_option("--choose", options.choose, "Number of the proposal to write")
      .type_name("N")
      .show_default()
      .range(1, 12);
  command.add_option("--proposals", options.max, "Maximum number of proposals")
      .type_name("N")
      .show_default()
      .range(1, 12);
  command
      .add_option(
          "--towards", options.towards,
          "Direction of view: N, NE, southwest … or an azimuth in degrees; ±15° are allowed")
      .type_name("DIRECTION");
  command.add_option("--from", options.from, "Position of the viewer: longitude and latitude")
      .type_name("LON,LAT");
  command
      .add_option("--include", options.include,
                  "A place that must be in the picture: \"Innsbruck|11.39,47.27\" or 11.39,47.27; "
                  "may be repeated")
      .type_name("[NAME|]LON,LAT")
      .repeated();
  command
      .add_option("--format", options.format,
                  "Shape of the sheet: 2:1, 3:1 …; A2, \"A2 upright\"; 2400x1200 pixels; cylinder, "
                  "\"cylinder 8:1\" for a full circle")
      .type_name("FORMAT")
      .show_default();
  command.add_flag("--plain", options.plain,
                   "Does not widen valleys or raise summits for a better picture; the land is only "
                   "raised and bent as a whole");
  command.add_option("--title", options.title, "Title of the scene. Default: the file's name")
      .type_name("TEXT");
  command
      .add_option("--style", options.style,
                  "The look of a painting: segantini, gogh, monet, turner, rubens, bruegel, or a "
                  "file of belvedere style fit")
      .type_name("STYLE");
  command
      .add_option("--crs", options.crs,
                  "Coordinate system of files that do not state it: EPSG:32632, or its definition")
      .type_name("CRS");
  add_elevation_options(command, options.elevation);
  command
      .add_option("--lowest", options.lowest_m,
                  "Altitudes below this are errors of the data, in metres")
      .type_name("M");
  const Option cover =
      command
          .add_option("--land-cover", options.cover.file,
                      "A raster of land cover. Default: classified by climate and terrain")
          .type_name("FILE");
  command
      .add_option("--legend", options.cover.legend,
                  "Meaning of its codes: nlcd, corine, esa_worldcover, fbfm40, or a file")
      .type_name("NAME");
  command
      .add_option("--land-cover-band", options.cover.band,
                  "Band of that file that holds the codes, if not the first")
      .type_name("N")
      .range(1, 65535)
      .needs(cover);
  command
      .add_option("--land-cover-variable", options.cover.variable,
                  "Name of the raster of codes in a file that contains several")
      .type_name("NAME")
      .needs(cover);
  command
      .add_option("--land-cover-crs", options.cover.crs,
                  "Its coordinate system, if the file does not state it and it differs from --crs: "
                  "EPSG:26911, or its definition")
      .type_name("CRS")
      .needs(cover);
  command
      .add_option("--land-cover-unknown", options.cover.unknown,
                  "The class of codes that the legend lacks, such as shrub")
      .type_name("CLASS")
      .needs(cover);
  add_file_options(command, options.common);
  add_fetch_options(command, options.fetch);
  command
      .add_option("--fetched", options.fetched,
                  "Folder for what --at fetches. Default: beside the scene, SCENE_data")
      .type_name("DIR");
  add_run_options(command, options.common);
  command.footer(
      "Analyses the elevation alone and proposes different views: position, direction, bend and "
      "exaggeration of the ground.\n"
      "Sky, foreground and horizon are laid out by rule; mountains, canyons, lakes, open valleys "
      "and ranges decide which view\n"
      "is best. The scene states the reason of each value; change what you like, and belvedere "
      "check evaluates it by the\n"
      "same measures.\n"
      "\n"
      "  belvedere new my_dem.tif --out scene.toml\n"
      "  belvedere new my_dem.tif --out scene.toml --pictures proposals\n"
      "  belvedere new my_dem.tif --out scene.toml --choose 2 --force\n"
      "  belvedere new --at 11.4,47.35 --size 60 --out karwendel.toml\n"
      "  belvedere new my_dem.tif --out scene.toml --towards south --format 3:1 --include "
      "\"Innsbruck|11.39,47.27\"");
}

}  // namespace belvedere::tools
