#include "renderer/world/ground_texture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "base/grid.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/pixel_rect.h"
#include "base/text/parse_number.h"
#include "renderer/ground/cached_products.h"

namespace belvedere {

void each_field(auto& bytes, FieldsOf<Raster<GroundColour>> auto& raster) {
  auto& [cells, transform, crs] = raster;
  bytes(cells, transform, crs);
}

namespace {

constexpr double max_texels = 1 << 30;
constexpr double max_lattice = 1 << 28;  // from the origin of the CRS, in texels
// Of the polish, which takes most of the time: dabs on the ground are seen from afar.
constexpr int ground_sweeps = 8;
constexpr std::uint8_t nobody = 255;  // the label of classes without one

// The texels that cover a frame; rows count southwards.
PixelRect texels_of(const RasterFrame& frame, double texel_m) {
  const GeoTransform& t = frame.transform;
  const std::array<double, 4> sides = {std::floor(t.origin_x / texel_m),
                                       std::floor(-t.origin_y / texel_m),
                                       std::ceil((t.origin_x + frame.width * t.cell_x) / texel_m),
                                       std::ceil((frame.height * t.cell_y - t.origin_y) / texel_m)};
  const bool far = std::any_of(sides.begin(), sides.end(),
                               [](double side) { return !(std::abs(side) < max_lattice); });
  const double across = sides[2] - sides[0];
  const double down = sides[3] - sides[1];
  if (far || across * down > max_texels)
    throw Error(ErrorKind::limit, "the ground's texture",
                fmt::format("{:.0f} × {:.0f} texels of {} m", across, down, texel_m),
                fmt::format("at most {:.0f}; larger ones", max_texels));
  return {static_cast<int>(sides[0]), static_cast<int>(sides[1]), static_cast<int>(sides[2]),
          static_cast<int>(sides[3])};
}

}  // namespace

std::vector<LandCoverClass> classes_of_labels(const CompositeModel& composite,
                                              const std::string& path) {
  std::vector<LandCoverClass> out;
  for (const CompositeLabel& label : composite.labels) {
    const int number = parse_number<int>(label.name).value_or(-1);
    if (number < 0 || number >= land_cover_class_count)
      throw Error(
          ErrorKind::usage, path, "a composite with the label " + label.name,
          "labels that are class numbers: run `belvedere composite learn` with a mask of classes");
    out.push_back(static_cast<LandCoverClass>(number));
  }
  return out;
}

Raster<GroundColour> paint_ground_texture(const CompositeModel& composite,
                                          const std::vector<LandCoverClass>& classes,
                                          const LandCover& cover, const RasterFrame& frame,
                                          const GroundTextureParameters& parameters,
                                          Progress& progress) {
  const double texel_m = parameters.texel_m;
  const PixelRect all = texels_of(frame, texel_m);
  check_memory(fmt::format("a texture of {} × {} texels on the ground", all.width(), all.height()),
               static_cast<double>(sizeof(GroundColour)) * all.width() * all.height());
  std::array<std::uint8_t, land_cover_class_count> label_of{};
  label_of.fill(nobody);
  for (std::size_t k = 0; k < classes.size(); ++k)
    label_of[static_cast<std::size_t>(classes[k])] = static_cast<std::uint8_t>(k);

  const PixelRect tiles{tile_below(all.x0), tile_below(all.y0), tile_below(all.x1 - 1) + 1,
                        tile_below(all.y1 - 1) + 1};
  progress.begin("painting the ground from a texture",
                 static_cast<double>(tiles.width()) * tiles.height());
  const CompositeRecord record = record_composite(composite, parameters.make);
  Raster<GroundColour> out{Grid<GroundColour>(all.width(), all.height(), GroundColour(0)),
                           {all.x0 * texel_m, -all.y0 * texel_m, texel_m, texel_m},
                           frame.crs};
  for (int ty = tiles.y0; ty < tiles.y1; ++ty)
    for (int tx = tiles.x0; tx < tiles.x1; ++tx) {
      const PixelRect tile{tx * endless_tile_px, ty * endless_tile_px, (tx + 1) * endless_tile_px,
                           (ty + 1) * endless_tile_px};
      // Labels of the whole tile and its margin, also beyond the frame: the tile depends on all.
      const PixelRect around = grown(tile, composite_margin_px);
      Grid<std::uint8_t> labels(around.width(), around.height());
      parallel_rows(labels.height(), [&](int y) {
        for (int x = 0; x < labels.width(); ++x)
          labels(x, y) = label_of[static_cast<std::size_t>(
              cover.cell_at((around.x0 + x + 0.5) * texel_m, -(around.y0 + y + 0.5) * texel_m))];
      });
      progress.advance(1.0);
      if (std::all_of(labels.begin(), labels.end(), [](std::uint8_t l) { return l == nobody; }))
        continue;
      // Where nobody paints, any label does, and its texels are not used.
      Grid<std::uint8_t> painted = labels;
      std::replace(painted.begin(), painted.end(), nobody, std::uint8_t{0});
      const PixelRect part = intersection(tile, all);
      const Grid<Rgb8> made =
          make_composite_window(composite, record, painted, part, parameters.make,
                                silent_progress(), {around.x0, around.y0});
      for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x) {
          const Rgb8& c = made(x - part.x0, y - part.y0);
          if (labels(x - around.x0, y - around.y0) != nobody)
            out.cells(x - all.x0, y - all.y0) = GroundColour(c[0], c[1], c[2], 255);
        }
    }
  return out;
}

Raster<GroundColour> make_scene_texture(const LoadedScene& loaded, const LandCover& cover,
                                        const Dem& dem, Progress& progress, const Cache& cache) {
  const SceneLandCover& settings = loaded.scene.land_cover;
  const std::string file = find_scene_file(loaded, settings.texture);
  const CompositeModel composite = read_composite(file);
  const std::vector<LandCoverClass> classes = classes_of_labels(composite, file);
  const RasterFrame frame{dem.transform, dem.width(), dem.height(), dem.crs};
  GroundTextureParameters parameters;
  parameters.texel_m = settings.texture_m > 0.0 ? settings.texture_m : dem.cell_m();
  parameters.make.seed = loaded.scene.seed;
  parameters.make.sweeps = ground_sweeps;
  const auto key = [&] {
    CacheKeyText text;
    text.add("composite", composite_text(composite))
        .add("texel_m", parameters.texel_m)
        .add("seed", parameters.make.seed)
        .add("sweeps", parameters.make.sweeps)
        .add("classes", cover.classes.cells)
        .add("width", frame.width)
        .add("height", frame.height)
        .add("crs", frame.crs);
    for (const GeoTransform& t : {cover.classes.transform, frame.transform}) add_transform(text, t);
    return make_cache_key(CachedProduct::ground_texture, text, subject_of(loaded));
  };
  return cached<Raster<GroundColour>>(cache, key, progress, [&](Progress& watcher) {
    return paint_ground_texture(composite, classes, cover, frame, parameters, watcher);
  });
}

}  // namespace belvedere
