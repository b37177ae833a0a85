#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/image/layers/layered_sheet.h"
#include "renderer/mist/mist_paint.h"
#include "texture/strokes/paint_parts.h"

namespace belvedere {

// Sources of the layers, one grid and one pipeline product each: the canvas before its strokes;
// mist; paint by parts, from the bottom up; edges; and masks (shares of cast shadow, of light, of
// air, and the class).
inline constexpr std::size_t layer_plane_count = paint_part_count + 4;
struct PictureLayers {
  std::array<Grid<LayerPixel>, layer_plane_count> planes;
};
// Memory of a picture's layers while they are cut: sums of paint by parts, the canvas before its
// strokes, the planes.
inline constexpr double layer_bytes_per_pixel =
    static_cast<double>(paint_part_count * sizeof(glm::vec4) + sizeof(glm::vec3) +
                        layer_plane_count * sizeof(LayerPixel));
// The same where mist thins features: sums of paint before them.
inline constexpr double thinned_bytes_per_pixel =
    static_cast<double>(paint_part_count * sizeof(glm::vec4));
// Names of the products.
const std::array<std::string_view, layer_plane_count>& layer_plane_names();

// The scenes that have a layer.
enum class LayerOf : std::uint8_t { all, mist, features };

// A layer of a finished picture, for image editors.
struct PictureLayer {
  std::string name;       // of its file in an archive
  std::string title;      // shown to users
  bool mask = false;      // hidden: its opacity is a selection, its colour identifies it
  std::size_t plane = 0;  // index in PictureLayers
  std::vector<LandCoverClass> where = {};  // of the canvas, only these classes; empty: all of it
  int share = -1;         // of a mask: index of the share; -1: the classes of `where`
  std::uint32_t rgb = 0;  // of a mask
  LayerOf of = LayerOf::all;
};
// All layers, from the bottom up.
const std::vector<PictureLayer>& picture_layers();
// The pixels of a layer, from its plane and from that of the masks (`about`).
Grid<LayerPixel> make_layer(const PictureLayer& layer, const Grid<LayerPixel>& plane,
                            const Grid<LayerPixel>& about);
inline constexpr std::size_t about_plane = layer_plane_count - 1;

// Splits a finished picture into layers that, composited in normal mode in encoded sRGB, reproduce
// it within `flatten_steps` of 65535. `bare`: the canvas before its strokes and `mist` over it
// (empty grids: none), `rect` of the pixels that `parts` holds; guidance has depth, land cover,
// shadow and tone; all of one size but `parts`. What normal layers cannot express, softened depth
// edges and colours clamped to 0…1, becomes the top layer.
PictureLayers cut_layers(const Grid<glm::vec3>& bare, const MistPaint& mist,
                         const PaintParts& parts, PixelRect rect, const GuidanceBuffers& guidance,
                         const Grid<float>& haze, const Grid<glm::vec3>& finished);
inline constexpr double flatten_steps = 4.0;

// A finished picture as a layer.
Grid<LayerPixel> opaque_pixels(const Grid<glm::vec3>& finished);

// Composites a layer's pixel over a colour 0…1, as image editors do.
void lay_over(glm::dvec3& below, const LayerPixel& above);

}  // namespace belvedere
