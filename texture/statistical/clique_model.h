#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/masks/label_blur.h"
#include "base/pixel_rect.h"

namespace belvedere {

// A texture as statistics of pairs of pixels (Zalesny, Ferrari, Caenen, Van Gool, "Composite
// Texture Synthesis", 2005): for each of a few *clique types* the distribution of the difference
// between the pixels at head and tail. About a kilobyte, whatever is made from it.

// Colours rotated to the principal axes of the crop they were learnt from, in levels of 8-bit sRGB.
// Bands are uncorrelated; in RGB the same method produces a woven look.
struct BandSpace {
  std::array<float, 3> mean{};  // sRGB, 0…255
  std::array<std::array<std::int16_t, 3>, 3>
      axes;  // axes[band][channel], unit vectors times axis_unit
  std::array<float, 3>
      low{};  // smallest and largest value of each band in the crop, half a level wider
  std::array<float, 3> high{};

  static constexpr float axis_unit = 32767.F;
  float axis(int band, int channel) const {
    return static_cast<float>(
               axes[static_cast<std::size_t>(band)][static_cast<std::size_t>(channel)]) /
           axis_unit;
  }
};

// A pair of pixels with a fixed offset: the head is dx to the right of and dy below the tail. Its
// statistic is the histogram of value(head band at head) - value(tail band at tail). A type without
// offset and with one band is that band's own histogram.
struct CliqueType {
  int level = 0;  // of the pyramid: a pixel there is a mean of 2^level pixels
  int dx = 0;
  int dy = 0;  // ≥ 0
  int head = 0;
  int tail = 0;

  bool single() const { return dx == 0 && dy == 0 && head == tail; }
  bool operator==(const CliqueType&) const = default;
};

inline constexpr int clique_knots = 24;

// A type and the distribution of its differences: the value below which clique_knot_share(k) of
// them lie, for each knot k, as one byte each (mu-law over the type's range), non-decreasing.
struct Clique {
  CliqueType type;
  std::array<std::int8_t, clique_knots> codes{};
};

// Kinds of initial noise: its shape remains visible in the result (clique types cannot describe
// strokes).
enum class TextureSeed : std::uint8_t { white, streaks, discs };

struct CliqueModel {
  int levels = 3;  // coarsest level of the pyramid, 0…3
  BandSpace bands;
  std::vector<Clique> cliques;  // coarsest level first, in the order in which they were added
  TextureSeed seed = TextureSeed::white;
  float seed_px = 0.F;  // half length of streaks, radius of discs, in pixels
  float direction_deg =
      0.F;  // of the crop's strokes, clockwise from horizontal in the picture, 0…180
  float direction_spread = 0.F;  // 0: all in this direction, 1: no preferred direction
  bool sampled =
      false;  // by the published sampler only, from noise and at one level: learn_by_sampling.h
  bool polish = true;  // whether single pixels are sampled at the end: crisp dabs, but flecks in
                       // smooth areas

  // Information about the crop, without effect on what is made.
  std::string crop_hash;  // of its pixels, content_hash.h
  int crop_width = 0;
  int crop_height = 0;
};

// The probability of knot k: denser in the tails.
float clique_knot_share(int k);

// The range of the differences of a type.
struct DifferenceRange {
  float low = 0.F;
  float high = 0.F;
};
DifferenceRange difference_range(const BandSpace& bands, const CliqueType& type);

using CliqueKnots = std::array<float, clique_knots>;
// Codes of knots, made increasing, and back.
std::array<std::int8_t, clique_knots> encode_knots(const BandSpace& bands, const CliqueType& type,
                                                   const CliqueKnots& knots);
CliqueKnots decode_knots(const BandSpace& bands, const Clique& clique);

// The difference below which a share of all lies, and the share below a difference: both linear
// between knots.
float value_at_share(const CliqueKnots& knots, float share);
float share_below(const CliqueKnots& knots, float value);

// Bytes of the model in a file, without the information about the crop.
std::size_t model_bytes(const CliqueModel& model);

// 1 within `px` pixels, along rows and columns, of a pixel that is not 0.
Grid<std::uint8_t> widened(const Grid<std::uint8_t>& mask, int px);

// The rectangle around all pixels that are not 0; empty where none is.
PixelRect box_of(const Grid<std::uint8_t>& mask);

// 1 for pixels within px pixels of a border of two labels, on either side (no_label has none); px =
// 1: those with a neighbour of another label.
Grid<std::uint8_t> near_borders(const Grid<std::uint8_t>& labels, int px);

struct ConfigValue;

// A model as a small text: TOML with the clique types as base64. It reads back to the same bits.
std::string model_text(const CliqueModel& model);

// Error(usage) with file and line for an invalid model: a key that is missing or unknown, an
// unknown version, types that are cut off or impossible. `read_model` also Error(input) if the file
// is missing.
CliqueModel parse_model(const std::string& text, const std::string& name);
CliqueModel read_model(const std::string& path);
// Reads a model from a table within a larger document of that name.
CliqueModel parse_model(const ConfigValue& table, const std::string& name);

}  // namespace belvedere
