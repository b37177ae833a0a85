#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
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

constexpr std::size_t most_features = 2000000;
constexpr std::size_t most_places = 30000000;

using Row = std::vector<glm::dvec2>;

// False where a place is no number.
bool take_row(OGRGeometryH geometry, Row& row) {
  const int count = OGR_G_GetPointCount(geometry);
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 place{OGR_G_GetX(geometry, i), OGR_G_GetY(geometry, i)};
    if (!std::isfinite(place.x) || !std::isfinite(place.y)) return false;
    if (row.empty() || row.back() != place) row.push_back(place);
  }
  return true;
}

// One geometry of a feature, or the parts of a collection; false where one is not to be had.
bool add_shapes(OGRGeometryH geometry, std::vector<MapFeature>& to) {
  if (geometry == nullptr || OGR_G_IsEmpty(geometry) != 0) return false;
  MapFeature feature;
  switch (wkbFlatten(OGR_G_GetGeometryType(geometry))) {
    case wkbPoint:
    case wkbLineString: {
      Row row;
      feature.shape = wkbFlatten(OGR_G_GetGeometryType(geometry)) == wkbPoint ? MapShape::point : MapShape::line;
      if (!take_row(geometry, row) || (feature.shape == MapShape::line && row.size() < 2)) return false;
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
    case wkbMultiPoint:
    case wkbMultiLineString:
    case wkbMultiPolygon:
    case wkbGeometryCollection: {
      bool all = true;
      for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
        if (!add_shapes(OGR_G_GetGeometryRef(geometry, i), to)) all = false;
      return all;
    }
    default: {  // curves and surfaces, as chords
      OGRGeometryH linear = OGR_G_GetLinearGeometry(geometry, 0.0, nullptr);
      const bool changed = linear != nullptr && OGR_G_GetGeometryType(linear) != OGR_G_GetGeometryType(geometry);
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
    for (const glm::dvec2 place : row)
      if (place != glm::dvec2(0.0)) return false;
  return true;
}

// Places of many features brought over at once; those with a place that has no image, or beside the box, are let go.
void bring_over(std::vector<MapFeature>&& features, const PointTransform& transform, const std::optional<MapBox>& box, MapFeatures& all) {
  Row places;
  for (const MapFeature& feature : features)
    for (const Row& row : feature.parts) places.insert(places.end(), row.begin(), row.end());
  transform.apply(places);
  std::size_t next = 0;
  for (MapFeature& feature : features) {
    const bool at_zero = is_at_zero(feature);
    bool whole = true;
    MapBox extent = {places[next], places[next]};
    for (Row& row : feature.parts)
      for (glm::dvec2& place : row) {
        place = places[next++];
        whole = whole && std::isfinite(place.x) && std::isfinite(place.y);
        extent.low = glm::min(extent.low, place);
        extent.high = glm::max(extent.high, place);
      }
    all.at_zero += at_zero ? 1 : 0;
    if (!whole) {
      ++all.unplaceable;
      continue;
    }
    const bool first = all.features.empty() && all.beside == 0;
    all.extent.low = first ? extent.low : glm::min(all.extent.low, extent.low);
    all.extent.high = first ? extent.high : glm::max(all.extent.high, extent.high);
    if (box && (extent.high.x < box->low.x || extent.high.y < box->low.y || extent.low.x > box->high.x || extent.low.y > box->high.y))
      ++all.beside;
    else
      all.features.push_back(std::move(feature));
  }
  features.clear();
}

std::vector<int> columns_of(OGRLayerH layer, const MapQuery& query) {
  std::vector<int> columns;
  // OGR knows capital and small letters as the same.
  for (const std::vector<std::string>* names : {&query.columns, &query.also})
    for (const std::string& name : *names) columns.push_back(OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), name.c_str()));
  return columns;
}

class Reader {
 public:
  Reader(const std::string& path, const MapQuery& query, const std::string& crs) : path_(path), query_(query), crs_(crs) {}

  MapFeatures read(GDALDatasetH file) {
    std::vector<OGRLayerH> layers;
    std::vector<std::string> names;
    for (int i = 0; i < GDALDatasetGetLayerCount(file); ++i) {
      OGRLayerH layer = GDALDatasetGetLayer(file, i);
      if (layer == nullptr) continue;
      names.emplace_back(OGR_L_GetName(layer));
      // GPX gives the places of its tracks and routes once more, as points.
      if (query_.layer.empty() && (names.back() == "track_points" || names.back() == "route_points")) continue;
      if (query_.layer.empty() || names.back() == query_.layer) layers.push_back(layer);
    }
    if (layers.empty())
      throw Error(ErrorKind::usage, path_, query_.layer.empty() ? "no layer in it" : fmt::format("there is no layer \"{}\"", query_.layer),
                  fmt::format("{}", fmt::join(names, ", ")));
    require_columns(layers);
    std::string refused;
    std::vector<OGRLayerH> understood;
    for (OGRLayerH layer : layers) {
      // Of several layers, those that lack a column of the filter have nothing of what it asks for.
      const GdalErrors errors;
      if (!query_.where.empty() && OGR_L_SetAttributeFilter(layer, query_.where.c_str()) != OGRERR_NONE) {
        refused = errors.say(fmt::format("the filter \"{}\" is not understood", query_.where));
        continue;
      }
      understood.push_back(layer);
    }
    if (understood.empty()) throw Error(ErrorKind::usage, path_, refused, "a condition as in SQL, such as \"highway = 'primary'\"");
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
        for (int i = 0; i < OGR_FD_GetFieldCount(fields); ++i) known.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(fields, i)));
      }
      std::sort(known.begin(), known.end());
      known.erase(std::unique(known.begin(), known.end()), known.end());
      if (!found)
        throw Error(ErrorKind::usage, path_, fmt::format("there is no column \"{}\"", column), fmt::format("{}", fmt::join(known, ", ")));
    }
  }

  // What waits to be brought over, of one layer.
  struct Pending {
    std::vector<int> columns;
    std::vector<MapFeature> found = {};
    std::size_t places = 0;
    std::optional<PointTransform> transform = {};  // made when a feature is there: a layer without one needs no CRS
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
    if (errors.failed()) throw Error(ErrorKind::input, path_, errors.say("cannot be read to its end"));
    bring(layer, pending);
  }

  // All layers at once, as formats have it whose file is not sorted by layers.
  void read_mixed(GDALDatasetH file, const std::vector<OGRLayerH>& layers) {
    std::vector<std::pair<OGRLayerH, Pending>> all;
    for (OGRLayerH layer : layers) all.emplace_back(layer, Pending{columns_of(layer, query_)});
    const GdalErrors errors;
    GDALDatasetResetReading(file);
    while (true) {
      OGRLayerH from = nullptr;
      const VectorFeature feature(GDALDatasetGetNextFeature(file, &from, nullptr, nullptr, nullptr), &OGR_F_Destroy);
      if (feature == nullptr) break;
      for (auto& [layer, pending] : all)
        if (layer == from) take(feature.get(), layer, pending);
    }
    if (errors.failed()) throw Error(ErrorKind::input, path_, errors.say("cannot be read to its end"));
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
      for (const Row& row : found[i].parts) pending.places += row.size();
      for (const int column : pending.columns)
        found[i].values.emplace_back(
            column >= 0 && OGR_F_IsFieldSetAndNotNull(feature, column) != 0 ? OGR_F_GetFieldAsString(feature, column) : "");
    }
    if (pending.places > places_at_once) bring(layer, pending);
  }

  void bring(OGRLayerH layer, Pending& pending) {
    if (pending.found.empty()) return;
    if (!pending.transform) {
      const std::string own_crs = layer_crs(layer, path_);
      if (own_crs.empty()) throw Error(ErrorKind::input, path_, "its layer has no CRS", "a layer that says its CRS");
      pending.transform.emplace(own_crs, crs_);
    }
    const std::size_t before = all_.features.size();
    bring_over(std::move(pending.found), *pending.transform, query_.box, all_);
    pending.found.clear();
    pending.places = 0;
    for (std::size_t i = before; i < all_.features.size(); ++i)
      for (const Row& row : all_.features[i].parts) places_ += row.size();
    if (all_.features.size() > most_features) throw Error(ErrorKind::limit, path_, fmt::format("more than {} features", most_features));
    if (places_ > most_places) throw Error(ErrorKind::limit, path_, fmt::format("features of more than {} places", most_places));
  }

  const std::string& path_;
  const MapQuery& query_;
  const std::string& crs_;
  MapFeatures all_;
  std::size_t places_ = 0;
};

}  // namespace

MapFeatures read_map_features(const std::string& path, const MapQuery& query, const std::string& crs) {
  if (crs.empty()) throw Error(ErrorKind::usage, path, "the terrain has no CRS", "terrain that says its CRS");
  const Dataset file = open_vector_layers(path, {".gpx", ".gpkg", ".geojson", ".json", ".shp", ".fgb", ".osm", ".pbf"},
                                          "is no file of features", ".gpkg, .geojson, .json, .shp, .fgb, .gpx, .osm or .pbf");
  return Reader(path, query, crs).read(file.get());
}

}  // namespace belvedere
