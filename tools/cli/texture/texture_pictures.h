#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
#include "base/progress.h"
#include "base/text/json.h"
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
// Throws what write_texture would for the name, before any work.
void check_texture_name(const std::string& path);

// Adds the five distances to the JSON output.
Json with_figures(Json object, const TextureFigures& figures);

}  // namespace belvedere::tools
