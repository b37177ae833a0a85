#include "tools/cli/exemplar/register_options.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/core.h>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "renderer/scene/scene_file.h"

namespace belvedere::tools {

void add_register_options(CommandOptions& command, RegisterOptions& options,
                          const std::string& pairs) {
  command.add_option("PAINTING", options.painting, "A painted panorama or its scan")
      .required()
      .type_name("PICTURE")
      .files(FileUse::input);
  command.add_option("DEM", options.dems, "Elevation of the region that it shows")
      .required()
      .type_name("DEM")
      .files(FileUse::input);
  command.add_option("--pairs", options.pairs, pairs).required().type_name("PAIRS");
  command
      .add_option("--sigma", options.sigma_px,
                  "How exactly pixels were clicked: standard deviation in pixels. Default: "
                  "estimated")
      .type_name("PX")
      .range(0.1, 100.0);
  command
      .add_option("--projection", options.projection,
                  "As which projection the painting is fitted. Default: the one that fits best")
      .one_of({"auto", "perspective", "cylindrical", "panini"});
  command.add_flag("--cropped", options.cropped,
                   "The painting was cropped on one side: its middle is not that of the view");
  command.add_option("--crs", options.crs, "CRS of the elevation, where its files do not name it")
      .type_name("CRS");
  command
      .add_option("--cell", options.cell_m,
                  "Side of the ground's cells in metres. Default: that of the data")
      .type_name("M")
      .range(0.1, 10000.0);
  add_run_options(command, options);
}

DemParameters dem_parameters(const RegisterOptions& options) {
  DemParameters out;
  for (const std::string& path : options.dems) {
    RasterSource source;
    source.path = path;
    source.crs = options.crs;
    out.sources.push_back(source);
  }
  out.cell_m = options.cell_m;
  return out;
}

RegistrationParameters registration_parameters(const RegisterOptions& options) {
  RegistrationParameters out;
  out.sigma_px = options.sigma_px;
  out.view.cropped = options.cropped;
  if (options.projection != "auto")
    std::erase_if(out.view.kinds,
                  [&](ViewKind kind) { return view_kind_name(kind) != options.projection; });
  return out;
}

namespace {

constexpr std::array<std::string_view, 6> about = {"terrain", "deform",        "camera",
                                                   "sun",     "light.regions", "output"};
constexpr std::string_view about_valleys = "generalize";  // if they are wider

}  // namespace

std::string registered_scene_text(const Scene& scene) {
  std::vector<std::string_view> sections(about.begin(), about.end());
  if (scene.generalize.valleys.width_m > 0.F) sections.push_back(about_valleys);
  const std::string text = write_scene(scene);
  std::string out, line;
  bool wanted = true;
  for (std::istringstream lines(text); std::getline(lines, line);) {
    if (line.starts_with("[")) {
      const std::string name = line.substr(line.find_first_not_of('['));
      wanted = std::any_of(sections.begin(), sections.end(), [&](std::string_view section) {
        return name.starts_with(section) &&
               (name[section.size()] == ']' || name[section.size()] == '.');
      });
    }
    if (wanted) out += line + "\n";
  }
  if (!scene.land_cover.settings.empty()) out += "\n[land_cover.settings]\n";
  for (const auto& [name, value] : scene.land_cover.settings)
    out += fmt::format("{} = {}\n", name, value);
  return out;
}

}  // namespace belvedere::tools
