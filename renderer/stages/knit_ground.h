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
#include "renderer/stages/model_ground.h"
#include "texture/composite/knit_seam.h"

namespace belvedere {

// Paint of several paintings on one sheet, knitted where it meets (docs/textures.md): the pixels along such a seam are made anew by a model
// of the paint of both sides. All in even light (composite.h), so that a seam is where paint changes and not where light does; the light
// of the place is laid over it afterwards, as over all paint.

// What seams are learnt from: paint of each class of each source, exemplars first, then texture models; empty where a source has too
// little of a class.
struct KnitSources {
  std::vector<std::array<SeamSample, land_cover_class_count>> of;
  std::uint64_t seed = 1;
};
// Of each class of an exemplar the square of seam_sample_px that holds most of it. Before the exemplars forget their classes.
KnitSources find_knit_sources(const std::vector<PaintedExemplar>& exemplars, double residual, std::uint64_t seed);
// Adds what each model makes, for the classes that it paints. After the exemplars'.
void add_model_sources(KnitSources& sources, const GroundModels& models, double residual);

// Models of seams by the paint on their two sides; each is learnt when it is first asked for, from the sources alone.
class SeamModels {
 public:
  explicit SeamModels(const KnitSources* sources) : sources_(sources) {}
  // Of the paint of two sources, each as source_of; null where there is too little to learn from.
  const CliqueModel* find(std::uint16_t one, std::uint16_t other);

 private:
  const SeamSample& sample_of(std::uint16_t source) const;

  const KnitSources* sources_;
  std::map<std::pair<std::uint16_t, std::uint16_t>, std::optional<CliqueModel>> models_;
};

// Where a pixel's paint comes from, and as which class it shows.
inline constexpr std::uint16_t no_source = 0xffff;
constexpr std::uint16_t source_of(std::size_t source, LandCoverClass shown) {
  return static_cast<std::uint16_t>(source << 8U | static_cast<unsigned>(shown));
}

// A window of the sheet's paint, before its seams are knitted.
struct UnknitPaint {
  Grid<glm::vec3> even;        // encoded sRGB, in even light
  Grid<std::uint16_t> source;  // source_of; no_source: no paint
  Grid<float> depth_m;         // surfaces that hide each other have no seam
};
// The knitted pixels of a tile. `paint` is that of the tile and knit_margin_px around it, cut by the sheet, and lies at `window`. A
// function of these alone: with tiles of one lattice pixels are the same whoever asks.
KnitPaint knit_ground(SeamModels& models, const UnknitPaint& paint, PixelRect tile, PixelRect window, std::uint64_t seed);
inline constexpr int knit_margin_px = 32;

}  // namespace belvedere
