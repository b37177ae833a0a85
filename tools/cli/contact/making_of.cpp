#include "tools/cli/contact/making_of.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/cache/cache.h"
#include "base/files/output_file.h"
#include "base/land_cover_class.h"
#include "base/text/json.h"
#include "renderer/exemplar/exemplars.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "renderer/paint/guides.h"
#include "renderer/pipeline/copy_plan.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/stages/stages.h"
#include "renderer/trace/relief_sketch.h"
#include "renderer/world/scene_features.h"
#include "renderer/world/scene_season.h"
#include "renderer/world/world.h"
#include "tools/cli/commands.h"
#include "tools/cli/contact/scene_sweep.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr std::uint64_t tile_bytes =
    256ULL << 20U;  // that stages keep in memory before they use a scratch file

// Relief of a ground as seen from the scene's camera.
Grid<glm::vec3> relief(const BareView& bare, const Grid<float>& altitude_m,
                       const Deformation& deformation) {
  const DeformedSurface surface =
      deform(altitude_m, bare.dem->transform, glm::dvec3(bare.view.viewer_xy, 0.0), deformation);
  const Tracer tracer(surface);
  return make_relief_sketch(altitude_m, bare.dem->transform, {}, deformation, tracer, *bare.camera,
                            bare.view.sun_direction);
}

// Relief of the ground of the scene itself, whose surface there is already.
Grid<glm::vec3> relief(const BareView& bare) {
  return make_relief_sketch(*bare.generalized_m, bare.dem->transform, {}, bare.deformation,
                            *bare.tracer, *bare.camera, bare.view.sun_direction);
}

void add_ground(std::vector<MakingStep>& steps, const LoadedScene& loaded, const Run& run) {
  const BareView bare = make_bare_view(loaded, run.progress, run.cache);
  run.progress.begin("drawing the relief", 3.0);
  const auto add = [&](const char* file, const char* caption, Grid<glm::vec3> picture) {
    steps.push_back({file, caption, std::move(picture)});
    run.progress.advance(1.0);
  };
  add("measured", "the ground as measured", relief(bare, bare.dem->altitude_m, Deformation()));
  add("generalized", "generalized for this view", relief(bare, *bare.generalized_m, Deformation()));
  add("bent", "raised, moved and bent", relief(bare));
}

Grid<glm::vec3> class_picture(const GuidanceBuffers& guidance) {
  Grid<glm::vec3> out(guidance.width(), guidance.height(), no_class_colour);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!guidance.is_sky(i))
      out[i] = class_colour(static_cast<std::uint8_t>(guidance.land_cover[i]));
  return out;
}

Grid<glm::vec3> tone_picture(const GuidanceBuffers& guidance) {
  Grid<glm::vec3> out(guidance.width(), guidance.height(), no_class_colour);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!guidance.is_sky(i)) out[i] = glm::vec3(std::clamp(guidance.tone[i], 0.F, 1.F));
  return out;
}

// From here on, by the stages of rendering itself.
void add_paint(std::vector<MakingStep>& steps, const LoadedScene& loaded, const Run& run) {
  const ScratchFolder scratch;
  const WorkFolder work(scratch.path() + "/work", {}, WorkMode::begin);
  ScenePaint paint = read_scene_paint(loaded, run.progress);
  const World world = make_world(loaded, run.progress, run.cache);
  paint.palette = palette_for_location(paint.palette, loaded, *world.dem);
  TileStore::Place tile_scratch{work.folder(), tile_bytes};
  const SheetView view = view_of(world);
  StageGraph graph(tile_scratch, run.progress);
  const GroundStages ground =
      add_ground_stages(graph, make_ground_inputs(world, view, paint.palette, run),
                        choose_block_px(world.scene, view.pixels_per_unit));
  const PixelRect sheet = ground.lit->sheet();
  const GuidanceBuffers guidance = ground.lit->read(sheet);
  steps.push_back({"classes", "land cover", class_picture(guidance)});
  steps.push_back({"tone", "light and shade", tone_picture(guidance)});
  steps.push_back({"base", "colours of the palette", ground.base->read(sheet).colour});
  const bool copied = world.scene.copies();
  CopyPlan plan =
      copied ? make_copy_plan(loaded, world, paint, ground, tile_scratch, work, run) : CopyPlan{};
  const DrawnFeatures features =
      draw_scene_features(loaded, world, ground.inputs->strokes.winter, run.progress);
  const PictureStages picture =
      add_picture_stages(graph, ground, copied ? &plan : nullptr, features);
  if (copied)
    steps.push_back({"copied", "paint copied from paintings", picture.copied->read(sheet)});
  steps.push_back({"strokes", "strokes over it: the picture", picture.picture->read(sheet).colour});
}

}  // namespace

glm::vec3 class_colour(std::uint8_t label) {
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (static_cast<std::uint8_t>(info.id) == label)
      return glm::vec3((info.rgb >> 16U) & 255U, (info.rgb >> 8U) & 255U, info.rgb & 255U) / 255.F;
  return no_class_colour;
}

std::vector<MakingStep> make_making_of(const LoadedScene& loaded, const Run& run) {
  const RunLimits limits(run);
  std::vector<MakingStep> steps;
  add_ground(steps, loaded, run);
  add_paint(steps, loaded, run);
  return steps;
}

std::vector<MakingStep> make_deformation_steps(const LoadedScene& loaded, const Run& run) {
  const RunLimits limits(run);
  const BareView bare = make_bare_view(loaded, run.progress, run.cache);
  run.progress.begin("drawing the relief", 3.0);
  std::vector<MakingStep> steps;
  const auto add = [&](const char* file, const char* caption, Grid<glm::vec3> picture) {
    steps.push_back({file, caption, std::move(picture)});
    run.progress.advance(1.0);
  };
  add("undeformed", "undeformed", relief(bare, *bare.generalized_m, Deformation()));
  DeformParameters progressive = bare.view.deform;
  progressive.summits.clear();
  progressive.handles.clear();
  progressive.field.places.clear();
  const bool local =
      bare.deformation.moves_in_plan() || !bare.deformation.parameters().summits.empty();
  add("progressive", "progressive deformation",
      local ? relief(bare, *bare.generalized_m, Deformation(progressive, bare.view.viewer_xy))
            : relief(bare));
  if (local) add("local", "progressive and local deformation", relief(bare));
  return steps;
}

Grid<glm::vec3> draw_making_of(const std::vector<MakingStep>& steps, int step_px,
                               std::size_t columns) {
  PictureTable table;
  table.columns.resize(columns);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i % columns == 0) table.cells.emplace_back();
    table.cells.back().push_back({reduced_picture(steps[i].picture, step_px),
                                  fmt::format("{}  {}", i + 1, steps[i].caption)});
  }
  return draw_table(table);
}

namespace {

constexpr int figure_px = 900;             // longest side of a picture on the sheet
const glm::vec3& blank = no_class_colour;  // sky, and pixels that are never copied from

struct FigureOptions {
  SceneOptions scene;
  std::string out;
  int width_px = 0;  // 0: the scene's
  bool making = false;
  bool deformation = false;
};

// A column of the figure: a picture with the guides of copying from it or to it.
struct Column {
  std::string name;  // above it
  std::string file;  // prefix of its files
  Grid<glm::vec3> picture;
  GuideStack guides;
};

Grid<glm::vec3> figure_class_picture(const GuideStack& guides) {
  Grid<glm::vec3> out(guides.width(), guides.height(), blank);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = class_colour(guides.label[i]);
  return out;
}

// Values that are black and white in the pictures of a guide, the same in all columns.
struct GreyRange {
  float black = 0.F;
  float white = 255.F;
};

// The range of all texels and pixels that are used, so that all steps of a narrow guide are seen.
GreyRange range_of(const std::vector<Column>& columns, const char* guide) {
  GreyRange range{255.F, 0.F};
  for (const Column& column : columns) {
    const Grid<std::uint8_t>* values = column.guides.find(guide);
    if (values == nullptr) continue;
    for (std::size_t i = 0; i < values->size(); ++i) {
      if (column.guides.label[i] == unused_label) continue;
      range.black = std::min(range.black, static_cast<float>((*values)[i]));
      range.white = std::max(range.white, static_cast<float>((*values)[i]));
    }
  }
  return range.black < range.white ? range : GreyRange{};
}

// Empty if the guide is not known.
Grid<glm::vec3> guide_picture(const GuideStack& guides, const char* guide, GreyRange range) {
  const Grid<std::uint8_t>* values = guides.find(guide);
  if (values == nullptr) return {};
  Grid<glm::vec3> out(guides.width(), guides.height(), blank);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (guides.label[i] != unused_label)
      out[i] =
          glm::vec3((static_cast<float>((*values)[i]) - range.black) / (range.white - range.black));
  return out;
}

// The classes that occur in the pictures, as a square of their colour and their name.
Grid<glm::vec3> legend(const std::vector<Column>& columns) {
  std::array<bool, 256> shown{};
  for (const Column& column : columns)
    for (const std::uint8_t label : column.guides.label) shown[label] = true;
  constexpr int side = 20;
  std::vector<std::pair<std::uint8_t, std::string>> entries;
  int width = 1;
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (shown[static_cast<std::size_t>(info.id)]) {
      entries.emplace_back(static_cast<std::uint8_t>(info.id), std::string(info.name));
      width += side + 8 + text_width(entries.back().second, 2) + side;
    }
  Grid<glm::vec3> out(width, side, glm::vec3(1.F));
  int x0 = 0;
  for (const auto& [label, name] : entries) {
    for (int y = 0; y < side; ++y) std::fill_n(out.row(y) + x0, side, class_colour(label));
    draw_text(out, x0 + side + 8, 2, name, glm::vec3(0.1F), 2);
    x0 += side + 8 + text_width(name, 2) + side;
  }
  return out;
}

// The exemplars that the scene copies from, in the same form as its picture.
std::vector<Column> copied_from(const LoadedScene& loaded, Progress& progress, const Cache& cache) {
  if (!loaded.scene.copies()) return {};
  ScenePaint paint = read_scene_paint(loaded, progress);
  const World world = make_world(loaded, progress, cache);
  const Palette palette = palette_for_location(paint.palette, loaded, *world.dem);
  std::vector<Column> columns;
  for (PaintedExemplar& painted :
       make_exemplars(loaded, world.view, palette, std::move(paint.paintings), progress, cache)) {
    const std::string file = fmt::format("copied_{}", columns.size() + 1);
    columns.push_back({"copied from: " + painted.exemplar.name, file, std::move(painted.picture),
                       std::move(painted.exemplar.guides)});
  }
  return columns;
}

Column painted_picture(const LoadedScene& loaded, const Run& run) {
  const ScratchFolder folder;
  const auto path = [&](const char* name) {
    return (std::filesystem::path(folder.path()) / name).string();
  };
  SheetRequest request;
  request.channels = {"Z", "landcover.id", "altitude.V"};
  render(loaded, folder.path(), run, request);
  const GuidanceBuffers guidance = read_guidance(path("guidance.exr"));
  return {loaded.name, "picture", read_picture(path("panorama.png")),
          make_guide_stack(guidance, guidance.land_cover)};
}

void add_making_of(Report& page, const LoadedScene& loaded, const Run& run) {
  const std::vector<MakingStep> steps = make_making_of(loaded, run);
  for (std::size_t i = 0; i < steps.size(); ++i)
    page.write_picture(fmt::format("making_{}_{}", i + 1, steps[i].file), steps[i].picture);
  page.section("making", "How it is made",
               "The same view at every stage, from the ground as measured to the picture.");
  page.picture("making", draw_making_of(steps, figure_px), "making.png");
}

// Ends the page and tells where its sheet is.
int finish(Report& page, const FigureOptions& options, const LoadedScene& loaded,
           const std::string& sheet_name, const char* counted, std::size_t count) {
  std::string command = "belvedere figure " + file_name(options.scene.scene);
  for (const std::string& setting : options.scene.files.settings)
    command += fmt::format(" --set '{}'", setting);
  if (options.width_px > 0) command += fmt::format(" --width {}", options.width_px);
  if (options.making) command += " --making";
  if (options.deformation) command += " --deformation";
  page.write({.title = "Figure of " + loaded.name,
              .lead = fmt::format("{} × {} pixels.", loaded.scene.output.width,
                                  loaded.scene.output.height),
              .command = command + " --out " + file_name(options.out)});
  const std::string sheet = (std::filesystem::path(options.out) / sheet_name).string();
  print_result(options.scene,
               Json::object()
                   .add("sheet", Json::text(sheet))
                   .add(counted, Json::number(static_cast<double>(count))),
               sheet + "\n");
  return 0;
}

int show_deformation(const FigureOptions& options, const LoadedScene& loaded) {
  Report page(options.out);
  TerminalProgress progress(options.scene.quiet);
  const Cache cache = make_cache(options.scene);
  const std::vector<MakingStep> steps =
      make_deformation_steps(loaded, make_run(options.scene, Run{}.tile_px, progress, cache));
  for (std::size_t i = 0; i < steps.size(); ++i)
    page.write_picture(fmt::format("deformation_{}_{}", i + 1, steps[i].file), steps[i].picture);
  page.section("deformation", "How the ground is deformed",
               "The same ground from the same viewpoint: as it is, bent and exaggerated by "
               "distance, and with summits raised and mountains moved as well (figure 6 of Jenny "
               "& Jenny 2013).");
  page.picture("deformation", draw_making_of(steps, figure_px, steps.size()), "deformation.png");
  progress.end();
  return finish(page, options, loaded, "deformation.png", "pictures", steps.size());
}

int run(const FigureOptions& options) {
  LoadedScene loaded = load(options.scene);
  if (options.width_px > 0) loaded = at_width(loaded, options.width_px);
  if (options.deformation) return show_deformation(options, loaded);
  loaded.scene.output.formats = {"png"};
  Report page(options.out);
  TerminalProgress progress(options.scene.quiet);
  const Cache cache = make_cache(options.scene);
  Column result = painted_picture(loaded, make_run(options.scene, Run{}.tile_px, progress, cache));
  std::vector<Column> columns = copied_from(loaded, progress, cache);
  columns.push_back(std::move(result));
  PictureTable table;
  table.rows = {"land cover", "altitude", "distance", "picture"};
  table.cells.resize(table.rows.size());
  const GreyRange distances = range_of(columns, "distance");
  for (const Column& column : columns) {
    table.columns.push_back(column.name);
    const std::array<std::pair<const char*, Grid<glm::vec3>>, 4> rows = {
        {{"landcover", figure_class_picture(column.guides)},
         {"altitude", guide_picture(column.guides, "altitude", {})},
         {"distance", guide_picture(column.guides, "distance", distances)},
         {"", column.picture}}};
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto& [name, picture] = rows[r];
      if (!picture.empty())
        page.write_picture(column.file + (*name == 0 ? "" : "_") + name, picture);
      table.cells[r].push_back(
          {picture.empty() ? picture : reduced_picture(picture, figure_px), {}});
    }
  }
  table.foot = legend(columns);
  page.section(
      "sheet", "Paintings and the picture",
      "The classes, altitudes (20 m a step of grey from 0 m) and distances (logarithm, black "
      "near) of both (figure 4 of Jenny & Jenny 2013), the painting, and the result "
      "(figure 5). A painting without guidance or such images has only its classes.");
  page.picture("sheet", draw_table(table), "sheet.png");
  if (options.making)
    add_making_of(page, loaded, make_run(options.scene, Run{}.tile_px, progress, cache));
  progress.end();
  return finish(page, options, loaded, "sheet.png", "columns", columns.size());
}

}  // namespace

std::function<int()> add_figure(CommandOptions& command) {
  const auto options = std::make_shared<FigureOptions>();
  add_scene_options(command, options->scene);
  command
      .add_option("--out DIR", options->out,
                  "Folder for sheet.png, each of its pictures, and index.html")
      .required()
      .files(FileUse::folder);
  command
      .add_option("--width N", options->width_px,
                  "Width of the picture in pixels, its height in proportion. Default: the scene's")
      .range(16, 20000);
  const Option making =
      command.add_flag("--making", options->making,
                       "Also writes making.png: the ground as measured, generalized and bent, land "
                       "cover, light, colours, copied paint if there is any, strokes.\n"
                       "Paints the picture a second time");
  command
      .add_flag("--deformation", options->deformation,
                "Writes only deformation.png, in seconds: the relief undeformed, with progressive "
                "deformation, and with summits, handles and field as well (figure 6)")
      .excludes({making});
  command.footer(
      "Rows of land cover, altitude, distance and paint, a column for each painting that is copied "
      "from and "
      "one for the picture:\n"
      "figures 4 and 5 of Jenny & Jenny 2013 for any scene.\n"
      "\n"
      "  belvedere figure scenes/karwendel.toml --data ../data --width 1200 --making --out figure");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
