#include "renderer/image/layers/layer_file.h"

#include <fmt/core.h>

#include "base/error.h"
#include "renderer/image/exr/layered_exr.h"
#include "renderer/image/layers/ora_file.h"
#include "renderer/image/layers/psd_file.h"

namespace belvedere {

const std::vector<LayerFormat>& layer_formats() {
  static const std::vector<LayerFormat> all = {
      {"ora", "OpenRaster", "panorama.ora", write_ora},
      {"psd", "Photoshop", "panorama.psd", write_psd},
      {"exr", "OpenEXR", "panorama_layers.exr", write_layered_exr}};
  return all;
}

const LayerFormat& layer_format(const std::string& extension) {
  std::string known;
  for (const LayerFormat& format : layer_formats()) {
    if (format.extension == extension) return format;
    known += (known.empty() ? "" : ", ") + format.extension;
  }
  throw Error(ErrorKind::usage, "format of layers", fmt::format("\"{}\"", extension), known);
}

}  // namespace belvedere
