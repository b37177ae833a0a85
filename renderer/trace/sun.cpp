#include "renderer/trace/sun.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "base/math.h"
#include "base/error.h"
#include "base/math_exact.h"

namespace belvedere {
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
