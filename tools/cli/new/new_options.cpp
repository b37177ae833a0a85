#include "tools/cli/new/new_options.h"
#include "tools/options/options.h"

namespace belvedere::tools {

void add_new_options(CommandOptions& command, NewOptions& options) {
  command.add_option("DEM", options.dems, "Elevation of the region: one file, or several that are joined; or --at, and it is fetched");
  command.add_option("--out", options.out, "The scene file to write").type_name("FILE").required();
  command.add_flag("--force", options.force, "Replaces a scene file that is there");
  command
      .add_option("--pictures", options.pictures,
                  "Renders small pictures of all proposals and writes them there as one sheet, proposals.png")
      .type_name("DIR");
  command.add_option("--choose", options.choose, "Which of the proposals is written").type_name("N").show_default().range(1, 12);
  command.add_option("--proposals", options.most, "How many proposals to make, at most").type_name("N").show_default().range(1, 12);
  command
      .add_option("--towards", options.towards, "Where to look: N, NE, southwest … or an azimuth in degrees; 15° either way are left free")
      .type_name("DIRECTION");
  command.add_option("--from", options.from, "Where the viewer stands: longitude and latitude").type_name("LON,LAT");
  command
      .add_option("--include", options.include,
                  "A place that must be in the picture: \"Innsbruck|11.39,47.27\" or 11.39,47.27; may be repeated")
      .type_name("[NAME|]LON,LAT")
      .repeated();
  command
      .add_option("--format", options.format,
                  "Shape of the sheet: 2:1, 3:1 …; A2, \"A2 upright\"; 2400x1200 pixels; cylinder, \"cylinder 8:1\" for a view all around")
      .type_name("FORMAT")
      .show_default();
  command.add_flag("--plain", options.plain,
                   "Neither widens valleys nor raises summits where that makes a better picture: the land is raised and bent as a whole");
  command.add_option("--title", options.title, "Title of the scene; without it the file's name").type_name("TEXT");
  command.add_option("--crs", options.crs, "Coordinate system of files that do not say it: EPSG:32632, or its definition").type_name("CRS");
  command.add_option("--lowest", options.lowest_m, "Altitudes below this are faults of the data, in metres").type_name("M");
  const Option cover =
      command.add_option("--land-cover", options.cover.file, "A raster of land cover; without it, climate and shape of the ground tell")
          .type_name("FILE");
  command.add_option("--legend", options.cover.legend, "What its codes mean: nlcd, corine, esa_worldcover, fbfm40, or a file")
      .type_name("NAME");
  command.add_option("--land-cover-band", options.cover.band, "Which band of that file holds the codes, where it is not the first")
      .type_name("N")
      .range(1, 65535)
      .needs(cover);
  command
      .add_option("--land-cover-crs", options.cover.crs,
                  "Its coordinate system, where the file does not say it and it is not that of --crs: EPSG:26911, or its definition")
      .type_name("CRS")
      .needs(cover);
  command.add_option("--land-cover-unknown", options.cover.unknown, "The class of codes that the legend lacks, such as shrub")
      .type_name("CLASS")
      .needs(cover);
  add_file_options(command, options.common);
  add_fetch_options(command, options.fetch);
  command.add_option("--fetched", options.fetched, "The folder for what --at fetches; default: beside the scene, SCENE_data")
      .type_name("DIR");
  add_run_options(command, options.common);
  command.footer(
      "Looks at the elevation alone and proposes views that differ: where to stand, where to look, how far to bend and raise\n"
      "the ground. Sky, foreground and horizon are laid out by rule; mountains, canyons, lakes, open valleys and ranges decide\n"
      "which view is best. The scene says at each value why it is so; change what you like, and belvedere check judges it\n"
      "by the same measures.\n\n"
      "  belvedere new my_dem.tif --out scene.toml\n"
      "  belvedere new my_dem.tif --out scene.toml --pictures proposals\n"
      "  belvedere new my_dem.tif --out scene.toml --choose 2 --force\n"
      "  belvedere new --at 11.4,47.35 --size 60 --out karwendel.toml\n"
      "  belvedere new my_dem.tif --out scene.toml --towards south --format 3:1 --include \"Innsbruck|11.39,47.27\"");
}

}  // namespace belvedere::tools
