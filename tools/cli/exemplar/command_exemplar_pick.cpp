#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/parallel.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/labels/label_points.h"
#include "renderer/labels/label_style.h"
#include "terrain/io/crs.h"
#include "tools/cli/commands.h"
#include "tools/cli/exemplar/register_options.h"
#include "tools/cli/studio/serve_page.h"
#include "tools/cli/terminal.h"
#include "tools/pick/picking.h"

namespace belvedere::tools {
namespace {

struct PickOptions : RegisterOptions {
  std::vector<std::string> names;
  PageOptions page;
};

std::vector<NamedPlace> read_named_places(const PickOptions& options, const std::string& crs,
                                          Progress& progress) {
  std::vector<NamedPlace> out;
  const LabelStyle style = load_label_style("classic");
  const int summit = style.find("summit");
  for (const std::string& file : options.names) {
    VectorSource source;
    source.path = file;
    for (const LabelPoint& point : read_label_points(source, crs, style, progress))
      out.push_back({point.name, point.position, point.kind == summit});
  }
  return out;
}

// As a shell takes it for one word.
std::string shell_word(const std::string& text) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c >= 0x80 ||
           std::string_view("_./-+=:,@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// What to do with the pairs.
std::string next_command(const PickOptions& options) {
  std::string dems;
  for (const std::string& dem : options.dems) dems += " " + shell_word(dem);
  return fmt::format("belvedere exemplar register {}{} --pairs {} --out registered",
                     shell_word(options.painting), dems, shell_word(options.pairs));
}

int run_pick(const PickOptions& options) {
  file_guard().writes(options.pairs, "--pairs");
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  progress.begin("reading", 0.0);
  PickingInput input;
  input.pairs = options.pairs;
  input.painting_name = file_name(options.painting);
  input.painting = read_painting(options.painting, progress);
  input.dem = read_dem(dem_parameters(options), progress);
  if (input.dem.crs.empty())
    throw Error(ErrorKind::usage, options.dems.front(), "has no CRS", "--crs, or a file with one");
  input.named = read_named_places(options, input.dem.crs, progress);
  input.registration = registration_parameters(options);
  input.next = next_command(options);
  input.port = options.page.port;
  Picking picking(std::move(input), progress);
  progress.end();
  serve_page(served_page(picking), options.page.headless);
  return 0;
}

}  // namespace

Action add_exemplar_pick(CommandOptions& command) {
  const auto options = std::make_shared<PickOptions>();
  add_register_options(
      command, *options,
      "The pairs that are picked, a .csv that is made if it is missing; each click "
      "is written at once");
  command.option("--pairs").files(FileUse::edits);
  command
      .add_option("--names", options->names,
                  "Names of summits and other places: a .csv, GeoPackage, GeoJSON … as for labels")
      .type_name("FILE")
      .files(FileUse::input);
  add_page_options(command, options->page);
  command.footer(
      "Opens a page with the painting beside a relief map. A click on a summit in one and a click\n"
      "in the other make a pair; from five pairs on, each proposes the other, and from eight the\n"
      "page tells how far each pair is off. Only this machine can reach it.\n"
      "\n"
      "  belvedere exemplar pick painting.jpg dem.tif --pairs pairs.csv --names summits.csv");
  return [options] { return run_pick(*options); };
}

}  // namespace belvedere::tools
