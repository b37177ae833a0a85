#include "renderer/exemplar/example_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>
#include <variant>

#include "base/error.h"
#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/random.h"
#include "renderer/exemplar/available_texels.h"
#include "renderer/exemplar/uncertain_places.h"
#include "renderer/ground/cached_products.h"
#include "renderer/image/srgb.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"
#include "renderer/world/scene_season.h"
#include "terrain/shape/hydrology.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {

ExamplePainting paint_example(const World& world, const Palette& palette, LitPicture picture,
                              const ExampleLayers& layers, Progress& progress) {
  const StrokeParameters strokes = to_stroke_parameters(world, palette);
  const SheetWindow whole{.to_copy_from = true};
  ExamplePainting example;
  Painting ground_layer = paint_strokes(
      picture.base.colour, picture.guidance, picture.base,
      {.sky = layers.sky, .ground = true, .accents = true, .breaks = false, .upright = false},
      strokes, progress, whole);
  example.ground_layer = std::move(ground_layer.picture);
  picture.guidance.ground_from = std::move(ground_layer.sources);
  if (layers.painting) {
    Painting painting = paint_strokes(picture.base.colour, picture.guidance, picture.base,
                                      {.sky = layers.sky}, strokes, progress, whole);
    example.painting = blend_edges(painting.picture, picture.guidance);
    picture.guidance.painted_class = picture.guidance.land_cover;
    for (std::size_t i = 0; i < painting.sources.size(); ++i)
      picture.guidance.painted_class[i] = picture.guidance.land_cover[painting.sources[i]];
    picture.guidance.painted_from = std::move(painting.sources);
    picture.guidance.stroke = std::move(painting.strokes);
  }
  example.guidance = std::move(picture.guidance);
  return example;
}

PaintedClasses classes_of_paint(const GuidanceBuffers& guidance, const Grid<std::uint32_t>& from) {
  return find_painted_classes(from, guidance, encode_srgb(guidance.base));
}

namespace {

const glm::vec3 paper{0.957F, 0.937F, 0.886F};  // encoded sRGB

// An example sheet is reported as one stage, not sixteen times ten, and without notes about its
// panels.
class OneStage : public Progress {
 public:
  explicit OneStage(Progress& watcher) : watcher_(watcher) {}
  void advance(double) override { watcher_.advance(0.0); }

 private:
  Progress& watcher_;
};

// Value of bare paper in a channel.
glm::vec3 paper_value(const GuidanceChannel& channel) {
  if (channel.member == GuidanceMember(&GuidanceBuffers::base))
    return {static_cast<float>(srgb_decoded(static_cast<double>(paper.x))),
            static_cast<float>(srgb_decoded(static_cast<double>(paper.y))),
            static_cast<float>(srgb_decoded(static_cast<double>(paper.z)))};
  return channel.paper.value_or(channel.sky);
}

// Converts pixel indices in the panel to indices in the example sheet; bare paper refers to itself.
void insert_indices(Grid<std::uint32_t>& whole, const Grid<std::uint32_t>& part,
                    glm::ivec2 row_size, int x0, int y0, int row_y0) {
  const auto width = static_cast<std::uint32_t>(row_size.x);
  if (whole.empty()) {
    whole = Grid<std::uint32_t>(row_size.x, row_size.y);
    for (std::size_t i = 0; i < whole.size(); ++i)
      whole[i] = static_cast<std::uint32_t>(row_y0) * width + static_cast<std::uint32_t>(i);
  }
  const auto part_width = static_cast<std::uint32_t>(part.width());
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x) {
      const std::uint32_t index = part(x, y);
      whole(x0 + x, y0 + y) =
          (static_cast<std::uint32_t>(row_y0 + y0) + index / part_width) * width +
          static_cast<std::uint32_t>(x0) + index % part_width;
    }
}

void insert_channel(const GuidanceChannel& channel, GuidanceBuffers& row,
                    const GuidanceBuffers& panel, glm::ivec2 row_size, int x0, int y0, int row_y0) {
  std::visit(
      [&](auto member) {
        const auto& part = panel.*member;
        auto& whole = row.*member;
        if (part.empty()) return;
        if constexpr (std::is_same_v<std::decay_t<decltype(part)>, Grid<std::uint32_t>>) {
          if (channel.kind == ChannelKind::pixel_index)
            return insert_indices(whole, part, row_size, x0, y0, row_y0);
        }
        if (whole.empty()) fill_channel(row, channel, row_size.x, row_size.y, paper_value(channel));
        copy_part(whole, part, x0, y0);
      },
      channel.member);
}

void insert_panel(ExamplePainting& row, ExamplePainting panel, int x0, int y0, int row_y0) {
  const glm::dvec3 shift = panel.guidance.origin_m - row.guidance.origin_m;
  for (glm::vec3& position : panel.guidance.position_m) position += glm::vec3(shift);
  const glm::ivec2 row_size{row.ground_layer.width(), row.ground_layer.height()};
  for (const GuidanceChannel& channel : guidance_channels())
    insert_channel(channel, row.guidance, panel.guidance, row_size, x0, y0, row_y0);
  copy_part(row.ground_layer, panel.ground_layer, x0, y0);
  if (!panel.painting.empty()) {
    if (row.painting.empty())
      row.painting = Grid<glm::vec3>(row.ground_layer.width(), row.ground_layer.height(), paper);
    copy_part(row.painting, panel.painting, x0, y0);
  }
}

}  // namespace

struct ExampleSheetPainter::State {
  ExampleSheetPlan plan;
  ExampleSheetHand hand;
  struct Terrain {
    std::shared_ptr<const Dem> dem;
    std::unique_ptr<Catchments> catchments;  // computed once for all panels
  };
  std::map<std::string, Terrain> terrains;
  std::map<std::string, std::shared_ptr<const LandCover>> covers;
  std::uint32_t strokes = 0;  // laid so far on the example sheet
  std::string instruction_set;

  static std::string name_of_terrain(const LoadedScene& loaded) {
    const SyntheticParameters& synthetic = loaded.scene.terrain.synthetic.value();
    return fmt::format("{} {} {} {} {} {}", synthetic.width, synthetic.height, synthetic.cell_m,
                       synthetic.lowest_m, synthetic.highest_m, synthetic.seed);
  }

  ExamplePainting paint_panel(int panel, const ExampleLayers& layers, const Run& run) {
    Progress& progress = run.progress;
    LoadedScene loaded = panel_scene(plan, panel, hand.palette.winter);
    if (hand.light) loaded.scene.light = *hand.light;
    const std::string name = name_of_terrain(loaded);
    auto& [dem, catchments] = terrains[name];
    if (dem == nullptr) {
      dem = std::make_shared<const Dem>(make_scene_dem(loaded, progress, run.cache));
      catchments = std::make_unique<Catchments>(*dem);
    }
    std::string rules = name + " " + loaded.scene.land_cover.rules;
    for (const auto& [key, value] : loaded.scene.land_cover.settings)
      rules += fmt::format(" {}={}", key, value);
    auto cover = covers.find(rules);
    if (cover == covers.end())
      cover = covers
                  .emplace(rules, std::make_shared<const LandCover>(make_scene_land_cover(
                                      loaded, *dem, progress, run.cache, catchments.get())))
                  .first;

    // No two panels have strokes at the same positions. Files hold at most 53 bits of a seed.
    loaded.scene.seed =
        stream_seed(plan.seed, Stream::sheet_panels, static_cast<std::uint64_t>(panel)) >> 11;
    const World world =
        make_world(loaded, progress, no_cache(),
                   {dem, cover->second, std::make_unique<Catchments>(*dem, catchments->km2())});
    instruction_set = world.tracer.description();
    const PixelRect whole{0, 0, loaded.scene.output.width, loaded.scene.output.height};
    ExamplePainting painted = paint_example(
        world, hand.palette, make_lit_picture(world, hand.palette, whole, run), layers, progress);
    std::uint32_t max = 0;
    for (std::uint32_t& stroke : painted.guidance.stroke) {
      max = std::max(max, stroke);
      if (stroke > 0) stroke += strokes;
    }
    strokes += max;
    return painted;
  }
};

ExampleSheetPainter::ExampleSheetPainter(ExampleSheetPlan plan, ExampleSheetHand hand)
    : state_(std::make_unique<State>()) {
  state_->plan = std::move(plan);
  state_->hand = std::move(hand);
}
ExampleSheetPainter::~ExampleSheetPainter() = default;
ExampleSheetPainter::ExampleSheetPainter(ExampleSheetPainter&&) noexcept = default;

const ExampleSheetPlan& ExampleSheetPainter::plan() const { return state_->plan; }

const std::string& ExampleSheetPainter::instruction_set() const { return state_->instruction_set; }

int ExampleSheetPainter::rows() const {
  return static_cast<int>(state_->plan.panels.size()) / state_->plan.columns;
}

std::pair<int, int> ExampleSheetPainter::row_span(int row) const {
  const PixelRect cell = panel_cell(state_->plan, row * state_->plan.columns);
  return {cell.y0, cell.y1};
}

ExamplePainting ExampleSheetPainter::paint_row(int row, const ExampleLayers& layers,
                                               const Run& run) {
  const ExampleSheetPlan& plan = state_->plan;
  const auto [y0, y1] = row_span(row);
  ExamplePainting whole;
  whole.ground_layer = Grid<glm::vec3>(plan.width, y1 - y0, paper);
  OneStage watcher(run.progress);
  const Run quiet{run.threads, run.memory_bytes, run.tile_px, watcher, run.cache};
  for (int column = 0; column < plan.columns; ++column) {
    const int panel = row * plan.columns + column;
    const PixelRect rect = panel_rect(plan, panel);
    insert_panel(whole, state_->paint_panel(panel, layers, quiet), rect.x0, rect.y0 - y0, y0);
    run.progress.advance(1.0);
  }
  return whole;
}

namespace {

ExampleSheetPlan plan_for(const SceneExemplar& settings, const Scene& scene, const View& view) {
  ExampleSheetPlan plan = built_in_example_sheet_plan();
  const glm::ivec2 size = example_sheet_size(settings, scene.output);
  plan.width = size.x;
  plan.height = size.y;
  plan.seed = settings.seed;
  plan.dots_per_inch = 50.8 * scene.pixels_per_unit();  // strokes of the same size as the picture's
  // In steps, as the palette, so that scenes of one season and size share a sheet.
  constexpr double step_deg = 15.0;
  const double light_from_deg = view.sun.azimuth_deg - view.camera.azimuth_deg;
  plan.light_from_deg = step_deg * std::round(std::remainder(light_from_deg, 360.0) / step_deg);
  return plan;
}

// The palette of a place at the nearest of some altitudes: paint is copied with its difference to
// the colour under it, so these altitudes need not be the picture's.
Palette palette_in_steps(const Palette& of_place) {
  constexpr double step_m = 50.0;
  const auto nearest = [](double altitude_m) { return step_m * std::round(altitude_m / step_m); };
  Palette palette =
      palette_at_other_altitudes(of_place, nearest(of_place.treeline_m) - of_place.treeline_m);
  palette.treeline_m = nearest(of_place.treeline_m);
  for (ClassPalette& ramps : palette.classes)  // without the rounding of two moves
    for (ClassPalette::Stop& stop : ramps.stops)
      stop.altitude_m = std::round(stop.altitude_m * 100.0) / 100.0;
  if (std::isfinite(palette.lakes_freeze_from_m))
    palette.lakes_freeze_from_m = nearest(palette.lakes_freeze_from_m);
  return palette;
}

// The painted sheet, before it is prepared for synthesis.
struct SheetPaint {
  Grid<glm::vec3> picture;
  Grid<glm::vec3> base;
  GuideStack guides;
};

SheetPaint paint_sheet(const ExampleSheetPlan& plan, const ExampleSheetHand& hand,
                       Progress& progress, const Cache& cache) {
  ExampleSheetPainter painter(plan, hand);
  progress.begin("painting the example sheet", static_cast<double>(plan.panels.size()));
  SheetPaint sheet;
  GuideStack& guides = sheet.guides;
  sheet.picture = sheet.base = Grid<glm::vec3>(plan.width, plan.height);
  guides.label = Grid<std::uint8_t>(plan.width, plan.height);
  for (int row = 0; row < painter.rows(); ++row) {
    const auto [y0, y1] = painter.row_span(row);
    ExamplePainting part = painter.paint_row(row, {.painting = false, .sky = false},
                                             {.progress = progress, .cache = cache});
    // classes_of_paint needs indices in the part.
    const auto first = static_cast<std::uint32_t>(y0) * static_cast<std::uint32_t>(plan.width);
    for (std::uint32_t& from : part.guidance.ground_from) from -= first;
    const PaintedClasses classes = classes_of_paint(part.guidance, part.guidance.ground_from);
    const GuideStack of_part = make_guide_stack(part.guidance, classes.land_cover);
    copy_part(sheet.picture, part.ground_layer, 0, y0);
    copy_part(sheet.base, classes.base, 0, y0);
    copy_part(guides.label, of_part.label, 0, y0);
    if (guides.guides.empty())
      for (const Guide& guide : of_part.guides)
        guides.guides.push_back({guide.name, Grid<std::uint8_t>(plan.width, plan.height)});
    for (std::size_t g = 0; g < of_part.guides.size(); ++g)
      copy_part(guides.guides[g].values, of_part.guides[g].values, 0, y0);
  }
  return sheet;
}

}  // namespace

void each_field(auto& bytes, FieldsOf<Guide> auto& guide) {
  auto& [name, values] = guide;
  bytes(name, values);
}

void each_field(auto& bytes, FieldsOf<GuideStack> auto& guides) {
  auto& [label, stack, depth_m] = guides;
  bytes(label, stack, depth_m);
}

void each_field(auto& bytes, FieldsOf<SheetPaint> auto& sheet) {
  auto& [picture, base, guides] = sheet;
  bytes(picture, base, guides);
}

namespace {

// All inputs of paint_sheet: the plan as its file would state it, the palette, the light. Other
// inputs of the panels (rules, the instruction set of rays) belong to the program.
CacheKey sheet_key(const ExampleSheetPlan& plan, const ExampleSheetHand& hand,
                   const std::string& subject) {
  CacheKeyText key;
  key.add("plan", write_example_sheet_plan(plan));
  const auto& [palette, light] = hand;
  const auto& [name, winter, treeline_m, lakes_freeze_from_m, classes, sky, cloud_light,
               cloud_shade, haze_near, haze_far, range_mist, growth, haze_share, warm_share,
               ground_drift_share, forest_drift_share, rock_drift_share] = palette;
  key.add("palette", name).add("winter", winter).add("treeline_m", treeline_m);
  key.add("lakes_freeze_from_m", lakes_freeze_from_m);
  for (const auto& [stops] : classes) {
    key.add("class", stops.size());
    for (const auto& [altitude_m, ramp] : stops)
      key.add("altitude_m", altitude_m).add("ramp", ramp);
  }
  key.add("sky", sky).add("cloud_light", cloud_light).add("cloud_shade", cloud_shade);
  key.add("haze_near", haze_near).add("haze_far", haze_far).add("range_mist", range_mist);
  const auto& [leaves, leaf_share, larch, larch_share] = growth;
  key.add("leaves", leaves)
      .add("leaf_share", leaf_share)
      .add("larch", larch)
      .add("larch_share", larch_share);
  key.add("haze_share", haze_share).add("warm_share", warm_share);
  key.add("ground_drift_share", ground_drift_share).add("forest_drift_share", forest_drift_share);
  key.add("rock_drift_share", rock_drift_share).add("own light", !light.has_value());
  const auto& [sun, sky_light, relief, shadow_depth, contrast, model] =
      light.value_or(LightParameters());
  key.add("sun", sun)
      .add("sky light", sky_light)
      .add("relief", relief)
      .add("shadow_depth", shadow_depth)
      .add("contrast", contrast);
  if (model != LightParameters().model) key.add("model", model);
  return make_cache_key(CachedProduct::example_sheet, key, subject);
}

}  // namespace

PaintedExemplar paint_example_sheet(const SceneExemplar& settings, const Scene& scene,
                                    const View& view, const Palette& palette, Progress& progress,
                                    const Cache& cache) {
  const ExampleSheetPlan plan = plan_for(settings, scene, view);
  const ExampleSheetHand hand{palette_in_steps(palette), scene.light};
  const std::string subject =
      fmt::format("{}{}{}, {} × {} texels", scene.title, scene.title.empty() ? "" : ", ",
                  palette.name, plan.width, plan.height);
  SheetPaint sheet = cached<SheetPaint>(
      cache, [&] { return sheet_key(plan, hand, subject); }, progress,
      [&](Progress& watcher) { return paint_sheet(plan, hand, watcher, cache); });
  PaintedExemplar painted;
  painted.exemplar.name = example_sheet_name;
  painted.exemplar.guides = std::move(sheet.guides);
  painted.picture = std::move(sheet.picture);
  painted.base = std::move(sheet.base);
  painted.exemplar.picture =
      seam_picture(painted, painted.exemplar.guides.label, scene.synthesis.residual);
  return painted;
}

glm::ivec2 example_sheet_size(const SceneExemplar& settings, const SceneOutput& output) {
  constexpr double pixels_per_texel = 8.0;
  constexpr double min_texels = 2000.0 * 1400.0;
  constexpr double max_texels = 24e6;
  constexpr double wide = 10.0 / 7.0;
  constexpr int min_side = 64;
  const auto side = [&](double px) {
    return std::max(min_side, static_cast<int>(std::lround(px)));
  };
  if (settings.width > 0 && settings.height > 0)
    return {side(settings.width), side(settings.height)};
  if (settings.width > 0) return {side(settings.width), side(settings.width / wide)};
  if (settings.height > 0) return {side(settings.height * wide), side(settings.height)};
  const double pixels = static_cast<double>(output.width) * output.height;
  const double texels = std::clamp(pixels / pixels_per_texel, min_texels, max_texels);
  return {side(std::sqrt(texels * wide)), side(std::sqrt(texels / wide))};
}

std::vector<LandCoverClass> classes_of_example_sheet() {
  std::vector<LandCoverClass> classes;
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (built_in_needed_texels().texels[static_cast<std::size_t>(info.id)])
      classes.push_back(info.id);
  return classes;
}

}  // namespace belvedere
