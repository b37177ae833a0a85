#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <utility>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/files/output_file.h"
#include "renderer/pipeline/pipeline.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

struct PlanOptions {
  bool force = false;
  SceneOptions scene;               // of plan; part and join read what the plan recorded
  std::vector<std::string> layers;  // the same
  std::string folder;
  std::string out;
  int parts = 8;
  int part = 1;
};

// The record of a plan for its parts: scene, data folders, number of parts, layers.
struct Order {
  std::string scene;
  SceneFileOptions files;
  bool allow_http = false;
  int parts = 1;
  SheetRequest request;
};

std::string order_path(const std::string& folder) {
  return (fs::path(folder) / "order.txt").string();
}

void write_order(const std::string& folder, const Order& order) {
  JobIdentity entries;
  entries["scene"] = order.scene;
  entries["parts"] = fmt::format("{}", order.parts);
  if (!order.request.layers.empty())
    entries["layers"] = fmt::format("{}", fmt::join(order.request.layers, ","));
  if (order.allow_http) entries["servers"] = "allowed";
  for (std::size_t i = 0; i < order.files.data_folders.size(); ++i)
    entries[fmt::format("data {:04}", i)] = order.files.data_folders[i];
  for (std::size_t i = 0; i < order.files.settings.size(); ++i)
    entries[fmt::format("set {:04}", i)] = order.files.settings[i];
  write_text_file(order_path(folder), to_text(entries));
}

Order read_order(const std::string& folder) {
  const std::string path = order_path(folder);
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  const JobIdentity entries = job_from_text(text.str());
  const auto known = entries.find("parts");
  if (known == entries.end())
    throw Error(ErrorKind::usage, folder, "no sheet is planned in this folder",
                "a folder made by belvedere plan");
  Order order;
  std::from_chars(known->second.data(), known->second.data() + known->second.size(), order.parts);
  std::string layer;
  for (const auto& [name, value] : entries) {
    if (name == "scene") order.scene = value;
    if (name == "layers")
      for (std::istringstream layers(value); std::getline(layers, layer, ',');)
        order.request.layers.push_back(layer);
    if (name == "servers") order.allow_http = true;
    if (name.starts_with("data ")) order.files.data_folders.push_back(value);
    if (name.starts_with("set ")) order.files.settings.push_back(value);
  }
  return order;
}

// The scene as planned; the demo has no file.
LoadedScene load_order(const Order& order, SceneOptions options) {
  options.scene = order.scene;
  options.files = order.files;
  options.allow_http = order.allow_http;
  return load(options);
}

std::string absolute(const std::string& path) {
  return path.empty() ? path : fs::absolute(path).lexically_normal().string();
}

// Options of part and join: the folder, and this machine's settings of a run.
void add_shared_folder(CommandOptions& command, PlanOptions& options) {
  command.add_option("DIR", options.folder, "The folder of the plan").required();
  add_run_options(command, options.scene);
}

}  // namespace

Action add_plan(CommandOptions& command) {
  const auto options = std::make_shared<PlanOptions>();
  add_scene_options(command, options->scene);
  add_locked_option(command, options->scene);
  add_layers_option(command, options->layers);
  command
      .add_option(
          "--out DIR", options->folder,
          "Folder that every machine can access; created if missing. Default: named like the scene")
      .files(FileUse::later);
  command.add_force(options->force);
  command.add_option("--parts N", options->parts, "Number of parts of the sheet")
      .show_default()
      .range(1, 100000);
  command.footer(
      "Computes the global choices, once. The parts can then be made in any order, by any number "
      "of machines at once, and again:\n"
      "complete parts are skipped. Scene and data must have the same paths on all machines.\n"
      "\n"
      "  belvedere plan scenes/karwendel.toml --data ../data --out karwendel --parts 8\n"
      "  for i in 1 2 3 4 5 6 7 8; do belvedere part karwendel $i; done\n"
      "  belvedere join karwendel");
  return [options] {
    const LoadedScene scene = load(options->scene);
    const std::string folder = options->folder.empty() ? scene.name : options->folder;
    file_guard().writes_into(folder, "--out", options->force, {{"order.txt"}});
    TerminalProgress progress(options->scene.quiet);
    const Cache cache = make_cache(options->scene);
    Order order{absolute(options->scene.scene),
                options->scene.files,
                options->scene.allow_http,
                options->parts,
                {}};
    order.request.layers = options->layers;
    for (std::string& data : order.files.data_folders) data = absolute(data);
    plan_sheet(load_order(order, options->scene), folder,
               make_run(options->scene, Run{}.tile_px, progress, cache), order.request);
    write_order(folder, order);
    progress.end();
    if (!options->scene.quiet) print_out(fmt::format("{}: {} parts\n", folder, options->parts));
    return 0;
  };
}

Action add_part(CommandOptions& command) {
  const auto options = std::make_shared<PlanOptions>();
  add_shared_folder(command, *options);
  command.add_option("NUMBER", options->part, "Number of the part, from 1").required();
  command.footer("  belvedere part karwendel 3");
  return [options] {
    const Order order = read_order(options->folder);
    TerminalProgress progress(options->scene.quiet);
    const Cache cache = make_cache(options->scene);
    make_part(load_order(order, options->scene), options->folder, options->part, order.parts,
              make_run(options->scene, Run{}.tile_px, progress, cache), order.request);
    return 0;
  };
}

Action add_join(CommandOptions& command) {
  const auto options = std::make_shared<PlanOptions>();
  add_shared_folder(command, *options);
  command.add_option("--out DIR", options->out, "Folder for the results. Default: that of the plan")
      .files(FileUse::later);
  command.add_force(options->force);
  command.footer(
      "Names the parts that are missing. The pieces are kept; remove the folder's .belvedere once "
      "the files are good.\n"
      "\n"
      "  belvedere join karwendel");
  return [options] {
    Order order = read_order(options->folder);
    order.request.replace = options->force;
    TerminalProgress progress(options->scene.quiet);
    const Cache cache = make_cache(options->scene);
    join_parts(load_order(order, options->scene), options->folder, order.parts,
               options->out.empty() ? options->folder : options->out,
               make_run(options->scene, Run{}.tile_px, progress, cache), order.request);
    return 0;
  };
}

}  // namespace belvedere::tools
