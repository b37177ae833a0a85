#include "terrain/fetch/fetched_area.h"

#include <fmt/core.h>

#include "base/files/output_file.h"
#include "base/text/json.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

std::string line(const char* key, const std::string& text) {
  return fmt::format("{} = {}\n", key, json_quoted(text));
}

std::string map_record(const FetchedMap& map) {
  const RasterFrame& frame = map.frame;
  std::string out = "\n[[fetched]]\n" + line("file", map.file) + line("hash", map.hash) +
                    line("source", map.source.id) + line("credit", map.source.credit) +
                    line("licence", map.source.licence) + line("crs", describe_crs(frame.crs)) +
                    fmt::format("width = {}\nheight = {}\ncell_m = {}\nwest = {}\nnorth = {}\n",
                                frame.width, frame.height, frame.transform.cell_x,
                                frame.transform.origin_x, frame.transform.origin_y);
  for (const FetchedTile& tile : map.tiles) {
    out += "\n[[fetched.tiles]]\n" + line("name", tile.name) + line("address", tile.address);
    if (tile.about.missing) {
      out += "missing = true\n";
      continue;
    }
    out += fmt::format("bytes = {}\n", tile.about.bytes);
    if (!tile.about.tag.empty()) out += line("tag", tile.about.tag);
    out += line("cells_hash", tile.hash);
  }
  return out;
}

}  // namespace

std::string fetch_record(const FetchParameters& parameters, const FetchedArea& area,
                         const RecordHead& head) {
  std::string out =
      "# Written by belvedere fetch. The first tables can be copied into a scene; the others give "
      "the source of every cell:\n# hashes as in belvedere lock, tags as sent by the servers.\n\n";
  if (head) out += head(area);
  out += fmt::format("\n[request]\nat = [{}, {}]\nsize_km = [{}, {}]\n", parameters.at_lonlat.x,
                     parameters.at_lonlat.y, parameters.size_km.x, parameters.size_km.y);
  out += map_record(area.elevation);
  if (area.land_cover) out += map_record(*area.land_cover);
  return out;
}

void write_fetch_record(const std::string& path, const FetchParameters& parameters,
                        const FetchedArea& area, const RecordHead& head) {
  write_text_file(path, fetch_record(parameters, area, head));
}

}  // namespace belvedere
