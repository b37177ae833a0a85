#include "tools/report/segment_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "base/land_cover_class.h"
#include "base/text/base64.h"
#include "base/text/embedded.h"
#include "base/text/json.h"
#include "base/text/markup.h"
#include "renderer/image/output_file.h"
#include "texture/segment/segment.h"
#include "tools/report/data_uri.h"
#include "tools/report/json_numbers.h"
#include "tools/report/report_folder.h"

namespace belvedere::tools {
namespace {

constexpr int widest_shown = 1400;  // px; the mask keeps the painting's own size

// Runs of equal pieces: two bytes of the piece, low first, and the run's length in sevens of bits, low first, all but the last marked.
std::string runs_of(const Grid<std::uint16_t>& pieces) {
  std::string out;
  for (std::size_t at = 0; at < pieces.size();) {
    std::size_t end = at + 1;
    while (end < pieces.size() && pieces[end] == pieces[at]) ++end;
    out += static_cast<char>(pieces[at] & 255);
    out += static_cast<char>(pieces[at] >> 8);
    for (std::size_t length = end - at; length > 0; length >>= 7) out += static_cast<char>((length & 127U) | (length > 127U ? 128U : 0U));
    at = end;
  }
  return out;
}

std::string script_data(const std::string& folder, const std::string& mask_name, const Grid<glm::vec3>& picture,
                        const PaintingSegments& segments, std::size_t groups) {
  Json joins = Json::array();
  for (const auto& join : segments.tree.joins) joins.add(json_numbers(join));
  Json classes = Json::array();
  for (const LandCoverClassInfo& info : land_cover_classes())
    classes.add(Json::object()
                    .add("number", Json::number(static_cast<double>(info.id)))
                    .add("name", Json::text(info.name))
                    .add("colour", Json::text(fmt::format("#{:06x}", info.rgb))));
  std::string text =
      Json::object()
          .add("width", Json::number(picture.width()))
          .add("height", Json::number(picture.height()))
          .add("mask", Json::text(mask_name))
          .add("groups", json_numbers(cut_nodes(segments.tree, groups)))
          .add("guess", json_numbers(segments.guess))
          .add("joins", std::move(joins))
          .add("classes", std::move(classes))
          .add("pieces", Json::text(base64(runs_of(segments.pieces))))
          .add("picture", Json::text(png_address(reduce_blocks(picture, (picture.width() + widest_shown - 1) / widest_shown), folder)))
          .str();
  // A file name must not end the script.
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 2)) text.replace(at, 2, "<\\/");
  return text;
}

}  // namespace

void write_segment_page(const std::string& path, const std::string& title, const std::string& mask_name, const Grid<glm::vec3>& picture,
                        const PaintingSegments& segments, std::size_t groups) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int factor = (picture.width() + widest_shown - 1) / widest_shown;
  const std::string text = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Groups of {0}</title>\n<style>\n{1}</style></head>\n<body>\n"
      "<h1>Groups of {0}</h1>\n<p>Click a group to choose it, then name it in the list. <kbd>m</kbd> and a click, or a click with "
      "<kbd>Shift</kbd>, merges another one into it; <kbd>s</kbd> splits it; <kbd>u</kbd> undoes, <kbd>r</kbd> does again; arrows go "
      "from group to group, <kbd>n</kbd> to the chosen one's name; <kbd>d</kbd> saves the mask.</p>\n"
      "<main><div id=\"shown\"><canvas id=\"painting\" tabindex=\"0\" width=\"{2}\" height=\"{3}\"></canvas></div>\n<div id=\"side\">"
      "<button id=\"merge\">Merge</button><button id=\"split\">Split</button><button id=\"undo\">Undo</button>"
      "<button id=\"redo\">Redo</button><button id=\"save\">Save {4}</button><p id=\"says\" role=\"status\">&nbsp;</p>\n"
      "<div id=\"groups\"><table><thead><tr><th></th><th>group</th><th>share</th><th>shows</th></tr></thead><tbody id=\"rows\"></tbody>"
      "</table></div>\n<p>In a scene: <code>[[exemplar]] picture = \"{0}\", classes = \"{4}\"</code></p></div></main>\n"
      "<script>\nconst segments = {5};\n</script>\n<script>\n{6}</script>\n<script>\n{7}</script>\n</body></html>\n",
      markup_text(title), embedded_file("segment/segment.css"), (picture.width() + factor - 1) / factor,
      (picture.height() + factor - 1) / factor, markup_text(mask_name),
      script_data(folder.empty() ? "." : folder.string(), mask_name, picture, segments, groups), embedded_file("segment/groups.js"),
      embedded_file("segment/segment.js"));
  write_text_file(path, text);
}

}  // namespace belvedere::tools
