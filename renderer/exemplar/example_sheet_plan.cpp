#include "renderer/exemplar/example_sheet_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/config.h"
#include "base/error.h"
#include "base/random.h"
#include "base/text/config_reader.h"
#include "base/text/embedded.h"
#include "base/text/json.h"

namespace belvedere {
namespace {

constexpr int row_px = 64;               // rows of panels begin at multiples of it
constexpr double fine_panel_px = 240.0;  // smaller panels have coarser terrains
constexpr double margin_mm = 2.0;        // of bare paper between two panels

using Named = std::vector<std::pair<std::string, std::vector<std::string>>>;

// [terrains] or [views]: named lists of settings.
Named read_named(const ConfigValue* table, const std::string& name) {
  Named named;
  if (table != nullptr)
    for (const ConfigEntry& entry : as_table(*table, name))
      named.emplace_back(entry.key, as_strings(entry.value, name));
  return named;
}

void append_named(ExampleSheetPanel& panel, ConfigReader& read, const char* key, const Named& named,
                  const std::string& name) {
  const ConfigValue* value = read.known(key);
  if (value == nullptr) return;
  const std::string& given = as_string(*value, name);
  const auto found =
      std::find_if(named.begin(), named.end(), [&](const auto& n) { return n.first == given; });
  if (found == named.end()) {
    std::string known;
    for (const auto& n : named) known += (known.empty() ? "" : ", ") + n.first;
    refuse_value(*value, name, fmt::format("no {} \"{}\"", key, given), known);
  }
  panel.settings.insert(panel.settings.end(), found->second.begin(), found->second.end());
  panel.name += (panel.name.empty() ? "" : ", ") + given;
}

std::string quoted_list(const std::vector<std::string>& texts) {
  std::string out = "[";
  for (const std::string& text : texts) out += (out.size() > 1 ? ", " : "") + json_quoted(text);
  return out + "]";
}

int rows_of(const ExampleSheetPlan& plan) {
  return static_cast<int>(plan.panels.size()) / plan.columns;
}

int row_top(const ExampleSheetPlan& plan, int row) {
  const int rows = rows_of(plan);
  if (row == rows) return plan.height;
  const int step = plan.height >= row_px * rows ? row_px : 1;
  return static_cast<int>(std::lround(static_cast<double>(plan.height) * row / rows / step)) * step;
}

int column_left(const ExampleSheetPlan& plan, int column) {
  return static_cast<int>(std::lround(static_cast<double>(plan.width) * column / plan.columns));
}

ExampleSheetPlan build_plan(const ConfigValue& root, const std::string& name) {
  ConfigReader read(root, name);
  ExampleSheetPlan plan;
  plan.scene = embedded_file("sheet/scene.toml");
  read.number("width", plan.width, 256, 16384);
  read.number("height", plan.height, 256, 16384);
  read.number("dots_per_inch", plan.dots_per_inch, 5, 2540);
  read.number("seed", plan.seed, 0, static_cast<double>(ExampleSheetPlan::largest_seed));
  read.number("light_from_deg", plan.light_from_deg, -360, 360);
  read.number("columns", plan.columns, 1, 16);
  read.text("palette", plan.palette);
  read.text("scene", plan.scene);
  const Named terrains = read_named(read.known("terrains"), name);
  const Named views = read_named(read.known("views"), name);
  const ConfigValue* panels = read.known("panels");
  read.end();
  if (panels == nullptr)
    refuse_value(root, name, "the panels are missing", "[[panels]], row by row");
  for (const ConfigValue& value : as_array(*panels, name)) {
    ConfigReader each(value, name);
    ExampleSheetPanel panel;
    append_named(panel, each, "terrain", terrains, name);
    append_named(panel, each, "view", views, name);
    each.text("name", panel.name);
    std::vector<std::string> own;
    each.texts("set", own);
    panel.settings.insert(panel.settings.end(), own.begin(), own.end());
    each.texts("set_in_winter", panel.snow_settings);
    each.end();
    plan.panels.push_back(std::move(panel));
  }
  if (plan.panels.empty() || plan.panels.size() % static_cast<std::size_t>(plan.columns) != 0)
    refuse_value(*panels, name,
                 fmt::format("{} panels in rows of {}", plan.panels.size(), plan.columns),
                 "full rows");
  return plan;
}

}  // namespace

ExampleSheetPlan parse_example_sheet_plan(std::string_view text, const std::string& name) {
  return build_plan(parse_config(text, name), name);
}

ExampleSheetPlan built_in_example_sheet_plan() {
  return parse_example_sheet_plan(embedded_file("sheet/plan.toml"), "sheet/plan.toml");
}

ExampleSheetPlan read_example_sheet_plan(const std::string& path) {
  return build_plan(read_config(path), path);
}

std::string write_example_sheet_plan(const ExampleSheetPlan& plan) {
  std::string out =
      "# An example sheet. To paint it again: belvedere exemplar paint --plan THIS_FILE --out "
      "DIR\n";
  out += fmt::format(
      "width = {}\nheight = {}\ndots_per_inch = {}\npalette = {}\nseed = {}\nlight_from_deg = "
      "{}\ncolumns = {}\n",
      plan.width, plan.height, plan.dots_per_inch, json_quoted(plan.palette), plan.seed,
      plan.light_from_deg, plan.columns);
  out += "# Common to all panels.\nscene = '''\n" + plan.scene + "'''\n";
  for (const ExampleSheetPanel& panel : plan.panels)
    out += fmt::format("\n[[panels]]\nname = {}\nset = {}\nset_in_winter = {}\n",
                       json_quoted(panel.name), quoted_list(panel.settings),
                       quoted_list(panel.snow_settings));
  return out;
}

PixelRect panel_cell(const ExampleSheetPlan& plan, int panel) {
  const int column = panel % plan.columns;
  const int row = panel / plan.columns;
  return {column_left(plan, column), row_top(plan, row), column_left(plan, column + 1),
          row_top(plan, row + 1)};
}

PixelRect panel_rect(const ExampleSheetPlan& plan, int panel) {
  const PixelRect cell = panel_cell(plan, panel);
  const int margin =
      std::max(1, static_cast<int>(std::lround(0.5 * margin_mm * plan.dots_per_inch / 25.4)));
  const int across = std::min(margin, (cell.width() - 16) / 2);
  const int down = std::min(margin, (cell.height() - 16) / 2);
  return {cell.x0 + across, cell.y0 + down, cell.x1 - across, cell.y1 - down};
}

LoadedScene panel_scene(const ExampleSheetPlan& plan, int panel, bool winter) {
  const ExampleSheetPanel& shown = plan.panels[static_cast<std::size_t>(panel)];
  SceneFileOptions options;
  // A winter example sheet still has every class, for land cover from maps; panels set where it is
  // covered by snow.
  options.settings.emplace_back("land_cover.settings.winter=0");
  options.settings.insert(options.settings.end(), shown.settings.begin(), shown.settings.end());
  if (winter)
    options.settings.insert(options.settings.end(), shown.snow_settings.begin(),
                            shown.snow_settings.end());
  const PixelRect rect = panel_rect(plan, panel);
  options.settings.push_back(fmt::format("output.width={}", rect.width()));
  options.settings.push_back(fmt::format("output.height={}", rect.height()));
  LoadedScene loaded = parse_scene(plan.scene, "sheet", ".", options);
  Scene& scene = loaded.scene;
  scene.title = shown.name;
  scene.palette = plan.palette;
  scene.output.sheet_width_mm = rect.width() / plan.dots_per_inch * 25.4;
  double light_deg =
      std::remainder(scene.camera.azimuth_deg.value_or(0.0) + plan.light_from_deg, 360.0);
  if (light_deg < 0.0) light_deg += 360.0;
  scene.sun.azimuth_deg = light_deg;
  // The terrains were chosen for the plan's own seed; another seed makes others. Small panels show
  // no more detail than coarse terrains have.
  const ExampleSheetPlan usual;
  SyntheticParameters& terrain = scene.terrain.synthetic.value();
  if (plan.seed != usual.seed)
    terrain.seed = stream_seed(terrain.seed, Stream::sheet_terrains, plan.seed) >> 11;
  const double coarser =
      std::clamp(fine_panel_px / std::min(rect.width(), rect.height()), 1.0, 4.0);
  terrain.width = static_cast<int>(std::lround(terrain.width / coarser));
  terrain.height = static_cast<int>(std::lround(terrain.height / coarser));
  terrain.cell_m *= coarser;
  scene.seed = plan.seed;
  return loaded;
}

}  // namespace belvedere
