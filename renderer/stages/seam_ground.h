#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "renderer/paint/composite.h"
#include "renderer/stages/ground_inputs.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

// Synthesis of seams of any shape (Zalesny, Ferrari, Caenen, Van Gool, "Composite Texture
// Synthesis", 2005, section 6): the pixels along a border of two textures are synthesized by a
// model of both, in colours of the two. For pictures side by side statistical/texture_seam.h draws
// the border as well; here it is given, ragged, as left by copying.

// The look of one side of a seam: a picture, and where it shows that texture.
struct SeamSample {
  Grid<Rgb8> picture;
  Grid<std::uint8_t> counts;  // 0: not part of it
};
inline constexpr int seam_sample_px = 128;  // side of a sufficient sample

// A model of two adjoining textures; none if both together have too few pixels to learn from, or a
// single colour.
std::optional<CliqueModel> learn_seam(const SeamSample& one, const SeamSample& other);

// The pixels of a picture that belong to a seam.
struct SeamZone {
  Grid<std::uint8_t> side;  // 1 or 2: one texture or the other; 0: neither, ignored
  Grid<std::uint8_t> hole;  // not 0: to be synthesized; such pixels have a side
};
inline constexpr int seam_half_px = 3;  // synthesized on either side of a border

// The picture with its hole synthesized; nothing else changes. `position` as in fill_among.
Grid<Rgb8> synthesize_seam(const Grid<Rgb8>& picture, const SeamZone& zone,
                           TexturePosition position, const CliqueModel& model, std::uint64_t seed);

// Paint of several paintings on one sheet, with synthesized seams (docs/textures.md): the pixels
// along a seam are made again by a model of the paint on both sides. All in even light
// (composite.h), so that a seam is where paint changes and not where light does; the light of the
// position is applied afterwards, as for all paint.

// Samples that seams are learnt from: paint of each class of each source, exemplars first, then
// texture models; empty where a source has too little of a class.
struct SeamSources {
  std::vector<std::array<SeamSample, land_cover_class_count>> of;
  std::uint64_t seed = 1;
};
// For each class of an exemplar the square of seam_sample_px that contains most of it. To be called
// before the exemplars discard their classes.
SeamSources find_seam_sources(const std::vector<PaintedExemplar>& exemplars,
                              const Residual& residual, std::uint64_t seed);
// Adds the paint of each model for its classes. To be called after the exemplars'.
void add_model_sources(SeamSources& sources, const GroundModels& models, const Residual& residual);

// Models of seams by the paint on their two sides; each is learnt on first use, from the sources
// alone.
class SeamModels {
 public:
  explicit SeamModels(const SeamSources* sources) : sources_(sources) {}
  // The model of the paint of two sources, each as source_of; null where there is too little to
  // learn from.
  const CliqueModel* find(std::uint16_t one, std::uint16_t other);

 private:
  const SeamSample& sample_of(std::uint16_t source) const;

  const SeamSources* sources_;
  std::map<std::pair<std::uint16_t, std::uint16_t>, std::optional<CliqueModel>> models_;
};

// The source of a pixel's paint and the class that it shows.
inline constexpr std::uint16_t no_source = 0xffff;
constexpr std::uint16_t source_of(std::size_t source, LandCoverClass shown) {
  return static_cast<std::uint16_t>(source << 8U | static_cast<unsigned>(shown));
}

// A window of the sheet's paint, before its seams are synthesized.
struct PaintBeforeSeams {
  Grid<glm::vec3> even;        // encoded sRGB, in even light
  Grid<std::uint16_t> source;  // source_of; no_source: no paint
  Grid<float> depth_m;         // surfaces that hide each other have no seam
};
// The synthesized pixels of a tile. `paint` covers the tile and seam_margin_px around it, clipped
// to the sheet, at `window`. A function of these alone: with tiles of one lattice pixels are the
// same in every request.
SeamPaint synthesize_ground_seams(SeamModels& models, const PaintBeforeSeams& paint, PixelRect tile,
                                  PixelRect window, std::uint64_t seed);
inline constexpr int seam_margin_px = 32;

}  // namespace belvedere
