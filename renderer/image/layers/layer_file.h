#pragma once

#include <string>
#include <vector>

#include "renderer/image/layers/layered_sheet.h"

namespace belvedere {

// Formats of layers: "ora", OpenRaster, for GIMP and Krita; "psd", for Photoshop and Affinity (its
// large form, PSB, from 30000 pixels per side or 2 GB on); "exr", OpenEXR in linear light, for
// Nuke, Natron and Blender.
struct LayerFormat {
  std::string extension;
  std::string title;
  std::string file;  // name of the panorama's file
  WriteLayers write;
};
const std::vector<LayerFormat>& layer_formats();
// Error(usage) for an unknown extension.
const LayerFormat& layer_format(const std::string& extension);

// A multi-part OpenEXR file in scene-linear light with primaries of sRGB: "panorama" (R, G, B: the
// composite), then a part with R, G, B, A, premultiplied, for each layer from the bottom up; hidden
// layers have the attribute "hidden".
//
// Paint is blended in encoded sRGB, but compositors blend in linear light. So a layer's opacity is
// unchanged, and its colour is chosen so that the composite up to it is correct: if F is the linear
// composite below and T the required one with this layer, its premultiplied colour is T - (1 - a)
// F, of values already rounded to halves, so that only the last rounding remains. Where paint is
// darker than its ground and half covers it, that is slightly negative, which half floats allow.
// Hidden layers have their own colours.
void write_layered_exr(const std::string& path, const LayeredSheet& sheet, Progress& progress);

}  // namespace belvedere
