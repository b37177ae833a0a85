#include "renderer/pipeline/scene_lock_run.h"

#include <algorithm>
#include <cmath>

#include "renderer/pipeline/pipeline.h"

namespace belvedere {

std::vector<std::string> product_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const std::string& extension : scene.output.formats)
    names.push_back("panorama." + extension);
  names.emplace_back("guidance.exr");
  return names;
}

LoadedScene at_width(const LoadedScene& scene, int width_px) {
  constexpr int min_px = 16;  // limit of a scene
  LoadedScene out = scene;
  const double scale = static_cast<double>(width_px) / scene.scene.output.width;
  out.scene.output.width = width_px;
  out.scene.output.height =
      std::max(min_px, static_cast<int>(std::lround(scene.scene.output.height * scale)));
  return out;
}

std::vector<LockedProduct> render_and_hash(const LoadedScene& scene, const std::string& out_folder,
                                           const Run& run, bool replace) {
  SheetRequest request;
  request.replace = replace;
  render(scene, out_folder, run, request);
  std::vector<LockedProduct> products;
  for (const std::string& name : product_names(scene.scene))
    products.push_back({.file = name, .channels = hash_picture(out_folder + "/" + name).channels});
  std::sort(products.begin(), products.end(),
            [](const LockedProduct& a, const LockedProduct& b) { return a.file < b.file; });
  return products;
}

}  // namespace belvedere
