#include "renderer/scene/fetched_sources.h"

#include <fmt/core.h>

#include <filesystem>

#include "base/text/json.h"

namespace belvedere {
namespace {

std::string line(const char* key, const std::string& text) {
  return fmt::format("{} = {}\n", key, json_quoted(text));
}

std::string source_table(const char* section, const FetchedMap& map, const std::string& folder) {
  return fmt::format("[[{}]]\n", section) +
         line("file",
              folder.empty() ? map.file : (std::filesystem::path(folder) / map.file).string()) +
         line("origin", map.origin) + line("licence", map.licence) + line("get_from", map.get_from);
}

}  // namespace

std::string fetched_sources(const FetchedArea& area, const std::string& folder) {
  std::string out = source_table("terrain.sources", area.elevation, folder);
  if (area.land_cover)
    out += "\n[land_cover]\n" + line("legend", area.land_cover->source.legend) + "\n" +
           source_table("land_cover.sources", *area.land_cover, folder);
  return out;
}

}  // namespace belvedere
