#include "renderer/trace/light_field.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/masks/polygon.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"

namespace belvedere {
namespace {

// A cloud's edge: shift by its two sizes of lobes and their widths, in shares of the radius. Noise
// is limited to ±2 deviations.
constexpr double lobe_move = 0.26;
constexpr double lobe_sigma = 0.42;
constexpr double tuft_move = 0.10;
constexpr double tuft_sigma = 0.14;
constexpr double max_noise = 2.0;
// Its shade is slightly uneven too.
constexpr double thin_share = 0.12;

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double squared = glm::dot(along, along);
  const double t = squared > 0.0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + along * t));
}

// Distance of a position outside a region, m; 0 inside.
double outside_m(const LightRegion& region, glm::dvec2 p) {
  if (region.rings.empty()) return std::max(0.0, glm::length(p - region.centre) - region.radius_m);
  if (encloses(region.rings, p)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::vector<glm::dvec2>& ring : region.rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      nearest = std::min(nearest, distance_to_segment(p, ring[i], ring[j]));
  return nearest;
}

glm::dvec3 sun_above_horizon(glm::dvec3 sun, const std::string& whose) {
  const double length = glm::length(sun);
  if (!(length > 0.5 && length < 2.0 && sun.z > 0.0))
    throw Error(ErrorKind::usage, whose,
                fmt::format("a sun in the direction {:.3f}, {:.3f}, {:.3f}", sun.x, sun.y, sun.z),
                "a sun above the horizon");
  return sun / length;
}

float side_of(glm::dvec3 sun, glm::dvec2 right) {
  return sun.x * right.x + sun.y * right.y < 0.0 ? -1.0F : 1.0F;
}

float mixed(float a, double b, double share) {
  return static_cast<float>(static_cast<double>(a) + (b - static_cast<double>(a)) * share);
}

}  // namespace

LightField::LightField(glm::dvec3 sun_direction, glm::dvec2 right, std::vector<LightRegion> regions,
                       std::vector<CloudShadow> clouds, std::uint64_t seed)
    : right_(right), regions_(std::move(regions)), clouds_(std::move(clouds)), seed_(seed) {
  sun_above_horizon(sun_direction, "the picture's light");
  picture_.sun = sun_direction;
  picture_.side = side_of(sun_direction, right_);
  for (LightRegion& region : regions_) {
    region.sun_direction = sun_above_horizon(region.sun_direction, "a region of light");
    glm::dvec2 low = region.centre - region.radius_m;
    glm::dvec2 high = region.centre + region.radius_m;
    if (!region.rings.empty()) {
      low = glm::dvec2(std::numeric_limits<double>::infinity());
      high = -low;
      for (const std::vector<glm::dvec2>& ring : region.rings)
        for (const glm::dvec2 p : ring) low = glm::min(low, p), high = glm::max(high, p);
    }
    region_boxes_.push_back({low - region.blend_m, high + region.blend_m});
    sides_.push_back(side_of(region.sun_direction, right_));
  }
  for (const CloudShadow& cloud : clouds_) {
    const double reach =
        cloud.radius_m * (1.0 + max_noise * (lobe_move + tuft_move)) + 0.5 * cloud.blend_m;
    cloud_boxes_.push_back({cloud.centre - reach, cloud.centre + reach});
  }
}

double LightField::weight(const LightRegion& region, glm::dvec2 position_m) {
  const double outside = outside_m(region, position_m);
  if (outside <= 0.0) return 1.0;
  return outside >= region.blend_m ? 0.0 : 1.0 - smoothstep(outside / region.blend_m);
}

double LightField::cloud_share(const CloudShadow& cloud, glm::dvec2 position_m) const {
  // By its own position, so that its shape does not depend on other clouds of the scene.
  const glm::dvec2 at = position_m - cloud.centre;
  const auto whole = [](double m) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::llround(m)));
  };
  const std::uint64_t own =
      mix_bits(mix_bits(seed_ + whole(cloud.centre.x)) + whole(cloud.centre.y));
  const auto noise = [&](std::uint64_t part, double sigma) {
    return std::clamp(gaussian_noise(stream_seed(own, Stream::cloud_shadows, part), at.x, at.y,
                                     sigma * cloud.radius_m),
                      -max_noise, max_noise);
  };
  const double lobes = noise(0, lobe_sigma);
  const double tufts = noise(1, tuft_sigma);
  const double edge_m = cloud.radius_m * (1.0 + lobe_move * lobes + tuft_move * tufts);
  const double inside_m = edge_m - glm::length(at);
  const double covered = cloud.blend_m > 0.0 ? smoothstep(0.5 + inside_m / cloud.blend_m)
                                             : (inside_m >= 0.0 ? 1.0 : 0.0);
  return cloud.strength * covered * (1.0 - thin_share * std::abs(lobes) / max_noise);
}

GroundLight LightField::at(glm::dvec2 position_m) const {
  GroundLight light = picture_;
  bool turned = false;
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    if (!region_boxes_[i].has(position_m)) continue;
    const LightRegion& region = regions_[i];
    const double share = weight(region, position_m);
    if (share <= 0.0) continue;
    light.sun = light.sun * (1.0 - share) + region.sun_direction * share;
    light.strength = mixed(light.strength, region.strength, share);
    light.warmth = mixed(light.warmth, region.warmth, share);
    light.side = mixed(light.side, static_cast<double>(sides_[i]), share);
    turned = true;
  }
  // All suns are above the horizon, so their weighted sum is never zero.
  if (turned) light.sun = glm::normalize(light.sun);
  for (std::size_t i = 0; i < clouds_.size(); ++i)
    if (cloud_boxes_[i].has(position_m))
      light.strength *= static_cast<float>(1.0 - cloud_share(clouds_[i], position_m));
  return light;
}

namespace {

// Reads a text from left to right; every reader returns whether it found its item.
class TimeReader {
 public:
  explicit TimeReader(std::string_view text) : rest_(text) {}

  bool literal(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  // Exactly `digits` digits whose number is in min…max.
  bool number(int digits, int min, int max, int& value) {
    if (rest_.size() < static_cast<std::size_t>(digits)) return false;
    value = 0;
    for (int i = 0; i < digits; ++i) {
      const char c = rest_[static_cast<std::size_t>(i)];
      if (c < '0' || c > '9') return false;
      value = 10 * value + (c - '0');
    }
    rest_.remove_prefix(static_cast<std::size_t>(digits));
    return value >= min && value <= max;
  }
  // One or more digits after a decimal point.
  bool fraction(double& value) {
    double scale = 0.1;
    value = 0.0;
    const std::size_t before = rest_.size();
    for (; !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9';
         rest_.remove_prefix(1), scale *= 0.1) {
      value += scale * (rest_.front() - '0');
    }
    return rest_.size() < before;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

int days_in_month(int year, int month) {
  if (month == 2) return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0 ? 29 : 28;
  return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

// Days from 2000-01-01 to a date of the Gregorian calendar (Howard Hinnant's days_from_civil,
// shifted from 1970).
int days_since_2000(int year, int month, int day) {
  const int y = month <= 2 ? year - 1 : year;  // years that begin in March, positive here
  const int era = y / 400;
  const int year_of_era = y - era * 400;
  const int day_of_year = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5 + day - 1;
  return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year -
         730425;
}

struct UtcTime {
  double days_since_noon_2000;  // Julian date - 2451545
  double hour;                  // of the UTC day, 0…24
};

std::optional<UtcTime> parse_time(std::string_view text) {
  TimeReader in(text);
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, zone_hour = 0,
      zone_minute = 0;
  double fraction = 0.0;
  if (!in.number(4, 1900, 2100, year) || !in.literal('-') || !in.number(2, 1, 12, month) ||
      !in.literal('-'))
    return {};
  if (!in.number(2, 1, days_in_month(year, month), day) || !in.literal('T')) return {};
  if (!in.number(2, 0, 23, hour) || !in.literal(':') || !in.number(2, 0, 59, minute)) return {};
  if (in.literal(':')) {
    if (!in.number(2, 0, 59, second)) return {};
    if (in.literal('.') && !in.fraction(fraction)) return {};
  }
  int sign = 0;
  if (!in.literal('Z')) {
    sign = in.literal('+') ? 1 : in.literal('-') ? -1 : 0;
    if (sign == 0 || !in.number(2, 0, 14, zone_hour) || !in.literal(':') ||
        !in.number(2, 0, 59, zone_minute))
      return {};
  }
  if (!in.at_end()) return {};
  const double local =
      hour + minute / 60.0 + (second + fraction) / 3600.0 - sign * (zone_hour + zone_minute / 60.0);
  const double days = days_since_2000(year, month, day) + local / 24.0;
  const double utc_hour = local - 24.0 * std::floor(local / 24.0);
  return UtcTime{days - 0.5, utc_hour};
}

}  // namespace

SunPosition sun_position(double longitude_deg, double latitude_deg, const std::string& time) {
  if (!(std::abs(longitude_deg) <= 180.0 && std::abs(latitude_deg) <= 90.0)) {
    throw Error(ErrorKind::usage, "position for the sun's time",
                fmt::format("longitude {}, latitude {}", longitude_deg, latitude_deg),
                "longitude -180…180, latitude -90…90 degrees");
  }
  const std::optional<UtcTime> utc = parse_time(time);
  if (!utc) {
    throw Error(ErrorKind::usage, "the sun's time", fmt::format("\"{}\"", time),
                "a date and time with its zone, such as 2024-07-15T09:30:00Z or "
                "2024-07-15T11:30:00+02:00, from 1900 to 2100");
  }
  // Names and coefficients as in the paper; angles in radians.
  const double n = utc->days_since_noon_2000;
  const double omega = 2.267127827 - 9.300339267e-4 * n;
  const double mean_longitude = 4.895036035 + 1.720279602e-2 * n;
  const double mean_anomaly = 6.239468336 + 1.720200135e-2 * n;
  const double ecliptic_longitude = mean_longitude + 3.338320972e-2 * exact::sin(mean_anomaly) +
                                    3.497596876e-4 * exact::sin(2.0 * mean_anomaly) -
                                    1.544353226e-4 - 8.689729360e-6 * exact::sin(omega);
  const double obliquity = 4.090904909e-1 - 6.213605399e-9 * n + 4.418094944e-5 * exact::cos(omega);
  const double right_ascension = exact::atan2(
      exact::cos(obliquity) * exact::sin(ecliptic_longitude), exact::cos(ecliptic_longitude));
  const double declination =
      exact::asin(std::clamp(exact::sin(obliquity) * exact::sin(ecliptic_longitude), -1.0, 1.0));

  const double sidereal_hours = 6.697096103 + 6.570984737e-2 * n + utc->hour;
  const double hour_angle = to_radians(15.0 * sidereal_hours + longitude_deg) - right_ascension;
  const double latitude = to_radians(latitude_deg);
  const double cos_zenith =
      exact::cos(latitude) * exact::cos(hour_angle) * exact::cos(declination) +
      exact::sin(declination) * exact::sin(latitude);
  const double zenith = exact::acos(std::clamp(cos_zenith, -1.0, 1.0));
  // tan(declination) cos(latitude) - sin(latitude) cos(hour angle), multiplied by cos(declination)
  // > 0.
  const double azimuth =
      exact::atan2(-exact::sin(hour_angle) * exact::cos(declination),
                   exact::sin(declination) * exact::cos(latitude) -
                       exact::sin(latitude) * exact::cos(hour_angle) * exact::cos(declination));
  // From the ground the sun is slightly lower than from the Earth's centre.
  const double parallax = 6371.01 / 149597890.0 * exact::sin(zenith);
  SunPosition sun;
  sun.azimuth_deg = to_degrees(azimuth < 0.0 ? azimuth + 2.0 * std::numbers::pi : azimuth);
  sun.altitude_deg = 90.0 - to_degrees(zenith + parallax);
  return sun;
}

glm::dvec3 sun_direction(const SunPosition& sun) {
  const double azimuth = to_radians(sun.azimuth_deg);
  const double altitude = to_radians(sun.altitude_deg);
  return {exact::sin(azimuth) * exact::cos(altitude), exact::cos(azimuth) * exact::cos(altitude),
          exact::sin(altitude)};
}

}  // namespace belvedere
