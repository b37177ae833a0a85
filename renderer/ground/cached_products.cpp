#include "renderer/ground/cached_products.h"

#include <array>
#include <fstream>

#include "base/cache/cache.h"
#include "base/files/program_file.h"
#include "base/instruction_set.h"
#include "renderer/image/provenance.h"
#include "terrain/io/raster.h"

namespace belvedere {
namespace {

constexpr std::array<CachedProductInfo, 10> table = {{
    {CachedProduct::synthetic_terrain, "synthetic terrain", 1},
    {CachedProduct::elevation, "elevation", 1},
    {CachedProduct::land_cover, "land cover by rules", 2},
    {CachedProduct::generalized_ground, "generalized ground", 1},
    {CachedProduct::ground_surroundings, "surroundings of the ground", 1},
    {CachedProduct::example_sheet, "example sheet", 1},
    {CachedProduct::synthesis_plan, "choice of texture", 2},
    {CachedProduct::ground_features, "features of the ground", 2},
    {CachedProduct::river_courses, "rivers of maps", 2},
    {CachedProduct::ground_texture, "texture of the ground", 1},
}};

// Two builds of one version may differ, so the program or module is hashed. Where it cannot be read
// the version is used.
std::string hash_of_program() {
  const std::string& file = program_file();
  return std::ifstream(file).good() ? hash_file(file) : std::string();
}

const CacheKeyText& program_text() {
  static const CacheKeyText text =
      CacheKeyText()
          .add("program", program_version())
          .add("libraries", library_versions())
          .add("instruction set", instruction_set_title(machine_instruction_set()))
          .add("file", hash_of_program());
  return text;
}

}  // namespace

std::span<const CachedProductInfo> cached_products() { return table; }

CacheKey make_cache_key(CachedProduct product, const CacheKeyText& made_from, std::string subject) {
  const CachedProductInfo& info = table[static_cast<std::size_t>(product)];
  const CacheKeyText format = CacheKeyText().add("format", info.format);
  return {std::string(info.name), std::move(subject),
          program_text().str() + format.str() + made_from.str()};
}

void add_transform(CacheKeyText& key, const GeoTransform& transform) {
  const auto& [origin_x, origin_y, cell_x, cell_y] = transform;
  key.add("origin_x", origin_x)
      .add("origin_y", origin_y)
      .add("cell_x", cell_x)
      .add("cell_y", cell_y);
}

std::string subject_of(const LoadedScene& scene) {
  const std::string& title = scene.scene.title;
  return title.empty() || title == scene.name ? scene.name : scene.name + " (" + title + ")";
}

}  // namespace belvedere
