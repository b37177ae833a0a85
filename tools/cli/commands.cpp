#include "tools/cli/commands.h"

#include <filesystem>

namespace belvedere::tools {

// In the order of the help.
const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands = {
      {"", "new", "Proposes views of a region from its elevation alone, and writes a scene", add_new, "Commands"},
      {"", "studio", "Composes a scene live, on a page of this machine", add_studio, "Commands"},
      {"", "fetch", "Downloads elevation and land cover of a region from open map services", add_fetch, "Commands"},
      {"", "check", "Checks a scene without rendering it", add_check, "Commands"},
      {"", "render", "Renders a scene: panorama.tif for print, .png for screens, .exr for further work", add_render, "Commands"},
      {"", "guidance", "Writes only guidance.exr: depth, classes, light … of every pixel, for other tools", add_guidance, "Commands"},
      {"", "labels", "Places the names of summits and other features in a scene's picture, as SVG and tables", add_labels, "Commands"},
      {"exemplar", "check", "Checks how well a painting is suited as an exemplar", add_exemplar_check},
      {"exemplar", "paint", "Paints an exemplar: a sheet with all classes, or a scene's view in strokes alone", add_exemplar_paint},
      {"exemplar", "pick", "Picks places in a painting and on a map, on a page of this machine, to register it", add_exemplar_pick},
      {"exemplar", "register", "Registers a painted panorama to its terrain: the place of every pixel", add_exemplar_register},
      {"exemplar", "segment", "Segments a painting into groups of similar paint, for a mask of its classes", add_exemplar_segment},
      {"style", "fit", "Fits a style to a scanned painting: its colours, strokes and sky", add_style_fit},
      {"layers", "fit", "Fits surface layers to a satellite image or a land-cover map and a DEM", add_layers_fit},
      {"layers", "apply", "Applies surface layers to a DEM: classes, colours and coverages as GeoTIFF", add_layers_apply},
      {"layers", "picture", "Draws surface layers from above, finer than the DEM, shaded, lakes with their beds", add_layers_picture},
      {"", "pdf", "Writes a picture as PDF for printing: page boxes, a press profile, vector labels, tiles", add_pdf, "Commands"},
      {"", "web", "Makes a web page of a rendered panorama: zoom, names, position and altitude; no server", add_web, "Commands"},
      {"", "plan", "Prepares a sheet that several machines make together", add_plan, "Large sheets"},
      {"", "part", "Makes one part of a planned sheet", add_part, "Large sheets"},
      {"", "join", "Joins the parts of a planned sheet into its files", add_join, "Large sheets"},
      {"", "sweep", "Renders a scene with several values of its keys, on one sheet of pictures", add_sweep, "Pictures beside each other"},
      {"", "figure", "Shows the paintings of a scene beside its picture: land cover, altitude, paint", add_figure, "Pictures beside each other"},
      {"", "info", "Describes a picture or guidance file: size, channels, how it was made", add_info, "Pictures beside each other"},
      {"", "diff", "Compares two pictures or guidance files, with thresholds", add_diff, "Pictures beside each other"},
      {"", "lock", "Records hashes of a scene's inputs and pixels, to detect changes later or elsewhere", add_lock, "Scenes under version control"},
      {"", "verify", "Renders scenes small and compares inputs and pixels with their locks", add_verify, "Scenes under version control"},
      {"", "generalize", "Generalizes a DEM: weights landforms by their size, keeps ridges sharp", add_generalize, "Ground"},
      {"", "deform", "Bends, exaggerates and moves the ground of a DEM or scene; searches bends, locates points", add_deform, "Ground"},
      {"features", "check", "Reports what becomes of a scene's roads, lifts and other vector features", add_features_check},
      {"features", "swatches", "Paints a picture of each kind of a feature style", add_features_swatches},
      {"", "synthesize", "Synthesizes a painting's texture over a label map, from image files alone", add_synthesize, "Textures"},
      {"texture", "learn", "Learns a texture from a crop of a painting, as a model of about a kilobyte", add_texture_learn},
      {"texture", "make", "Makes a texture of any size from a model, without repetition", add_texture_make},
      {"texture", "erode", "Erodes a mask step by step, along ragged borders: melting snow, retreating forest", add_texture_erode},
      {"texture", "seam", "Joins pictures side by side and synthesizes their seams from both", add_texture_seam},
      {"texture", "fill", "Fills a masked part of a picture from a model, matched to its surroundings", add_texture_fill},
      {"texture", "correct", "Gives a picture the colours of another, region by region", add_texture_correct},
      {"composite", "learn", "Learns several textures and their arrangement from a crop and its labels", add_composite_learn},
      {"composite", "make", "Makes a picture of several textures from a model, over a generated or given label map", add_composite_make},
      {"", "proof", "Simulates a picture in print, and shows which of its colours the press cannot print", add_proof, "Print"},
      {"palette", "check", "Lists the colours of a palette that a printing press cannot print", add_palette_check},
      {"", "schema", "Prints the keys of scene files, for editors or for reading", add_schema, "The program"},
      {"cache", "list", "Lists the results of earlier runs that are kept to speed up later ones", add_cache_list},
      {"cache", "clear", "Removes cached results, or those that were not used for long", add_cache_clear},
      {"", "man", "Prints the manual page", add_man, "The program"},
      {"", "completion", "Prints a script that completes commands, options and files in a shell", add_completion, "The program"},
  };
  return commands;
}

const std::vector<CommandGroup>& command_groups() {
  static const std::vector<CommandGroup> groups = {
      {"exemplar", "Exemplar paintings: checking, painting, registering and segmenting them", "Commands"},
      {"style", "Styles: the looks of paintings, to render scenes in", "Commands"},
      {"layers", "Surface layers: what covers the ground, by altitude, slope, sun …", "Commands"},
      {"features", "Roads, lifts, houses and other features of vector files", "Ground"},
      {"texture", "Textures as statistical models of about a kilobyte", "Textures"},
      {"composite", "Pictures of several textures: their arrangement and their filling", "Textures"},
      {"palette", "Palettes: whether a press can print them", "Print"},
      {"cache", "The cache of earlier results: land cover, terrain, example sheets", "The program"},
  };
  return groups;
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace belvedere::tools
