#include "tools/report/segment_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "base/files/output_file.h"
#include "base/land_cover_class.h"
#include "base/text/base64.h"
#include "base/text/embedded.h"
#include "base/text/json.h"
#include "base/text/markup.h"
#include "texture/segment/segment.h"
#include "tools/report/data_uri.h"

namespace belvedere::tools {
namespace {

constexpr int widest_shown = 1400;  // px; the mask keeps the painting's own size

// Run-length coding of pieces: two bytes of the piece, low first, and the run's length in groups of
// seven bits, low first, all but the last flagged.
std::string runs_of(const Grid<std::uint16_t>& pieces) {
  std::string out;
  for (std::size_t at = 0; at < pieces.size();) {
    std::size_t end = at + 1;
    while (end < pieces.size() && pieces[end] == pieces[at]) ++end;
    out += static_cast<char>(pieces[at] & 255);
    out += static_cast<char>(pieces[at] >> 8);
    for (std::size_t length = end - at; length > 0; length >>= 7)
      out += static_cast<char>((length & 127U) | (length > 127U ? 128U : 0U));
    at = end;
  }
  return out;
}

std::string script_data(const std::string& mask_name, const Grid<glm::vec3>& picture,
                        const PaintingSegments& segments, std::size_t groups) {
  Json joins = Json::array();
  for (const auto& join : segments.tree.joins) joins.add(Json::numbers(join));
  Json classes = Json::array();
  for (const LandCoverClassInfo& info : land_cover_classes())
    classes.add(Json::object()
                    .add("number", Json::number(static_cast<double>(info.id)))
                    .add("name", Json::text(info.name))
                    .add("colour", Json::text(fmt::format("#{:06x}", info.rgb))));
  return script_json(
      Json::object()
          .add("width", Json::number(picture.width()))
          .add("height", Json::number(picture.height()))
          .add("mask", Json::text(mask_name))
          .add("groups", Json::numbers(cut_nodes(segments.tree, groups)))
          .add("inferred", Json::numbers(segments.inferred))
          .add("joins", std::move(joins))
          .add("classes", std::move(classes))
          .add("pieces", Json::text(base64(runs_of(segments.pieces))))
          .add("picture", Json::text(png_address(reduce_blocks(
                              picture, (picture.width() + widest_shown - 1) / widest_shown))))
          .str());
}

}  // namespace

void write_segment_page(const std::string& path, const std::string& title,
                        const std::string& mask_name, const Grid<glm::vec3>& picture,
                        const PaintingSegments& segments, std::size_t groups) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int factor = (picture.width() + widest_shown - 1) / widest_shown;
  const std::string text =
      filled_page(embedded_file("segment/index.html"),
                  {{"title", markup_text(title)},
                   {"mask", markup_text(mask_name)},
                   {"width", fmt::format("{}", (picture.width() + factor - 1) / factor)},
                   {"height", fmt::format("{}", (picture.height() + factor - 1) / factor)},
                   {"css", std::string(embedded_file("segment/segment.css"))},
                   {"data", script_data(mask_name, picture, segments, groups)},
                   {"groups", std::string(embedded_file("segment/groups.js"))},
                   {"page", std::string(embedded_file("segment/segment.js"))}});
  write_text_file(path, text);
}

}  // namespace belvedere::tools
