#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <thread>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/text/json.h"
#include "tools/cli/commands.h"
#include "tools/cli/new/new_options.h"
#include "tools/cli/new/new_scene.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/options/refuse.h"
#include "tools/studio/studio.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

struct StudioOptions : SceneOptions {
  int port = 0;
  bool headless = false;
  FetchOptions fetch;  // --at and --size are asked for on the page
};

// Of a DEM a scene is made beside it, with the first view that `new` proposes.
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

// Of a place a scene is made of what is fetched for it, as `new --at` does.
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

// As the desktop opens addresses; where there is none the address on the terminal is all.
void open_browser(const std::string& address) {
  if (fork() != 0) return;
  setsid();  // Ctrl-C here does not end a browser that this begins
  execlp("xdg-open", "xdg-open", address.c_str(), static_cast<char*>(nullptr));
  _exit(1);
}

int run_studio(const StudioOptions& options) {
  TerminalProgress progress(options.quiet);
  const Cache cache = make_cache(options);
  const Run run = make_run(options, Run{}.tile_px, silent_progress(), cache);
  const std::string scene = scene_of(options, progress);
  const OpenPlace open = [&](const WantedPlace& place, const Run& given) {
    return scene_of_place(options, scene, place, given);
  };
  Studio studio({scene, options.files, options.port, open}, run);
  if (options.headless)
    print_out(Json::object().add("address", Json::text(studio.address())).str() + "\n");
  else
    print_out(fmt::format("{}\nCtrl-C ends it.\n", studio.address()));
  finish_output();
  if (!options.headless) open_browser(studio.address());
  // A signal can only set a flag.
  std::atomic<bool> ended = false;
  std::thread watch([&] {
    while (!interrupted() && !ended && (options.headless || !studio.is_left()))
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    studio.stop();
  });
  studio.run();
  ended = true;
  watch.join();
  return 0;
}

}  // namespace

Action add_studio(CommandOptions& command) {
  const auto options = std::make_shared<StudioOptions>();
  add_scene_options(command, *options, "A scene file, or a DEM of which a scene is made beside it");
  command.add_option("--port", options->port, "Port of this machine; 0: any that is free")
      .type_name("N")
      .range(0, 65535);
  command.add_flag("--headless", options->headless,
                   "No browser; the address is printed as JSON, for programs");
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
