#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "base/cache/cache.h"
#include "base/error.h"
#include "tools/cli/commands.h"
#include "tools/cli/new/new_options.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/studio/painting_work.h"
#include "tools/cli/studio/serve_page.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/pick/picking.h"
#include "tools/studio/studio.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

struct StudioOptions : SceneOptions {
  PageOptions page;
  FetchOptions fetch;  // --at and --size are asked for on the page
};

// The scene file; for a DEM a scene is made beside it, with the first view that `new` proposes.
std::string scene_of(const StudioOptions& options, Progress& progress) {
  if (options.scene.empty())
    refuse("SCENE", "no scene is given", "a scene file, or a DEM of which one is made");
  if (options.scene.ends_with(".toml")) return options.scene;
  NewOptions made;
  made.common = options;
  made.common.quiet = true;
  made.common.json = false;
  made.dems = {options.scene};
  made.out = fs::path(options.scene).replace_extension(".toml").string();
  if (!fs::exists(made.out)) {
    make_new_scene(made);
    progress.note(made.out + " is a new scene of this terrain");
  } else {
    progress.note(made.out + " is there already, and is opened");
  }
  return made.out;
}

// Makes a scene of a place from the data fetched for it, as `new --at` does.
std::string scene_of_place(const StudioOptions& options, const std::string& scene,
                           const WantedPlace& place, const Run& run) {
  NewOptions made;
  made.common = options;
  made.fetch = options.fetch;
  made.fetch.at = fmt::format("{},{}", place.at_lonlat.x, place.at_lonlat.y);
  made.fetch.size = fmt::format("{}x{}", place.size_km.x, place.size_km.y);
  made.fetch.no_land_cover = !place.land_cover;
  made.fetched = place.folder;
  const glm::dvec2 at = place.at_lonlat;
  made.title = fmt::format("{:g}° {}, {:g}° {}", std::abs(at.y), at.y < 0.0 ? "S" : "N",
                           std::abs(at.x), at.x < 0.0 ? "W" : "E");
  made.out = scene;
  return new_scene_text(made, run.cache, run.progress);
}

int run_studio(const StudioOptions& options) {
  TerminalProgress progress(options.quiet);
  const Cache cache = make_cache(options);
  const Run run = make_run(options, Run{}.tile_px, silent_progress(), cache);
  const std::string scene = scene_of(options, progress);
  const OpenPlace open = [&](const WantedPlace& place, const Run& given) {
    return scene_of_place(options, scene, place, given);
  };
  const OpenPicking pick = [](const LoadedScene& of, const std::string& painting,
                              const std::string& pairs, const Run& given) -> Room {
    const auto picking =
        std::make_shared<Picking>(picking_input(of, painting, pairs, given), given.progress);
    return [picking](const HttpRequest& request) { return picking->answer(request); };
  };
  const FitStyle fit = [](const std::string& painting, const std::string& style, const Run& given) {
    write_fitted_style(painting, style, given.progress);
  };
  Studio studio({scene, options.files, options.page.port, open, pick, fit}, run);
  serve_page(served_page(studio), options.page.headless);
  return 0;
}

}  // namespace

Action add_studio(CommandOptions& command) {
  const auto options = std::make_shared<StudioOptions>();
  add_scene_options(command, *options, "A scene file, or a DEM of which a scene is made beside it");
  command.option("SCENE").files(FileUse::edits);
  add_page_options(command, options->page);
  add_source_options(command, options->fetch);
  command.footer(
      "Opens a page on which the scene is composed live: camera, sun, ground, colours. The file is "
      "written when you save; comments stay.\n"
      "Only this machine can reach it.\n"
      "\n"
      "  belvedere studio scenes/karwendel.toml --data ../data\n"
      "  belvedere studio my_dem.tif");
  return [options] { return run_studio(*options); };
}

}  // namespace belvedere::tools
