#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "base/cache/cache.h"
#include "base/files/output_file.h"
#include "base/error.h"
#include "base/text/json.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/world/scene_dem.h"
#include "tools/cli/commands.h"
#include "tools/cli/contact/scene_sweep.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr std::size_t max_pictures = 100;
constexpr int swept_px = 640;  // longest side of a picture on the sheet

struct SweepOptions {
  SceneOptions scene;
  std::string out;
  bool draft = false;
};

// One picture of the sweep.
struct Swept {
  std::vector<std::string> values;  // of each axis
  std::string name;                 // of its file, without extension
  LoadedScene scene;
};

// All scenes, row by row: an invalid value is refused before the first is rendered.
std::vector<Swept> read_scenes(const SweepOptions& options, const SceneSweep& sweep) {
  std::vector<Swept> all;
  const std::size_t rows = sweep.axes.size() > 1 ? sweep.axes[1].values.size() : 1;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < sweep.axes[0].values.size(); ++c) {
      Swept swept{.values = {sweep.axes[0].values[c]},
                  .name = fmt::format("{}_{}", c + 1, r + 1),
                  .scene = {}};
      if (sweep.axes.size() > 1) swept.values.push_back(sweep.axes[1].values[r]);
      SceneOptions one = options.scene;
      one.files.settings = sweep.settings;
      for (std::size_t a = 0; a < swept.values.size(); ++a)
        one.files.settings.push_back(sweep.axes[a].key + "=" + swept.values[a]);
      swept.scene = load(one);
      if (options.draft) swept.scene = make_draft_scene(std::move(swept.scene));
      swept.scene.scene.output.formats = {"png"};
      all.push_back(std::move(swept));
    }
  return all;
}

Grid<glm::vec3> render_picture(const LoadedScene& scene, const Run& run) {
  const ScratchFolder folder;
  SheetRequest request;
  request.channels.emplace();  // no guidance
  render(scene, folder.path(), run, request);
  return read_picture((std::filesystem::path(folder.path()) / "panorama.png").string());
}

std::string describe(const SweepOptions& options) {
  std::string out =
      "belvedere sweep " +
      (options.scene.scene.empty() ? std::string() : file_name(options.scene.scene) + " ");
  for (const std::string& setting : options.scene.files.settings)
    out += fmt::format("--set '{}' ", setting);
  return out + (options.draft ? "--draft " : "") + "--out " + file_name(options.out);
}

Json as_json(const SweepOptions& options, const SceneSweep& sweep, const std::vector<Swept>& all) {
  Json axes = Json::array();
  for (const SceneAxis& axis : sweep.axes) {
    Json values = Json::array();
    for (const std::string& value : axis.values) values.add(Json::text(value));
    axes.add(Json::object().add("key", Json::text(axis.key)).add("values", std::move(values)));
  }
  Json pictures = Json::array();
  for (const Swept& swept : all) {
    Json values = Json::object();
    for (std::size_t a = 0; a < swept.values.size(); ++a)
      values.add(sweep.axes[a].key, Json::text(swept.values[a]));
    pictures.add(Json::object()
                     .add("picture", Json::text(swept.name + ".png"))
                     .add("values", std::move(values)));
  }
  return Json::object()
      .add("command", Json::text(describe(options)))
      .add("axes", std::move(axes))
      .add("pictures", std::move(pictures));
}

int run(const SweepOptions& options) {
  const SceneSweep sweep = split_sweep(options.scene.files.settings);
  const std::size_t columns = sweep.axes[0].values.size();
  const std::size_t rows = sweep.axes.size() > 1 ? sweep.axes[1].values.size() : 1;
  if (columns * rows > max_pictures)
    throw Error(ErrorKind::usage, "--set", fmt::format("{} pictures", columns * rows),
                fmt::format("at most {}", max_pictures));
  const std::vector<Swept> all = read_scenes(options, sweep);
  Report page(options.out);
  TerminalProgress progress(options.scene.quiet);
  const Cache cache = make_cache(options.scene);
  PictureTable table;
  for (const std::string& value : sweep.axes[0].values)
    table.columns.push_back(sweep.axes[0].key + "=" + value);
  if (sweep.axes.size() > 1)
    for (const std::string& value : sweep.axes[1].values)
      table.rows.push_back(sweep.axes[1].key + "=" + value);
  table.cells.resize(rows);
  for (std::size_t i = 0; i < all.size(); ++i) {
    SweepProgress here(progress, i + 1, all.size());
    const Grid<glm::vec3> picture =
        render_picture(all[i].scene, make_run(options.scene, Run{}.tile_px, here, cache));
    page.write_picture(all[i].name, picture);
    table.cells[i / columns].push_back({reduced_picture(picture, swept_px), {}});
  }
  page.section("sheet", "All pictures",
               "Each full picture has its own file: 2_1.png is in the second column, first row.");
  page.picture("sheet", draw_table(table), "sheet.png");
  const Json told = as_json(options, sweep, all);
  page.write({.title = "Sweep of " + all.front().scene.name,
              .lead = fmt::format("{} pictures.", all.size()),
              .command = describe(options),
              .data = told});
  progress.end();
  print_result(options.scene, told,
               (std::filesystem::path(options.out) / "sheet.png").string() + "\n");
  return 0;
}

}  // namespace

std::function<int()> add_sweep(CommandOptions& command) {
  const auto options = std::make_shared<SweepOptions>();
  add_scene_options(command, options->scene);
  command
      .add_option("--out", options->out,
                  "Folder for the pictures, sheet.png, index.html and report.json")
      .type_name("DIR")
      .required()
      .files(FileUse::folder);
  command.add_flag("--draft", options->draft,
                   "Drafts as of render --draft: a third of the pixels per side, only strokes");
  command.footer(
      "One or two keys of --set have several values: the first varies along the columns, the "
      "second along the rows.\n"
      "Commas within brackets and quotes belong to the value.\n"
      "\n"
      "  belvedere sweep scenes/karwendel.toml --data ../data --draft --set "
      "sun.azimuth_deg=250,300 --set air.haze=0,0.5 --out s\n"
      "  belvedere sweep --set output.width=600 --set 'generalize.foreground=[1,1],[1.5,0.5]' "
      "--out bands");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
