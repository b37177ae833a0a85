#include "tools/cli/exemplar/registered_scene_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

#include "renderer/scene/scene_file.h"

namespace belvedere::tools {
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
