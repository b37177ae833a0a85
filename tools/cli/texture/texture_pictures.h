#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "base/text/json.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/texture_figures.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere::tools {

// A crop of a painting, and which of its pixels count (texture/statistical/band_pyramid.h).
struct TextureCrop {
  Grid<Rgb8> picture;
  Grid<std::uint8_t> states;    // empty: all count
  std::size_t transparent = 0;  // pixels that the file marks as transparent
};

// Reads a crop and, where named, a mask: grey, 0 is left out. Transparent pixels are left out too.
// Error(input) for masks of another size and for what read_picture refuses. `stored` receives the
// values as in the file, 0…1: 16 bits where it has them.
TextureCrop read_crop(const std::string& path, const std::string& mask,
                      Grid<glm::vec3>* stored = nullptr);

// The stored values where the picture is unchanged, the new values elsewhere, so that unchanged
// pixels keep their full depth.
Grid<glm::vec3> with_changes(Grid<glm::vec3> stored, const Grid<Rgb8>& before,
                             const Grid<Rgb8>& after);
// Notes that a file of 16 bits is written in 8.
void note_rounding(const std::string& read, const std::string& out, Progress& progress);

// A grey mask of a picture's size: 1 where it is not 0. Error(input) for another size.
Grid<std::uint8_t> read_mask_of(const std::string& path, const std::string& picture_path,
                                const Grid<Rgb8>& picture);

// Writes a picture in the format of its extension, which must hold 8 bits or more and not be
// linear: Error(usage) for others.
void write_texture(const std::string& path, const Grid<Rgb8>& picture, const std::string& note);
// The same for encoded sRGB, 0…1.
void write_encoded_texture(const std::string& path, const Grid<glm::vec3>& picture,
                           const std::string& note);
// The same for a picture that is made in strips of endless_tile_px rows, with the memory of one.
// `make` gets the strip.
void write_texture_strips(const std::string& path, int width, int height, const std::string& note,
                          const std::function<Grid<Rgb8>(PixelRect strip)>& make);
// Throws what write_texture would for the name, before any work.
void check_texture_name(const std::string& path);

// Adds the five distances to the JSON output.
Json with_figures(Json object, const TextureFigures& figures);

// A picture of labels: for each pixel the index of its label in `names`, or no_label
// (texture/statistical/clique_model.h). A name is a flat colour, "#0000ff", or a number, "3", as
// in the picture.
struct LabelPicture {
  Grid<std::uint8_t> labels;
  std::vector<std::string> names;
};

// Drawn in flat colours or as numbers (renderer/image/label_image.h). Names that occur, in
// ascending order.
LabelPicture read_label_picture(const std::string& path, Progress& progress = silent_progress());

// The labels of a drawing by the names of a composite: Error(input) for a name that the composite
// lacks, by more than max_lossy_steps. Unknown pixels take the nearest label.
Grid<std::uint8_t> read_drawn_labels(const std::string& path, const std::vector<std::string>& names,
                                     Progress& progress = silent_progress());

// A PNG that reads back as these labels.
void write_label_picture(const std::string& path, const Grid<std::uint8_t>& labels,
                         const std::vector<std::string>& names);
Grid<glm::vec3> label_colours(const Grid<std::uint8_t>& labels,
                              const std::vector<std::string>& names);

class CommandOptions;

// The initial noise of a texture, if the user chooses it: --begin, --begin-px.
struct BeginOptions {
  std::string kind;  // white, streaks, discs; empty: the program chooses
  double px = 8.0;   // half length of streaks, radius of discs, 1…256
};
// `meaning`: help text of --begin.
void add_begin_options(CommandOptions& command, BeginOptions& options, const std::string& meaning);

struct TextureBegin {
  TextureSeed seed = TextureSeed::white;
  float px = 0.F;  // 0 of white noise
};
TextureBegin begin_of(const BeginOptions& options);

const char* name_of(TextureSeed seed);
// Describes the noise: "streaks of 12 px", "white, polished".
std::string describe_begin(TextureSeed seed, float px, bool polish);

}  // namespace belvedere::tools
