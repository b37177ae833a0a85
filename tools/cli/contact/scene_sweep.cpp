#include "tools/cli/contact/scene_sweep.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/files/output_file.h"
#include "base/text/json.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/world/scene_dem.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  for (const char letter : text) {
    if (quote != 0) {
      if (letter == quote) quote = 0;
    } else if (letter == '"' || letter == '\'') {
      quote = letter;
    } else if (letter == '[' || letter == '{') {
      ++depth;
    } else if (letter == ']' || letter == '}') {
      --depth;
    } else if (letter == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += letter;
  }
  return values;
}

}  // namespace

SceneSweep split_sweep(const std::vector<std::string>& settings) {
  SceneSweep sweep;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::vector<std::string> values = equals == std::string::npos
                                                ? std::vector<std::string>()
                                                : split_values(setting.substr(equals + 1));
    if (values.size() < 2) {
      sweep.settings.push_back(setting);  // invalid ones are refused with the scene
      continue;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i].empty())
        refuse("--set", fmt::format("{} with an empty value", setting), "KEY=VALUE,VALUE,…");
      if (std::count(values.begin(), values.end(), values[i]) > 1)
        refuse("--set", fmt::format("{} with {} twice", setting, values[i]), "each value once");
    }
    sweep.axes.push_back({setting.substr(0, equals), values});
  }
  if (sweep.axes.empty())
    refuse("--set", "no key with several values", "--set KEY=VALUE,VALUE,… of one key or two");
  if (sweep.axes.size() > 2)
    refuse("--set", fmt::format("{} keys with several values", sweep.axes.size()),
           "one or two: columns and rows of a sheet");
  return sweep;
}

namespace {

constexpr int table_gap = 12;
const glm::vec3 table_paper(1.F);
const glm::vec3 table_ink(0.1F);

// Start of each, and at the end the total.
std::vector<int> begins(int first, const std::vector<int>& sizes) {
  std::vector<int> at = {first};
  for (const int size : sizes) at.push_back(at.back() + size + table_gap);
  return at;
}

// Breaks a caption into lines no wider than its picture, so that the caption does not widen a small
// picture's column; a wider word has its own line.
std::vector<std::string> caption_lines(const TableCell& cell) {
  std::vector<std::string> lines;
  std::size_t at = 0;
  while (at < cell.caption.size()) {
    const std::size_t space = cell.caption.find(' ', at);
    const std::size_t end = space == std::string::npos ? cell.caption.size() : space;
    const std::string word = cell.caption.substr(at, end - at);
    at = end + 1;
    const bool fits = !lines.empty() &&
                      (cell.picture.empty() || text_width(lines.back() + " " + word,
                                                          caption_scale) <= cell.picture.width());
    if (fits)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

}  // namespace

Grid<glm::vec3> draw_table(const PictureTable& table) {
  std::vector<int> widths;
  for (const std::string& name : table.columns) widths.push_back(text_width(name, caption_scale));
  std::vector<int> heights(table.cells.size(), 0);
  for (std::size_t r = 0; r < table.cells.size(); ++r)
    for (std::size_t c = 0; c < table.cells[r].size(); ++c) {
      const TableCell& cell = table.cells[r][c];
      const std::vector<std::string> lines = caption_lines(cell);
      widths[c] = std::max(widths[c], cell.picture.width());
      for (const std::string& line : lines)
        widths[c] = std::max(widths[c], text_width(line, caption_scale));
      heights[r] = std::max(
          heights[r], cell.picture.height() + caption_line_px * static_cast<int>(lines.size()));
    }
  int left = table_gap;
  for (const std::string& name : table.rows)
    left = std::max(left, 2 * table_gap + text_width(name, caption_scale));
  const std::vector<int> x = begins(left, widths);
  const bool named = std::any_of(table.columns.begin(), table.columns.end(),
                                 [](const std::string& name) { return !name.empty(); });
  const std::vector<int> y = begins(table_gap + (named ? caption_line_px : 0), heights);
  const int foot_px = table.foot.empty() ? 0 : table.foot.height() + table_gap;
  Grid<glm::vec3> sheet(std::max(x.back(), left + table.foot.width() + table_gap),
                        y.back() + foot_px, table_paper);
  for (int j = 0; j < table.foot.height(); ++j)
    std::copy_n(table.foot.row(j), table.foot.width(), sheet.row(y.back() + j) + left);
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    draw_text(sheet, x[c], table_gap, table.columns[c], table_ink, caption_scale);
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    draw_text(sheet, table_gap, y[r], table.rows[r], table_ink, caption_scale);
  for (std::size_t r = 0; r < table.cells.size(); ++r)
    for (std::size_t c = 0; c < table.cells[r].size(); ++c) {
      const TableCell& cell = table.cells[r][c];
      for (int j = 0; j < cell.picture.height(); ++j)
        std::copy_n(cell.picture.row(j), cell.picture.width(), sheet.row(y[r] + j) + x[c]);
      int text_y = y[r] + cell.picture.height() + 4;
      for (const std::string& line : caption_lines(cell)) {
        draw_text(sheet, x[c], text_y, line, table_ink, caption_scale);
        text_y += caption_line_px;
      }
    }
  return sheet;
}

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
      .add_option("--out DIR", options->out,
                  "Folder for the pictures, sheet.png, index.html and report.json")
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
