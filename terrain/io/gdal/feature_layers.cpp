#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/features.h"
#include "terrain/io/gdal/vector_layers.h"

namespace belvedere {
namespace {

constexpr std::size_t max_features = 2000000;

using Row = std::vector<glm::dvec2>;

// False if a coordinate is not a number.
bool take_row(OGRGeometryH geometry, Row& row) {
  const int count = OGR_G_GetPointCount(geometry);
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 position{OGR_G_GetX(geometry, i), OGR_G_GetY(geometry, i)};
    if (!std::isfinite(position.x) || !std::isfinite(position.y)) return false;
    if (row.empty() || row.back() != position) row.push_back(position);
  }
  return true;
}

// Loggers write each point as a segment of its own: consecutive ones are the positions of one line.
Row joined_points(OGRGeometryH lines) {
  Row row;
  for (int i = 0; i < OGR_G_GetGeometryCount(lines); ++i) {
    OGRGeometryH part = OGR_G_GetGeometryRef(lines, i);
    if (OGR_G_GetPointCount(part) != 1 || !take_row(part, row)) return {};
  }
  return row;
}

// Converts one geometry of a feature, or the parts of a collection; false if that is impossible.
bool add_shapes(OGRGeometryH geometry, std::vector<MapFeature>& to) {
  if (geometry == nullptr || OGR_G_IsEmpty(geometry) != 0) return false;
  MapFeature feature;
  switch (wkbFlatten(OGR_G_GetGeometryType(geometry))) {
    case wkbPoint:
    case wkbLineString: {
      Row row;
      feature.shape = wkbFlatten(OGR_G_GetGeometryType(geometry)) == wkbPoint ? MapShape::point
                                                                              : MapShape::line;
      if (!take_row(geometry, row) || (feature.shape == MapShape::line && row.size() < 2))
        return false;
      feature.parts.push_back(std::move(row));
      break;
    }
    case wkbPolygon: {
      feature.shape = MapShape::area;
      for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) {
        Row ring;
        if (!take_row(OGR_G_GetGeometryRef(geometry, i), ring)) return false;
        if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
        if (ring.size() >= 3)
          feature.parts.push_back(std::move(ring));
        else if (i == 0)
          return false;
      }
      if (feature.parts.empty()) return false;
      break;
    }
    case wkbMultiLineString:
      if (Row row = joined_points(geometry); row.size() > 1) {
        feature.parts.push_back(std::move(row));
        break;
      }
      [[fallthrough]];
    case wkbMultiPoint:
    case wkbMultiPolygon:
    case wkbGeometryCollection: {
      bool all = true;
      for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
        if (!add_shapes(OGR_G_GetGeometryRef(geometry, i), to)) all = false;
      return all;
    }
    default: {  // curves and surfaces, as chords
      OGRGeometryH linear = OGR_G_GetLinearGeometry(geometry, 0.0, nullptr);
      const bool changed =
          linear != nullptr && OGR_G_GetGeometryType(linear) != OGR_G_GetGeometryType(geometry);
      const bool taken = changed && add_shapes(linear, to);
      OGR_G_DestroyGeometry(linear);
      return taken;
    }
  }
  to.push_back(std::move(feature));
  return true;
}

bool is_at_zero(const MapFeature& feature) {
  for (const Row& row : feature.parts)
    for (const glm::dvec2 position : row)
      if (position != glm::dvec2(0.0)) return false;
  return true;
}

Row positions_of(const std::vector<MapFeature>& features) {
  Row positions;
  for (const MapFeature& feature : features)
    for (const Row& row : feature.parts) positions.insert(positions.end(), row.begin(), row.end());
  return positions;
}

// Transforms the positions of many features at once; drops features with a position that cannot be
// transformed or outside the box.
void bring_over(std::vector<MapFeature>&& features, Row positions, const PointTransform& transform,
                const std::optional<MapBox>& box, MapFeatures& all) {
  transform.apply(positions);
  std::size_t next = 0;
  for (MapFeature& feature : features) {
    const bool at_zero = is_at_zero(feature);
    bool whole = true;
    MapBox extent = {positions[next], positions[next]};
    for (Row& row : feature.parts)
      for (glm::dvec2& position : row) {
        position = positions[next++];
        whole = whole && std::isfinite(position.x) && std::isfinite(position.y);
        extent.low = glm::min(extent.low, position);
        extent.high = glm::max(extent.high, position);
      }
    all.at_zero += at_zero ? 1 : 0;
    if (!whole) {
      ++all.unplaceable;
      continue;
    }
    const bool first = all.features.empty() && all.beside == 0;
    all.extent.low = first ? extent.low : glm::min(all.extent.low, extent.low);
    all.extent.high = first ? extent.high : glm::max(all.extent.high, extent.high);
    if (box && (extent.high.x < box->low.x || extent.high.y < box->low.y ||
                extent.low.x > box->high.x || extent.low.y > box->high.y))
      ++all.beside;
    else
      all.features.push_back(std::move(feature));
  }
  features.clear();
}

std::vector<int> columns_of(OGRLayerH layer, const MapQuery& query) {
  std::vector<int> columns;
  // OGR compares names without case.
  for (const std::vector<std::string>* names : {&query.columns, &query.also})
    for (const std::string& name : *names)
      columns.push_back(OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), name.c_str()));
  return columns;
}

class Reader {
 public:
  Reader(const VectorSource& source, const MapQuery& query, const std::string& crs)
      : source_(source), path_(source.path), query_(query), crs_(crs) {}

  MapFeatures read(GDALDatasetH file) {
    std::vector<OGRLayerH> layers;
    std::vector<std::string> names;
    for (int i = 0; i < GDALDatasetGetLayerCount(file); ++i) {
      OGRLayerH layer = GDALDatasetGetLayer(file, i);
      if (layer == nullptr) continue;
      names.emplace_back(OGR_L_GetName(layer));
      // GPX repeats the positions of its tracks and routes as points.
      if (query_.layer.empty() &&
          (names.back() == "track_points" || names.back() == "route_points"))
        continue;
      if (query_.layer.empty() || names.back() == query_.layer) layers.push_back(layer);
    }
    if (layers.empty())
      throw Error(
          ErrorKind::usage, path_,
          query_.layer.empty() ? "has no layers" : fmt::format("no layer \"{}\"", query_.layer),
          fmt::format("{}", fmt::join(names, ", ")));
    require_columns(layers);
    std::string refused;
    std::vector<OGRLayerH> understood;
    for (OGRLayerH layer : layers) {
      // A layer that lacks a column of the filter has no matches; the filter is invalid only if no
      // layer has it.
      const GdalErrors errors;
      if (!query_.where.empty() &&
          OGR_L_SetAttributeFilter(layer, query_.where.c_str()) != OGRERR_NONE) {
        refused = errors.say(fmt::format("invalid filter \"{}\"", query_.where));
        continue;
      }
      understood.push_back(layer);
    }
    if (understood.empty())
      throw Error(ErrorKind::usage, path_, refused,
                  "an SQL condition such as \"highway = 'primary'\"");
    if (std::string(GDALGetDriverShortName(GDALGetDatasetDriver(file))) == "OSM")
      read_mixed(file, understood);
    else
      for (OGRLayerH layer : understood) read_layer(layer);
    return std::move(all_);
  }

 private:
  void require_columns(const std::vector<OGRLayerH>& layers) const {
    for (const std::string& column : query_.columns) {
      std::vector<std::string> known;
      bool found = false;
      for (OGRLayerH layer : layers) {
        OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
        found = found || OGR_FD_GetFieldIndex(fields, column.c_str()) >= 0;
        for (int i = 0; i < OGR_FD_GetFieldCount(fields); ++i)
          known.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(fields, i)));
      }
      std::sort(known.begin(), known.end());
      known.erase(std::unique(known.begin(), known.end()), known.end());
      if (!found)
        throw Error(ErrorKind::usage, path_, fmt::format("no column \"{}\"", column),
                    fmt::format("{}", fmt::join(known, ", ")));
    }
  }

  // Features of one layer that wait to be transformed.
  struct Pending {
    std::vector<int> columns;
    std::vector<MapFeature> found = {};
    std::size_t positions = 0;
    std::string crs = {};  // of the layer
    std::optional<PointTransform> transform =
        {};  // made for the first feature: a layer without features needs no CRS
  };

  void read_layer(OGRLayerH layer) {
    Pending pending{columns_of(layer, query_)};
    const GdalErrors errors;
    OGR_L_ResetReading(layer);
    while (true) {
      const VectorFeature feature(OGR_L_GetNextFeature(layer), &OGR_F_Destroy);
      if (feature == nullptr) break;
      take(feature.get(), layer, pending);
    }
    if (errors.failed())
      throw Error(ErrorKind::input, path_, errors.say("cannot read the whole file"));
    bring(layer, pending);
  }

  // All layers at once, for formats whose files are not sorted by layers.
  void read_mixed(GDALDatasetH file, const std::vector<OGRLayerH>& layers) {
    std::vector<std::pair<OGRLayerH, Pending>> all;
    for (OGRLayerH layer : layers) all.emplace_back(layer, Pending{columns_of(layer, query_)});
    const GdalErrors errors;
    GDALDatasetResetReading(file);
    while (true) {
      OGRLayerH from = nullptr;
      const VectorFeature feature(GDALDatasetGetNextFeature(file, &from, nullptr, nullptr, nullptr),
                                  &OGR_F_Destroy);
      if (feature == nullptr) break;
      for (auto& [layer, pending] : all)
        if (layer == from) take(feature.get(), layer, pending);
    }
    if (errors.failed())
      throw Error(ErrorKind::input, path_, errors.say("cannot read the whole file"));
    for (auto& [layer, pending] : all) bring(layer, pending);
  }

  void take(OGRFeatureH feature, OGRLayerH layer, Pending& pending) {
    constexpr std::size_t places_at_once = std::size_t{1} << 20;
    ++all_.read;
    std::vector<MapFeature>& found = pending.found;
    const std::size_t before = found.size();
    if (!add_shapes(OGR_F_GetGeometryRef(feature), found)) ++all_.without_shape;
    for (std::size_t i = before; i < found.size(); ++i) {
      found[i].where = fmt::format("{}, {} {}", path_, OGR_L_GetName(layer), OGR_F_GetFID(feature));
      for (const Row& row : found[i].parts) pending.positions += row.size();
      for (const int column : pending.columns)
        found[i].values.push_back(field_text(feature, column, path_, found[i].where));
    }
    if (pending.positions > places_at_once) bring(layer, pending);
  }

  void bring(OGRLayerH layer, Pending& pending) {
    if (pending.found.empty()) return;
    if (!pending.transform) {
      pending.crs = layer_crs(layer, source_);
      if (pending.crs.empty())
        throw Error(ErrorKind::input, path_, "its layer has no CRS", missing_crs_advice);
      pending.transform.emplace(pending.crs, crs_);
    }
    const std::size_t before = all_.features.size();
    Row positions = positions_of(pending.found);
    require_degrees(positions, pending.crs, crs_, source_, pending.found.front().where);
    bring_over(std::move(pending.found), std::move(positions), *pending.transform, query_.box,
               all_);
    pending.found.clear();
    pending.positions = 0;
    for (std::size_t i = before; i < all_.features.size(); ++i)
      for (const Row& row : all_.features[i].parts) positions_ += row.size();
    if (all_.features.size() > max_features)
      throw Error(ErrorKind::limit, path_, fmt::format("more than {} features", max_features));
    if (positions_ > query_.max_positions)
      throw Error(ErrorKind::limit, path_,
                  fmt::format("features with more than {} positions", query_.max_positions));
  }

  const VectorSource& source_;
  const std::string& path_;
  const MapQuery& query_;
  const std::string& crs_;
  MapFeatures all_;
  std::size_t positions_ = 0;
};

}  // namespace

MapFeatures read_map_features(const VectorSource& source, const MapQuery& query,
                              const std::string& crs) {
  const std::string& path = source.path;
  if (crs.empty())
    throw Error(ErrorKind::usage, path, "the terrain has no CRS", "terrain with a CRS");
  const Dataset file = open_vector_layers(
      source, {".gpx", ".gpkg", ".geojson", ".shp", ".fgb", ".osm", ".pbf"}, "not a vector file",
      ".gpkg, .geojson, .json, .geojsonl, .ndjson, .shp, .fgb, .gpx, .osm or .pbf");
  return Reader(source, query, crs).read(file.get());
}

}  // namespace belvedere
