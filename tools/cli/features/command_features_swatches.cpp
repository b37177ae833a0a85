#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>

#include "renderer/image/image_io.h"
#include "tools/cli/commands.h"
#include "tools/cli/features/swatches.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct SwatchesOptions {
  std::string style = "classic";
  std::string out;
};

int run(const SwatchesOptions& options) {
  const FeatureStyle style = load_feature_style(options.style);
  const std::filesystem::path folder = options.out;
  for (std::size_t k = 0; k < style.kinds.size(); ++k) {
    const Grid<glm::vec3> swatch = make_swatch(style, static_cast<int>(k));
    if (swatch.empty()) continue;
    const std::string file = (folder / (style.kinds[k].name + ".png")).string();
    write_png8(file, swatch, {});
    print_out(file + "\n");
  }
  return 0;
}

}  // namespace

Action add_features_swatches(CommandOptions& command) {
  const auto options = std::make_shared<SwatchesOptions>();
  command.add_option("--style", options->style, "classic, ski, or a .toml file")
      .type_name("STYLE")
      .show_default();
  command.add_option("--out", options->out, "Folder for a picture of each kind; created if missing")
      .required()
      .type_name("DIR")
      .files(FileUse::folder);
  command.footer(
      "Paints each kind of a style as in the foreground of a sheet, summer left, winter right, at "
      "8 pixels per mm, to check a style\n"
      "file without rendering a scene.\n"
      "\n"
      "  belvedere features swatches --style my_style.toml --out swatches");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
