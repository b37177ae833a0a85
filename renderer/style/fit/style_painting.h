#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// Value of a mask besides class ids. Pixels of unused_label (255) are ignored.
inline constexpr std::uint8_t far_air_label = 200;  // distant ranges in haze colour

struct CleanMaskParameters {
  double blur_px = 2.0;          // sigma of the blur that removes strokes
  std::size_t min_texels = 600;  // classes with no more are ignored
  int groups = 5;                // clusters of colour in a class
  double different = 0.10;       // of medians of different classes, OKLab with hue × 1.6
  double nearer = 0.5;           // max share of the distance to the own class's median
  double min_kept = 0.3;         // a class that would keep less is used as drawn
};

// Cleans a rough mask (recipe A0): clusters of colour within a class that resemble another, clearly
// different class more than their own become unused_label. Sky and distant haze are kept. `colours`
// is OKLab.
Grid<std::uint8_t> clean_mask(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& drawn,
                              const CleanMaskParameters& parameters = {});

// blur_within_labels (base/masks/label_blur.h) of the three channels.
Grid<glm::vec3> blur_within_classes(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                    double sigma_px);

// A painting prepared for the steps of fitting.
struct StylePainting {
  Grid<glm::vec3> colours;              // OKLab
  Grid<glm::vec3> soft;                 // blurred with sigma 0.8 px within each class
  Grid<std::uint8_t> drawn;             // the mask as given
  Grid<std::uint8_t> clean;             // clean_mask of it
  std::vector<LandCoverClass> classes;  // of the ground, with enough texels
  std::vector<glm::vec3> every;         // a sample of the colours of the whole painting
  std::vector<glm::vec3> ground;        // a sample of the soft colours of ground and distant haze
  double min_lightness = 0.0;           // limits of ramps: about those of the painting
  double max_lightness = 1.0;
};

// `painting` is encoded sRGB. Error(usage) where sizes differ, Error(input) for numbers that are
// not classes, and where no class of the ground has enough texels.
StylePainting prepare_painting(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                               const CleanMaskParameters& parameters = {});

// Colours of one class of the mask, at most `most`: every n-th by rows.
std::vector<glm::vec3> class_texels(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                    LandCoverClass id, std::size_t most);
bool has_class(const StylePainting& painting, LandCoverClass id);

// Common to the steps of fitting a style. Colours are OKLab (L, a, b); sections (A0…B7) are those
// of the recipe in docs/style.md.

using LabRamp = std::array<glm::dvec3, 4>;                       // at ramp_tones
using ClassRamps = std::array<LabRamp, land_cover_class_count>;  // [sky] unused
using ClassFlags = std::array<bool, land_cover_class_count>;

// Quantiles of lightness at which ramp_tones lie in the program's pictures.
inline constexpr std::array<double, 4> ramp_quantiles = {0.03, 0.19, 0.54, 0.97};
// Share of a panorama's ground near each of ramp_tones.
inline constexpr std::array<double, 4> tone_shares = {0.06, 0.30, 0.44, 0.20};
// Share of a typical panorama's ground that each class covers, by id.
inline constexpr std::array<double, land_cover_class_count> area_shares = {
    0.0, 0.02, 0.06, 0.01, 0.34, 0.14, 0.06, 0.18, 0.06, 0.03, 0.08, 0.02, 0.0};

double chroma(const glm::dvec3& lab);
// Mean weighted with tone_shares; of all classes, also with area_shares.
double mean_lightness(const LabRamp& ramp);
double ground_lightness(const ClassRamps& ramps);

// Colours outside sRGB are clamped.
ToneRamp encoded_ramp(const LabRamp& ramp);
// The ramps of a palette; of classes with ramps at several altitudes the middle one.
ClassRamps palette_ramps(const Palette& palette);

constexpr std::size_t index_of(LandCoverClass id) { return static_cast<std::size_t>(id); }
// The name of a class in words, such as "alpine grass".
std::string class_words(LandCoverClass id);

}  // namespace belvedere
