#include "terrain/climate/climate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "terrain/climate/default_climate.h"
#include "terrain/climate/station_regions.h"
#include "terrain/climate/stations.h"
#include "terrain/io/block_means.h"

namespace belvedere {
namespace {

constexpr std::size_t months = 12;
constexpr double node_spacing_m = 50000.0;
constexpr double region_node_spacing_m = 2000.0;  // where stations form regions, which are smaller
constexpr int max_region_nodes = 65;              // on a side
constexpr double coarse_m = 1000.0;
constexpr double min_map_for_wind_m = 40000.0;
constexpr double min_lapse = -5.0;
constexpr double largest_lapse = 12.0;

// State while a climate is made: the map and the parts of the climate.
class Maker {
 public:
  Maker(const Dem& dem, const ClimateParameters& parameters, Progress& progress)
      : dem_(dem), p_(parameters), progress_(progress) {
    const auto require = [](bool good, const char* where, double found, const char* allowed) {
      if (!good) throw Error(ErrorKind::usage, where, fmt::format("{}", found), allowed);
    };
    require(p_.temperature_factor >= 0.001 && p_.temperature_factor <= 1000.0, "temperature_factor",
            p_.temperature_factor, "0.001 … 1000");
    require(p_.rain_factor >= 0.05 && p_.rain_factor <= 20.0, "rain_factor", p_.rain_factor,
            "0.05 … 20");
    require(p_.sheltered >= 0.0 && p_.sheltered <= 1.0, "sheltered", p_.sheltered, "0 … 1");
    require(std::abs(p_.warmer_k) <= 30.0, "warmer_k", p_.warmer_k, "-30 … 30 K");
    require(p_.wetter >= -0.95 && p_.wetter <= 10.0, "wetter", p_.wetter, "-0.95 … 10");
    if (p_.lapse_k_per_km)
      require(*p_.lapse_k_per_km >= min_lapse && *p_.lapse_k_per_km <= largest_lapse,
              "lapse_k_per_km", *p_.lapse_k_per_km, "-5 … 12 K/km");
    climate_.position =
        make_map_position(dem.transform, dem.crs, dem.width(), dem.height(), p_.latitude_deg);
    const MapPosition& position = climate_.position;
    climate_.coarse_cells = std::max(
        1,
        static_cast<int>(std::lround(coarse_m / std::max(position.cell_m.x, position.cell_m.y))));
    ground_m_ = block_means(dem.altitude_m, climate_.coarse_cells);
    const auto cells = static_cast<double>(climate_.coarse_cells);
    coarse_ = dem.transform;
    coarse_.cell_x *= cells;
    coarse_.cell_y *= cells;
  }

  void set_default(const DefaultClimate& fallback) {
    const MapPosition& position = climate_.position;
    const auto count = [](int cells, double cell_m) {
      return 2 + static_cast<int>(cells * cell_m / node_spacing_m);
    };
    climate_.nodes = Grid<PlaceClimate>(count(position.width, position.cell_m.x),
                                        count(position.height, position.cell_m.y));
    for (int y = 0; y < climate_.nodes.height(); ++y)
      for (int x = 0; x < climate_.nodes.width(); ++x) {
        const glm::dvec2 cell = cell_of_node(x, y);
        climate_.nodes(x, y) = fallback(
            {position.longitude_deg.at(cell.x, cell.y), position.latitude_deg.at(cell.x, cell.y)});
      }
    if (p_.sheltered > 0.0) shelter_nodes();
    if (!p_.stations.empty() &&
        station_regions(stations().stations, [](const Station&) { return true; }).size() > 1)
      refine_nodes();
  }

  void set_temperature() {
    const bool by_stations = !p_.stations.empty() && stations().has_temperature();
    if (by_stations)
      from_stations();
    else if (p_.temperature)
      from_temperature_raster();
    else
      tell("temperature: from latitude, longitude and altitude only");
    if (p_.lapse_k_per_km) set_lapse();
    if (p_.warmer_k == 0.0) return;
    for (PlaceClimate& node : climate_.nodes)
      for (double& month_c : node.sea_level_c) month_c += p_.warmer_k;
    tell(fmt::format("temperature: {:+g} K, set by the scene", p_.warmer_k));
  }

  void set_rain() {
    const MapPosition& position = climate_.position;
    const double centre_deg = position.latitude_deg.at(0.5 * position.width, 0.5 * position.height);
    climate_.wind_from_deg = p_.wind_from_deg.value_or(usual_wind_from_deg(centre_deg));
    const bool by_stations = !p_.stations.empty() && stations().has_rain();
    const double side_m =
        std::max(position.width * position.cell_m.x, position.height * position.cell_m.y);
    const bool told = p_.wind_from_deg.has_value() || by_stations || side_m >= min_map_for_wind_m;
    // A raster already contains the lee.
    const bool by_raster = !by_stations && p_.rain.has_value();
    Grid<float> share =
        told && !by_raster && p_.upslope.strength > 0.0 ? wind_share() : Grid<float>();
    if (by_stations)
      rain_from_stations(share);
    else if (by_raster)
      rain_from_raster();
    else
      tell(has_dry_country() ? "rain: from latitude, longitude and altitude, less in the dry "
                               "country behind ranges and far from the sea"
                             : "rain: from latitude, longitude and altitude only");
    if (!share.empty()) share_out_by_wind(std::move(share));
    if (const double factor = p_.rain_factor * (1.0 + p_.wetter); factor != 1.0)
      change_rain(factor);
  }

  Climate take() { return std::move(climate_); }

 private:
  void tell(const std::string& line) {
    climate_.sources.push_back(line);
    progress_.note(line);
  }

  bool has_dry_country() const {
    return std::any_of(climate_.nodes.begin(), climate_.nodes.end(),
                       [](const PlaceClimate& node) { return node.sheltered > 0.0; });
  }

  // The cell of the map at a node; `of`: the nodes' grid.
  glm::dvec2 cell_of_node(int x, int y, const Grid<PlaceClimate>& of) const {
    return {static_cast<double>(x) / (of.width() - 1) * (climate_.position.width - 1),
            static_cast<double>(y) / (of.height() - 1) * (climate_.position.height - 1)};
  }
  glm::dvec2 cell_of_node(int x, int y) const { return cell_of_node(x, y, climate_.nodes); }

  // Moves the nodes into dry country.
  void shelter_nodes() {
    constexpr double valley_share = 0.1;  // of the ground, below its floor
    std::vector<float> known;
    for (const float z : ground_m_)
      if (!std::isnan(z)) known.push_back(z);
    const double floor_m =
        known.empty() ? 0.0 : static_cast<double>(value_at_share(std::move(known), valley_share));
    const MapPosition& position = climate_.position;
    for (int y = 0; y < climate_.nodes.height(); ++y)
      for (int x = 0; x < climate_.nodes.width(); ++x) {
        const glm::dvec2 cell = cell_of_node(x, y);
        PlaceClimate& node = climate_.nodes(x, y);
        node =
            sheltered_climate(built_in_dry_field(), node, position.longitude_deg.at(cell.x, cell.y),
                              position.latitude_deg.at(cell.x, cell.y), floor_m, p_.sheltered);
      }
  }

  // The same climate on nodes that are close enough for regions.
  void refine_nodes() {
    const MapPosition& position = climate_.position;
    const auto count = [](int cells, double cell_m) {
      return std::min(max_region_nodes,
                      2 + static_cast<int>(cells * cell_m / region_node_spacing_m));
    };
    Grid<PlaceClimate> finer(count(position.width, position.cell_m.x),
                             count(position.height, position.cell_m.y));
    for (int y = 0; y < finer.height(); ++y)
      for (int x = 0; x < finer.width(); ++x) {
        const glm::dvec2 cell = cell_of_node(x, y, finer);
        finer(x, y) = climate_.at(cell.x, cell.y);
      }
    climate_.nodes = std::move(finer);
  }

  // Each node with the weights of regions there.
  template <class Use>
  void for_nodes(const std::vector<StationRegion>& regions, Use&& use) {
    for (int y = 0; y < climate_.nodes.height(); ++y)
      for (int x = 0; x < climate_.nodes.width(); ++x) {
        const glm::dvec2 cell = cell_of_node(x, y);
        const glm::dvec2 position = dem_.transform.to_crs(cell.x, cell.y);
        use(climate_.nodes(x, y), position, region_weights(regions, position));
      }
  }

  const StationTable& stations() {
    if (!stations_) stations_ = read_stations(p_.stations, dem_.crs, progress_);
    return *stations_;
  }

  // For the report: the stations of a fit.
  std::string named(const StationRegion& region, bool is_only) {
    return fmt::format("{}{} stations of {}{}{}",
                       is_only ? "" : fmt::format("region \"{}\": ", region.name),
                       is_only ? stations().stations.size() : region.stations.size(), p_.stations,
                       stations().period.empty() ? "" : " (" + stations().period + ")",
                       region.is_own ? "" : ", because its own are too few");
  }

  void from_stations() {
    const std::vector<StationRegion> regions =
        station_regions(stations().stations, [](const Station& s) {
          return !std::isnan(s.temperature_year_c) ||
                 std::any_of(s.temperature_c.begin(), s.temperature_c.end(),
                             [](double month_c) { return !std::isnan(month_c); });
        });
    const auto fit = [](const StationRegion& region, auto&& value, int bootstrap_samples) {
      std::vector<double> altitude_m;
      std::vector<double> temperature_c;
      for (const Station& station : region.stations) {
        altitude_m.push_back(station.altitude_m);
        temperature_c.push_back(value(station));
      }
      return fit_lapse_rate(altitude_m, temperature_c, bootstrap_samples);
    };
    std::vector<LapseRate> year;
    for (const StationRegion& region : regions) {
      year.push_back(fit(
          region, [](const Station& s) { return s.temperature_year_c; }, 400));
      tell(fmt::format(
          "temperature: {}: falls {:.2f} K/km over the year (95 % of resampled stations: {:.2f} … "
          "{:.2f}); error at a left-out station {:.2f} K",
          named(region, regions.size() == 1), year.back().k_per_km, year.back().low_k_per_km,
          year.back().high_k_per_km, year.back().left_out_k));
    }
    // Two regions have the average of their temperatures, at any altitude.
    const auto blended = [](const std::vector<LapseRate>& rates, const std::vector<double>& weights,
                            double LapseRate::*value) {
      double sum = 0.0;
      for (std::size_t r = 0; r < rates.size(); ++r) sum += weights[r] * rates[r].*value;
      return sum;
    };
    if (!stations().has_months()) {
      for_nodes(regions, [&](PlaceClimate& node, glm::dvec2, const std::vector<double>& weights) {
        // The default's annual cycle around the stations' mean.
        const double warmer =
            blended(year, weights, &LapseRate::sea_level_c) - year_mean(node.sea_level_c);
        const double steeper =
            blended(year, weights, &LapseRate::k_per_km) - year_mean(node.lapse_k_per_km);
        for (std::size_t m = 0; m < months; ++m) {
          node.sea_level_c[m] += warmer;
          node.lapse_k_per_km[m] += steeper;
        }
      });
      return;
    }
    double min = std::numeric_limits<double>::max();
    double max = std::numeric_limits<double>::lowest();
    for (std::size_t m = 0; m < months; ++m) {
      std::vector<LapseRate> rates;
      for (const StationRegion& region : regions) {
        rates.push_back(fit(
            region, [m](const Station& s) { return s.temperature_c[m]; }, 0));
        min = std::min(min, rates.back().k_per_km);
        max = std::max(max, rates.back().k_per_km);
      }
      for_nodes(regions, [&](PlaceClimate& node, glm::dvec2, const std::vector<double>& weights) {
        node.sea_level_c[m] = blended(rates, weights, &LapseRate::sea_level_c);
        node.lapse_k_per_km[m] = blended(rates, weights, &LapseRate::k_per_km);
      });
    }
    tell(fmt::format("temperature: falls {:.1f} … {:.1f} K/km, by month", min, max));
  }

  // A band on the grid of about a kilometre; NaN in cells that it does not cover.
  Grid<float> read_band(RasterSource source, int band) const {
    source.band = band;
    source.unit_to_m = 1.0;
    return warp_rasters({source}, {coarse_, ground_m_.width(), ground_m_.height(), dem_.crs},
                        silent_progress())
        .cells;
  }

  void from_temperature_raster() {
    const RasterInfo info = read_raster_info(*p_.temperature);
    if (info.bands < static_cast<int>(months))
      throw Error(ErrorKind::usage, p_.temperature->path, fmt::format("has {} bands", info.bands),
                  "12 bands, the means of January … December");
    double kelvin = 0.0;
    for (std::size_t m = 0; m < months; ++m) {
      Grid<float> grid = read_band(*p_.temperature, static_cast<int>(m) + 1);
      std::vector<double> known_c;
      std::vector<double> altitude_m;
      for (std::size_t i = 0; i < grid.size(); ++i)
        if (!std::isnan(grid[i])) {
          known_c.push_back(static_cast<double>(grid[i]) * p_.temperature_factor);
          altitude_m.push_back(static_cast<double>(ground_m_[i]));
        }
      if (known_c.empty())
        throw Error(ErrorKind::input, p_.temperature->path, "does not cover the terrain",
                    "a raster that covers it");
      if (m == 0 && middle_value(known_c) > 150.0) kelvin = 273.15;
      // The raster's own lapse rate, if the map has enough relief; else the default's.
      const auto [low, high] = std::minmax_element(altitude_m.begin(), altitude_m.end());
      constexpr double min_relief_m = 300.0;
      if (*high - *low >= min_relief_m) {
        const double rate =
            std::clamp(fit_lapse_rate(altitude_m, known_c, 0).k_per_km, min_lapse, largest_lapse);
        for (PlaceClimate& node : climate_.nodes) node.lapse_k_per_km[m] = rate;
      }
      // The raster at the mean altitude of its cells, minus the nodes' value there.
      const auto cells = static_cast<double>(climate_.coarse_cells);
      for (int y = 0; y < grid.height(); ++y)
        for (int x = 0; x < grid.width(); ++x) {
          const PlaceClimate column = climate_.at((x + 0.5) * cells - 0.5, (y + 0.5) * cells - 0.5);
          const double here = static_cast<double>(grid(x, y)) * p_.temperature_factor - kelvin;
          grid(x, y) = std::isnan(grid(x, y))
                           ? std::numeric_limits<float>::quiet_NaN()
                           : static_cast<float>(
                                 here - monthly_c(column, static_cast<double>(ground_m_(x, y)))[m]);
        }
      pending_warmer_[m] =
          make_dem({std::move(grid), coarse_, dem_.crs})
              .altitude_m;  // smooth continuation into cells that it does not cover
    }
    climate_.warmer_k = std::move(pending_warmer_);
    tell(fmt::format("temperature: {}{}", p_.temperature->path, kelvin > 0.0 ? ", in kelvin" : ""));
  }

  void set_lapse() {
    // Rotated around the ground's mean altitude, where the other source is right.
    double mean_m = 0.0;
    for (const float z : ground_m_)
      mean_m += static_cast<double>(z) / static_cast<double>(ground_m_.size());
    for (PlaceClimate& node : climate_.nodes)
      for (std::size_t m = 0; m < months; ++m) {
        node.sea_level_c[m] += (*p_.lapse_k_per_km - node.lapse_k_per_km[m]) * mean_m / 1000.0;
        node.lapse_k_per_km[m] = *p_.lapse_k_per_km;
      }
    tell(fmt::format("temperature: falls {:.2f} K/km, set by the scene", *p_.lapse_k_per_km));
  }

  // Stations have measured windward and lee. Their rain is therefore divided by the share that the
  // wind brings them before the plane is fitted, so that plane and wind together meet them; if the
  // plane alone meets them better, they do not know this wind, and `share` is emptied unless the
  // scene names it.
  void rain_from_stations(Grid<float>& share) {
    const std::vector<StationRegion> regions = station_regions(
        stations().stations, [](const Station& s) { return !std::isnan(s.rain_mm); });
    const auto fit = [&](const Grid<float>& by_wind) {
      std::vector<RainPlane> planes;
      for (const StationRegion& region : regions) {
        std::vector<double> at_station;
        if (!by_wind.empty())
          for (const Station& station : region.stations)
            at_station.push_back(share_at(by_wind, station.position));
        planes.push_back(fit_rain(region.stations, at_station));
      }
      return planes;
    };
    const auto off_mm = [](const std::vector<RainPlane>& of) {
      double sum = 0.0;
      double count = 0.0;
      for (const RainPlane& plane : of) {
        sum += plane.stations * plane.off_mm;
        count += plane.stations;
      }
      return sum / count;
    };
    std::vector<RainPlane> planes = fit({});
    if (!share.empty()) {
      std::vector<RainPlane> level = fit(share);
      constexpr double clearly_mm = 1.0;
      if (p_.wind_from_deg || off_mm(level) < off_mm(planes) + clearly_mm) {
        planes = std::move(level);
      } else {
        share = {};
        tell(
            fmt::format("rain: the stations show no windward and lee of a wind from {:.0f}°: with "
                        "it {:.0f} mm off, without {:.0f}",
                        climate_.wind_from_deg, off_mm(level), off_mm(planes)));
      }
    }
    for_nodes(regions,
              [&](PlaceClimate& node, glm::dvec2 position, const std::vector<double>& weights) {
                node.gathers = 1.0;  // the glaciers' correction applies only to the default's rain
                node.sheltered = 0.0;
                for (std::size_t km = 0; km < node.rain_mm_at_km.size(); ++km) {
                  double mm = 0.0;
                  for (std::size_t r = 0; r < planes.size(); ++r)
                    mm += weights[r] * planes[r].at(position, 1000.0 * static_cast<double>(km));
                  node.rain_mm_at_km[km] = mm;
                }
              });
    for (std::size_t r = 0; r < planes.size(); ++r)
      tell(fmt::format(
          "rain: {}: {:.0f} mm at {:.0f} m, {:+.0f} mm per km of altitude (95 % of "
          "resampled stations: {:+.0f} … {:+.0f}); error at a left-out station {:.0f} mm",
          named(regions[r], regions.size() == 1), planes[r].at_centre_mm, planes[r].centre_m,
          planes[r].mm_per_km_up, planes[r].low_mm_per_km_up, planes[r].high_mm_per_km_up,
          planes[r].left_out_mm));
  }

  void rain_from_raster() {
    const RasterInfo info = read_raster_info(*p_.rain);
    if (info.bands != 1 && info.bands < static_cast<int>(months))
      throw Error(ErrorKind::usage, p_.rain->path, fmt::format("has {} bands", info.bands),
                  "12 bands, the sums of January … December, or one with the sum of the year");
    Grid<float> year(ground_m_.width(), ground_m_.height(), 0.0F);
    for (int band = 1; band <= (info.bands == 1 ? 1 : static_cast<int>(months)); ++band) {
      const Grid<float> part = read_band(*p_.rain, band);
      for (std::size_t i = 0; i < year.size(); ++i) year[i] += part[i];
    }
    if (std::all_of(year.begin(), year.end(), [](float mm) { return std::isnan(mm); }))
      throw Error(ErrorKind::input, p_.rain->path, "does not cover the terrain",
                  "a raster that covers it");
    for (PlaceClimate& node : climate_.nodes)
      node.gathers = 1.0;  // the glaciers' correction applies only to the default's rain
    // The column keeps its change with altitude; the raster sets the amount.
    const auto cells = static_cast<double>(climate_.coarse_cells);
    for (int y = 0; y < year.height(); ++y)
      for (int x = 0; x < year.width(); ++x) {
        const double column =
            belvedere::rain_mm(climate_.at((x + 0.5) * cells - 0.5, (y + 0.5) * cells - 0.5),
                               static_cast<double>(ground_m_(x, y)));
        year(x, y) = static_cast<float>(std::max(0.0, static_cast<double>(year(x, y))) /
                                        std::max(1.0, column));
      }
    climate_.rain_share = make_dem({std::move(year), coarse_, dem_.crs}).altitude_m;
    for (float& share : climate_.rain_share) share = std::max(0.0F, share);
    tell(fmt::format("rain: {}", p_.rain->path));
  }

  void change_rain(double factor) {
    for (PlaceClimate& node : climate_.nodes)
      for (double& mm : node.rain_mm_at_km) mm *= factor;
    tell(fmt::format("rain: times {:g}, set by the scene", factor));
  }

  // Share of level ground's rain on the grid of about a kilometre.
  Grid<float> wind_share() const {
    UpslopeParameters upslope = p_.upslope;
    const MapPosition& position = climate_.position;
    const double turned = climate_.wind_from_deg -
                          position.grid_north_deg.at(0.5 * position.width, 0.5 * position.height);
    upslope.wind_from_deg = turned - 360.0 * std::floor(turned / 360.0);
    Grid<float> share = upslope_rain(
        ground_m_, position.cell_m * static_cast<double>(climate_.coarse_cells), upslope);
    for (float& value : share) value = std::max(min_rain_share, 1.0F + value);
    return share;
  }

  // As Climate::at does it; 1 beyond the map, whose ground is unknown.
  double share_at(const Grid<float>& share, glm::dvec2 place) const {
    const glm::dvec2 cell = dem_.transform.to_cell(place.x, place.y);
    if (!(cell.x >= -0.5 && cell.y >= -0.5 && cell.x <= dem_.width() - 0.5 &&
          cell.y <= dem_.height() - 0.5))
      return 1.0;
    return climate_.on_coarse_grid(share, cell.x, cell.y);
  }

  // The rain of dry places was measured behind their ranges: there the wind acts no more.
  void share_out_by_wind(Grid<float> share) {
    const auto cells = static_cast<double>(climate_.coarse_cells);
    if (has_dry_country())
      for (int y = 0; y < share.height(); ++y)
        for (int x = 0; x < share.width(); ++x) {
          const double sheltered =
              climate_.at((x + 0.5) * cells - 0.5, (y + 0.5) * cells - 0.5).sheltered;
          share(x, y) += static_cast<float>(sheltered) * (1.0F - share(x, y));
        }
    climate_.rain_share = std::move(share);
    tell(fmt::format("rain: increased to windward and reduced in the lee of a wind from {:.0f}°{}",
                     climate_.wind_from_deg,
                     p_.wind_from_deg ? "" : ", the usual direction at this latitude"));
  }

  const Dem& dem_;
  const ClimateParameters& p_;
  Progress& progress_;
  Climate climate_;
  Grid<float> ground_m_;  // mean altitude on the grid of about a kilometre
  GeoTransform coarse_;   // of that grid
  std::array<Grid<float>, months> pending_warmer_;
  std::optional<StationTable> stations_;
};

}  // namespace

Climate make_climate(const Dem& dem, const ClimateParameters& parameters,
                     const DefaultClimate& fallback, Progress& progress) {
  Maker maker(dem, parameters, progress);
  maker.set_default(fallback);
  maker.set_temperature();
  maker.set_rain();
  return maker.take();
}

}  // namespace belvedere
