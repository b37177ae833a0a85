#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/progress.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// A finished picture to print.
struct PressPicture {
  std::string file;
  int width = 0;
  int height = 0;
  double dots_per_inch = 0.0;         // 0: the file does not state it
  std::vector<std::uint8_t> profile;  // its own, RGB; empty: sRGB
};

// `path` is a picture, or the folder of a rendered scene: of its panorama.tif, .jxl or .png, the
// first that holds encoded RGB of full size. Error(input) where there is none, or the picture is
// CMYK or linear already.
PressPicture find_press_picture(const std::string& path);

// Difference of a print from its picture, in ΔE2000, each relative to its own white.
struct ProofReport {
  std::string press;  // the profile's own name
  std::uint64_t pixels = 0;
  double outside_share = 0.0;  // share of the pixels with unprintable colours
  double mean_delta_e = 0.0;   // picture to print, with the given intent
  double delta_e_95 = 0.0;     // 95 % of the pixels are within it; in steps of .01
  double highest_delta_e = 0.0;
  InkCoverage ink;
};

// Writes STEM_proof.png, the simulated print, and STEM_outside.png, the picture in grey with
// unprintable colours in red. Row by row, and the same for any number of threads.
// `ink_limit_percent` 0: the profile's limit.
ProofReport write_proof(const PressPicture& picture, const std::vector<std::uint8_t>& press,
                        const ProofParameters& parameters, double ink_limit_percent,
                        const std::string& stem, Progress& progress);

// A colour of a palette and its printed colour.
struct PaletteColour {
  std::string where;     // "forest at 1200 m, tone .34", "haze_far"
  glm::vec3 colour;      // encoded sRGB
  glm::vec3 printed;     // the nearest printable colour, encoded sRGB clamped to 0…1
  double delta_e = 0.0;  // ΔE2000 between the two
};
// Every colour of the palette, in its order: ramps by class and altitude, sky, clouds, haze,
// leaves. A picture's colours lie between them, or beside them through light and air.
std::vector<PaletteColour> print_palette(const Palette& palette,
                                         const std::vector<std::uint8_t>& press);

}  // namespace belvedere
