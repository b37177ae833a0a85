#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/web/web_page.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

struct WebOptions {
  std::string from;
  std::string out;
  std::string name;
  std::vector<std::string> also;
  WebParameters page;
  int threads = 0;
  bool quiet = false;
};

std::string name_of(const std::string& folder) {
  return fs::weakly_canonical(folder).filename().string();
}

// DIR or DIR=NAME; an existing folder whose name contains = is a folder.
WebPicture picture_of(const std::string& text) {
  const std::size_t mark = text.rfind('=');
  if (mark == std::string::npos || fs::exists(text)) return {text, name_of(text)};
  return {text.substr(0, mark), text.substr(mark + 1)};
}

}  // namespace

Action add_web(CommandOptions& command) {
  const auto options = std::make_shared<WebOptions>();
  command.add_option("DIR", options->from, "A folder written by belvedere render").required();
  command.add_option("--out DIR", options->out, "Folder of the page. Default: DIR/web")
      .files(FileUse::later);
  command.add_option(
      "--name", options->name,
      "Name of the picture beside others, such as Summer. Default: its folder's name");
  command
      .add_option("--also DIR[=NAME]", options->also,
                  "Another picture of the same view, compared by a movable divider; may be "
                  "repeated: --also winter=Winter")
      .repeated();
  command
      .add_option("--cells N", options->page.ground_cells,
                  "Number of positions of the picture with coordinates in the page; 9 bytes each")
      .show_default()
      .range(100, 20000000);
  command.add_force(options->page.replace);
  command.add_option("--threads N", options->threads, "Number of threads; 0: all").range(0, 1024);
  command.add_flag("-q,--quiet", options->quiet, "No progress and no notes");
  command.footer(
      "Writes an interactive panorama: one folder that needs no server. Open index.html, or copy "
      "the folder to any web space. The page shows\n"
      "position, altitude, distance and class under the pointer (from guidance.exr) and the names "
      "of [labels]; a GPX file dropped on it is drawn.\n"
      "\n"
      "  belvedere render scenes/karwendel_features.toml --data ../data --out karwendel\n"
      "  belvedere web karwendel\n"
      "  belvedere web karwendel --name Summer --also karwendel_winter=Winter --out page");
  return [options] {
    const ThreadLimit threads(options->threads);
    const std::string out =
        options->out.empty() ? (fs::path(options->from) / "web").string() : options->out;
    std::vector<WebPicture> pictures = {
        {options->from, options->name.empty() ? name_of(options->from) : options->name}};
    for (const std::string& text : options->also) pictures.push_back(picture_of(text));
    for (const WebPicture& picture : pictures)
      if (!fs::is_directory(picture.folder))
        throw Error(ErrorKind::input, picture.folder, "is not a folder",
                    "a folder written by belvedere render");
    TerminalProgress progress(options->quiet);
    write_web_page(pictures, out, options->page, progress);
    progress.end();
    if (!options->quiet) print_out((fs::path(out) / "index.html").string() + "\n");
    return 0;
  };
}

}  // namespace belvedere::tools
