#include "renderer/stages/ground_inputs.h"

#include <cmath>
#include <cstddef>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/stages/sheet_style.h"
#include "renderer/world/scene_style.h"

namespace belvedere {

GroundInputs make_unlit_inputs(const World& world, const SheetView& view, const Palette& palette,
                               const Run& run) {
  return {.world = &world,
          .palette = &palette,
          .run = run,
          .camera = &view.camera,
          .size_px = view.camera.size(),
          .pixels_per_unit = view.pixels_per_unit,
          .horizon_px = view.horizon_px,
          .has_mist = !world.mist.empty(),
          .rock = to_rock_parameters(world, palette, view),
          .tone = to_tone_parameters(world, palette, view),
          .base = to_base_parameters(world, palette, view),
          .strokes = to_stroke_parameters(world, palette, view)};
}

GroundInputs estimate_ground_inputs(const Scene& scene, double pixels_per_unit,
                                    const Style* style) {
  GroundInputs inputs{.size_px = {scene.output.width, scene.output.height},
                      .pixels_per_unit = pixels_per_unit};
  inputs.tone.pixels_per_unit = inputs.base.pixels_per_unit = inputs.strokes.pixels_per_unit =
      pixels_per_unit;
  inputs.rock.light.pixels_per_unit = pixels_per_unit;
  inputs.rock.kind = inputs.base.rock = &find_rock_kind(scene.land_cover.rock);
  if (style != nullptr)
    inputs.style = std::make_shared<const SheetStyle>(
        SheetStyle{*style, to_style_parameters(scene, pixels_per_unit, inputs.size_px)});
  return inputs;
}

namespace {

using B = GuidanceBuffers;

constexpr double ragged_tone =
    .05;  // deviation of the noise that frays the border of light and shade, in tones
constexpr double ragged_px = 2.5;  // and its width

// Direction of strokes at a position of the sheet: downhill, or level on flat ground, on fields and
// on water.
DirectionField scene_directions(const GuidanceBuffers& guidance, PixelRect window) {
  return [&guidance, window](double x, double y) {
    const int column =
        std::clamp(static_cast<int>(std::floor(x)) - window.x0, 0, window.width() - 1);
    const int row = std::clamp(static_cast<int>(std::floor(y)) - window.y0, 0, window.height() - 1);
    const LandCoverClass id = guidance.land_cover(column, row);
    const glm::vec2 down = guidance.fall_line(column, row);
    const bool level = id == LandCoverClass::water || has_trait(id, ClassTrait::level) ||
                       (down.x == 0.F && down.y == 0.F);
    return level ? glm::vec2(1.F, 0.F) : down;
  };
}

// Whether a pixel of the sheet gets the paint of lit ground. Light and shade meet along a frayed
// border, as two paints do, not along a line of equal tone.
bool is_lit(float tone, int x, int y) {
  constexpr std::uint64_t seed = stream_seed(1, Stream::statistical_directions, 20);
  return tone + ragged_tone * gaussian_noise(seed, x, y, ragged_px) >= middle_tone;
}

// One model's pixels of a tile, those that `paint.made` marks with `mark`, within `box` (of the
// sheet).
void paint_model(const GroundModel& of, std::uint8_t mark, PixelRect box, PixelRect tile,
                 const DirectionField& directions, ModelPaint& paint) {
  TextureParameters parameters;
  parameters.seed = of.seed;
  parameters.direction = directions;
  const TexturePiece piece =
      make_piece(of.model, of.record, grown(box, endless_margin_px), parameters);
  for (int c = 0; c < 3; ++c) {
    Grid<float> channel(piece.picture.width(), piece.picture.height());
    for (std::size_t i = 0; i < channel.size(); ++i)
      channel[i] = static_cast<float>(piece.picture[i][static_cast<std::size_t>(c)]) / 255.F;
    const Grid<float> light = gaussian_blur(channel, of.light_px);
    parallel_rows(box.height(), [&](int row) {
      const int y = box.y0 + row;
      for (int x = box.x0; x < box.x1; ++x) {
        const std::size_t i = paint.made.index(x - tile.x0, y - tile.y0);
        if (paint.made[i] != mark) continue;
        paint.texel[i][c] = channel(x - piece.piece.x0, y - piece.piece.y0);
        paint.base[i][c] = light(x - piece.piece.x0, y - piece.piece.y0);
      }
    });
  }
}

}  // namespace

int model_margin_px(const GroundModels& models) {
  // Streaks begin this far outside a piece; two more for the steps that leave a pixel.
  float streak_px = 0.F;
  for (const GroundModel& of : models.models)
    if (of.model.seed == TextureSeed::streaks) streak_px = std::max(streak_px, of.model.seed_px);
  return endless_margin_px + (1 << 4) + static_cast<int>(streak_px) + 2;
}

ModelPaint make_model_paint(const GroundModels& models, PixelRect tile,
                            const Grid<LandCoverClass>& shown, const GuidanceBuffers& guidance,
                            PixelRect window, const Grid<float>& tone) {
  require_channels(guidance, {&B::depth_m, &B::land_cover, &B::fall_line}, "ground from models");
  if (models.by_light() && (tone.width() != tile.width() || tone.height() != tile.height()))
    throw Error(ErrorKind::bug, "ground from models", "models by light need the tone of the tile");
  ModelPaint paint{Grid<std::uint8_t>(tile.width(), tile.height()),
                   Grid<glm::vec3>(tile.width(), tile.height()),
                   Grid<glm::vec3>(tile.width(), tile.height())};
  std::vector<PixelRect> boxes(models.models.size(), {tile.x1, tile.y1, tile.x0, tile.y0});
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const auto id = static_cast<std::size_t>(shown(x - tile.x0, y - tile.y0));
      const bool shaded =
          models.lit[id] != models.shaded[id] && !is_lit(tone(x - tile.x0, y - tile.y0), x, y);
      const std::uint8_t model = shaded ? models.shaded[id] : models.lit[id];
      if (model == GroundModels::none || std::isinf(guidance.depth_m(x - window.x0, y - window.y0)))
        continue;
      paint.made(x - tile.x0, y - tile.y0) = static_cast<std::uint8_t>(model + 1);
      PixelRect& box = boxes[model];
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
             std::max(box.y1, y + 1)};
    }
  const DirectionField directions = scene_directions(guidance, window);
  for (std::size_t m = 0; m < models.models.size(); ++m)
    if (!boxes[m].empty())
      paint_model(models.models[m], static_cast<std::uint8_t>(m + 1), boxes[m], tile, directions,
                  paint);
  return paint;
}

void hide_modelled(GuideStack& guides, const GroundModels& models) {
  if (!models.any()) return;
  for (std::uint8_t& label : guides.label)
    if (label < models.lit.size() && models.lit[label] != GroundModels::none) label = unused_label;
}

}  // namespace belvedere
