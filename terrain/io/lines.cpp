#include "terrain/io/lines.h"

#include <fmt/core.h>

#include <utility>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/features.h"

namespace belvedere {

std::vector<MapLine> read_lines(const VectorSource& source, const std::string& crs) {
  const std::string& path = source.path;
  MapFeatures file = read_map_features(source, {.also = {"name"}}, crs);
  if (file.unplaceable > 0)
    throw Error(ErrorKind::input, path,
                fmt::format("{} of its features have positions outside the valid area of {}",
                            file.unplaceable, describe_crs(crs)));
  std::vector<MapLine> lines;
  for (MapFeature& feature : file.features)
    if (feature.shape == MapShape::line)
      lines.push_back({.name = feature.values[0],
                       .where = feature.where,
                       .positions = std::move(feature.parts.front())});
  if (lines.empty()) throw Error(ErrorKind::input, path, "has no lines", "tracks, routes or lines");
  return lines;
}

}  // namespace belvedere
