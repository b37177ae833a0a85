#include "tools/cli/commands.h"

#include "tools/cli/contact/contact_commands.h"
#include "tools/cli/press/press_commands.h"

namespace belvedere::tools {

// In the order of the help.
const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands = {
      {"", "new", "Proposes views of a region from its elevation alone, and writes a scene", add_new},
      {"", "render", "Renders a scene: panorama.tif for print, .png for screens, .exr for further work", add_render},
      {"", "guidance", "Makes only guidance.exr: depth, classes, light … of every pixel, for other tools", add_guidance},
      {"", "sweep", "Renders a scene with several values of its keys, as one sheet of pictures", add_sweep},
      {"", "figure", "Shows what a scene copies from and what comes of it: land cover, altitude, picture", add_figure},
      {"", "plan", "Prepares a sheet that several machines make together", add_plan},
      {"", "part", "Makes one part of a planned sheet", add_part},
      {"", "join", "Joins the parts of a planned sheet to its files", add_join},
      {"", "fetch", "Gets elevation and land cover of any place from open map services, with their licences", add_fetch},
      {"", "generalize", "Simplifies a DEM for a map: weights landforms by their size, keeps ridges sharp", add_generalize},
      {"", "synthesize", "Lays a painting's texture over a label map; works on image files alone", add_synthesize},
      {"", "check", "Says whether a scene can be rendered, without rendering it", add_check},
      {"", "lock", "Writes down a scene's inputs and pixels, to tell later and elsewhere whether they are the same", add_lock},
      {"", "verify", "Renders scenes small and compares inputs and pixels with what their locks say", add_verify},
      {"", "deform", "Bends, exaggerates and moves ground: a DEM to a deformed DEM; finds bends and places", add_deform},
      {"", "labels", "Finds where summits and other names stand in a scene's picture, and writes them as SVG and tables", add_labels},
      {"features", "check", "Says what becomes of a scene's roads, lifts and other features of vector files", add_features_check},
      {"features", "swatches", "Paints a picture of each kind of a style of features", add_features_swatches},
      {"cache", "list", "Lists what is kept from earlier runs to make the next ones faster", add_cache_list},
      {"cache", "clear", "Removes what is kept from earlier runs, or what was not used for long", add_cache_clear},
      {"exemplar", "check", "Tells what a painting can serve before anything is copied from it", add_exemplar_check},
      {"exemplar", "paint", "Paints an example for synthesis to copy: a sheet with everything on it, or a scene's view in strokes alone",
       add_exemplar_paint},
      {"exemplar", "segment", "Finds what belongs together in a painting, for a mask of its classes", add_exemplar_segment},
      {"layers", "fit", "Learns surface layers from a satellite picture or a land-cover map and a DEM", add_layers_fit},
      {"layers", "apply", "Lays surface layers over a DEM: classes, colours and coverages as GeoTIFF", add_layers_apply},
      {"layers", "picture", "Draws the ground of surface layers from above, finer than the DEM, lit, lakes with beds", add_layers_picture},
      {"texture", "learn", "Learns a texture from a crop of a painting, as statistics of a kilobyte", add_texture_learn},
      {"texture", "make", "Makes a texture of any size from such a model, without end and without repeating", add_texture_make},
      {"texture", "erode", "Takes a mask back step by step, along ragged borders: melting snow, forest in retreat", add_texture_erode},
      {"texture", "knit", "Joins pictures side by side, their seams made anew from both", add_texture_knit},
      {"texture", "fill", "Makes anew a masked part of a picture from such a model, to go with what is around it", add_texture_fill},
      {"composite", "learn", "Learns a picture of several textures, and how they lie, from a crop and its labels", add_composite_learn},
      {"composite", "make", "Makes such a picture of any size, over a map of labels that is made or drawn", add_composite_make},
      {"texture", "correct", "Gives a picture the colours of another, region by region", add_texture_correct},
      {"", "web", "Makes a page of a rendered panorama: zoom, names, place and altitude under the pointer; no server", add_web},
      {"", "pdf", "Writes a picture as PDF for printing: page boxes, a press profile, labels as vectors, tiles", add_pdf},
      {"", "proof", "Shows what a printing press will make of a picture, and which of its colours it cannot print", add_proof},
      {"palette", "check", "Says which colours of a palette a printing press cannot print", add_palette_check},
      {"", "info", "Says what a picture or guidance file holds and how it was made", add_info},
      {"", "diff", "Compares two pictures or guidance files, with thresholds", add_diff},
      {"", "schema", "Prints what a scene file may say, for editors or for reading", add_schema},
      {"", "man", "Prints the manual page", add_man},
      {"", "completion", "Prints what makes a shell complete commands, options and files", add_completion},
  };
  return commands;
}

const std::vector<CommandGroup>& command_groups() {
  static const std::vector<CommandGroup> groups = {
      {"features", "About roads, lifts, houses and other features of vector files"},
      {"cache", "About what is kept from earlier runs: land cover, terrain, example sheets"},
      {"exemplar", "About example paintings: what they can serve, and painting one"},
      {"layers", "About surface layers: what covers the ground, said by what is known of it"},
      {"texture", "About textures as statistics: paint without end from a kilobyte"},
      {"palette", "About palettes: whether a press can print them"},
      {"composite", "About pictures of several textures: what lies where, and what it is filled with"}};
  return groups;
}

}  // namespace belvedere::tools
