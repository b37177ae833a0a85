#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "texture/composite/label_map.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

// A texture of textures (Zalesny et al. 2005): a map of labels, a texture for each label, and one
// for what lies along their borders.
struct CompositeLabel {
  std::string name;  // its key in label pictures: "#0000ff", or a number
  CliqueModel model;
};

struct CompositeModel {
  LabelMapModel map;
  std::vector<CompositeLabel> labels;
  std::optional<CliqueModel> transition;  // none if the crop's borders are too short to learn from

  // Information about the crop, without effect on what is made.
  std::string crop_hash;
};

// A model as a text: TOML with the texture models in tables of their own. It reads back to the same
// bits.
std::string composite_text(const CompositeModel& model);

// Error(usage) with file and line for an invalid composite: keys missing or unknown, another
// version, tables that are cut off, are not shares, or have another number of labels.
// `read_composite` also Error(input) if the file is missing.
CompositeModel parse_composite(const std::string& text, const std::string& name);
CompositeModel read_composite(const std::string& path);

// Fills a map of labels, generated (make_label_map.h) or drawn: each label by its own model under
// its mask, then 3 pixels on either side of all borders again by the transition model, in colours
// of the two sides. Error(limit) over max_texture_pixels. Error(bug) for labels that are not in the
// model.
Grid<Rgb8> make_composite(const CompositeModel& model, const Grid<std::uint8_t>& labels,
                          const TextureParameters& parameters,
                          Progress& progress = silent_progress());
inline constexpr int remade_border_px = 3;

// Where `zone` is not 0, replaces colours that none of the labels within `reach` pixels contains by
// the nearest colour that one of them contains. A transition learnt from all borders of a crop
// together mixes colours that no single border shows.
void snap_colours(Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                  const Grid<std::uint8_t>& zone, int reach);

// Windows of a composite over a map of any size: each label by its unbounded texture
// (make_texture.h), with borders repainted in fixed tiles. Any window has the same pixels as the
// whole, in any order, because a tile depends only on the labels in and around it. The whole
// differs from the picture of make_composite, which fits each texture to its own pixels.

// Tables of each label's texture, some 13 MB each.
struct CompositeRecord {
  std::vector<TextureRecord> labels;
};
CompositeRecord record_composite(const CompositeModel& model, const TextureParameters& parameters,
                                 Progress& progress = silent_progress());

// `labels`: the whole map, one byte per pixel, or a part of an unbounded one that begins at `at`, a
// multiple of 2^levels, and goes composite_margin_px beyond the tiles of the window, which is
// inside it. Error(limit) over max_texture_pixels, Error(bug) for labels that are not in the model.
// Progress: tiles.
Grid<Rgb8> make_composite_window(const CompositeModel& model, const CompositeRecord& record,
                                 const Grid<std::uint8_t>& labels, PixelRect window,
                                 const TextureParameters& parameters,
                                 Progress& progress = silent_progress(), TexturePosition at = {});
inline constexpr int composite_margin_px = 48;  // that a tile reads around itself

}  // namespace belvedere
