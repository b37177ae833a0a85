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

}  // namespace belvedere
