#include "renderer/paint/clouds/clouds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/random.h"

namespace belvedere {
namespace {

// Random numbers in the order of the draws, a pure function of seed and cell. One draw per
// statement: C++ leaves the evaluation order of arguments open.
class Draws {
 public:
  Draws(std::uint64_t seed, std::int64_t cell) : seed_(seed), cell_(cell) {}
  double uniform() { return random_uniform(seed_, cell_, draw_++, 1); }
  double between(double low, double high) { return low + (high - low) * uniform(); }

 private:
  std::uint64_t seed_;
  std::int64_t cell_;
  std::int64_t draw_ = 0;
};

// The outline of a heap: arches of different height and width side by side; u is -1…1 over the
// width, the value 0…1.
struct Outline {
  struct Arch {
    double centre, half_width, height;
  };
  std::vector<Arch> arches;

  double operator()(double u) const {
    double top = 0.0;
    for (const Arch& a : arches) {
      const double side = (u - a.centre) / a.half_width;
      top = std::max(top, a.height * std::sqrt(std::max(0.0, 1.0 - side * side)));
    }
    return top;
  }
};

Outline make_outline(Draws& draws) {
  Outline outline;
  const double main_centre = draws.between(-0.45, 0.45);
  const double main_half_width = draws.between(0.35, 0.75);
  outline.arches.push_back({main_centre, main_half_width, 1.0});
  const int more = static_cast<int>(draws.between(1.0, 4.0));
  for (int k = 0; k < more; ++k) {
    const double centre = draws.between(-0.8, 0.8);
    const double half_width = draws.between(0.15, 0.5);
    outline.arches.push_back({centre, half_width, draws.between(0.2, 0.75)});
  }
  outline.arches.push_back({0.0, 1.0, draws.between(0.12, 0.3)});  // joins the others
  return outline;
}

// Computes the bounding box of a cloud's heads and the fineness of its edges.
void close_cloud(const SkyParameters& p, Cloud& cloud, double base_px, double width_px,
                 double height_px) {
  cloud.from = glm::vec2(1e9F);
  cloud.to = glm::vec2(-1e9F);
  for (const CloudHead& head : cloud.heads) {
    cloud.from = glm::min(cloud.from, head.centre - 1.6F * head.radius);
    cloud.to = glm::max(cloud.to, head.centre + 1.6F * head.radius);
  }
  cloud.to.y = static_cast<float>(base_px + 0.35 * height_px);
  const double size = width_px / cloud_scale_px(p);
  cloud.grain = size > 1.0 ? 0 : size > 0.5 ? 1 : size > 0.25 ? 2 : 3;
}

// One cloud. `heaped`: 0 a wind-drawn bank … 1 a cumulus.
Cloud make_cloud(const SkyParameters& p, Draws& draws, glm::dvec2 centre_px, double width_px,
                 double heaped, double opacity) {
  const double height_px = width_px * (0.05 + (0.10 + 0.20 * heaped) * draws.between(0.6, 1.2));
  const Outline outline = make_outline(draws);
  const int count = 14 + static_cast<int>(12.0 * draws.uniform());
  const double base_px = centre_px.y;
  Cloud cloud{static_cast<float>(base_px), {}, {}, static_cast<float>(opacity), 0, {}};
  const auto add = [&](double u, double rise, glm::dvec2 radius) {
    cloud.heads.push_back({glm::vec2(glm::dvec2(centre_px.x + 0.5 * width_px * u, base_px - rise)),
                           glm::vec2(radius)});
  };
  for (int k = 0; k < count; ++k) {
    const double u = -1.0 + 2.0 * (k + draws.uniform()) / count;
    const double arch = outline(u);
    const double radius = height_px * (0.10 + 0.30 * arch) * draws.between(0.7, 1.3);
    const double stretch = (3.2 - 1.9 * heaped) * draws.between(0.8, 1.3);
    add(u, std::max(0.0, arch * height_px - radius) * draws.between(0.2, 1.0),
        {radius * stretch, radius});
  }
  // Level skirts beyond the heap.
  const int skirts = 2 + static_cast<int>(3.0 * draws.uniform());
  for (int k = 0; k < skirts; ++k) {
    const double u = draws.between(-1.1, 1.1);
    const double length = width_px * draws.between(0.12, 0.34) * (1.3 - 0.6 * heaped);
    const double thickness = length * draws.between(0.05, 0.10);
    const double rise = height_px * draws.between(0.02, 0.22);
    add(u, rise, {length, thickness});
  }
  std::stable_sort(cloud.heads.begin(), cloud.heads.end(),
                   [](const CloudHead& a, const CloudHead& b) { return a.centre.y < b.centre.y; });
  close_cloud(p, cloud, base_px, width_px, height_px);
  return cloud;
}

// Size of a cloud by the elevation of its base above the horizon (in heights of the sky): the
// lower, the farther. In cloud scales.
double size_at(double elevation) { return 0.22 + 1.9 * elevation; }

// Clearness of a cloud: far ones are seen through the air of the horizon.
double clearness(double elevation) { return 0.55 + 0.45 * std::min(1.0, elevation / 0.2); }

// A bank: clouds of one kind along a level line, large in the centre, farther and smaller to both
// sides.
void add_bank(std::vector<Cloud>& clouds, const SkyParameters& p, const SkyLook& look, Draws& draws,
              double centre_px, double elevation, double drawn_out) {
  const double scale_px = cloud_scale_px(p) * look.size;
  const double heaped = look.heaped + draws.between(-0.6, 0.5);
  const double half_px = scale_px * size_at(elevation) * drawn_out * draws.between(0.6, 1.9);
  const int count = 3 + static_cast<int>(5.0 * draws.uniform());
  const double lead = draws.between(-0.6, 0.6);  // position of the largest cloud in the bank
  for (int k = 0; k < count; ++k) {
    const double t = -1.0 + 2.0 * (k + draws.uniform()) / count;
    const double aside = std::min(1.0, std::abs(t - lead));
    const double height = elevation * (1.0 - 0.35 * aside) * draws.between(0.9, 1.1);
    const double width_px =
        scale_px * size_at(height) * drawn_out * (1.0 - 0.62 * aside) * draws.between(0.55, 1.25);
    const double kind = std::clamp(heaped + draws.between(-0.25, 0.25) - 0.3 * aside, 0.0, 1.0);
    const double opacity = clearness(height) * (0.62 + 0.38 * kind) * (1.0 - 0.35 * aside);
    clouds.push_back(make_cloud(p, draws, {centre_px + half_px * t, p.horizon_px * (1.0 - height)},
                                width_px, kind, opacity));
  }
}

// A layer of banks at similar height.
struct Band {
  double lowest, highest;  // of bases above the horizon, in heights of the sky
  double stretch;          // in cloud scales; each stretch has one bank at most
  double share;            // of stretches with a bank
  double drawn_out;        // factor on the length of its clouds
};
using Bands = std::array<Band, 3>;
// Few banks high up, more and smaller ones towards the horizon.
constexpr Bands fair_bands = {
    {{0.05, 0.12, 1.3, 0.62, 1.0}, {0.14, 0.30, 2.6, 0.58, 1.0}, {0.32, 0.62, 4.2, 0.58, 1.0}}};
// A wall of cloud behind the ranges, and almost nothing above it.
constexpr Bands horizon_bands = {
    {{0.01, 0.07, 0.75, 0.95, 1.5}, {0.05, 0.16, 1.9, 0.75, 1.9}, {0.40, 0.62, 5.5, 0.40, 1.6}}};
constexpr Bands streak_bands = {
    {{0.02, 0.08, 1.6, 0.45, 1.3}, {0.12, 0.20, 4.5, 0.30, 1.3}, {0.32, 0.62, 9.0, 0.0, 1.0}}};

// Scraps below the deck of a front, and a wall behind the ranges.
constexpr Bands front_bands = {
    {{0.01, 0.06, 0.9, 0.85, 1.6}, {0.06, 0.14, 2.4, 0.50, 1.5}, {0.20, 0.34, 6.0, 0.25, 1.2}}};

void add_bands(std::vector<Cloud>& clouds, const SkyParameters& p, const SkyLook& look,
               const Bands& bands) {
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const Band& band = bands[b];
    const double cell_px = band.stretch * cloud_scale_px(p);
    // Stretches begin at offsets that depend on the seed; otherwise every sky would have its gaps
    // at the same positions.
    const std::uint64_t seed = stream_seed(p.seed, Stream::cloud_banks, b);
    const double shift = random_uniform(seed, -9, 0);
    const auto last = static_cast<std::int64_t>(p.picture_size.x / cell_px) + 2;
    for (std::int64_t cell = -2; cell <= last; ++cell) {
      Draws draws(seed, cell);
      if (draws.uniform() > band.share * look.amount + 0.4 * (p.clouds - 1.0)) continue;
      const double centre_px =
          (static_cast<double>(cell) + shift + draws.between(0.1, 0.9)) * cell_px;
      const double elevation =
          std::min(0.70, look.raised * draws.between(band.lowest, band.highest));
      add_bank(clouds, p, look, draws, centre_px, elevation, band.drawn_out);
    }
  }
}

// Lines of positions on the sky's plane that start at the vanishing point.
struct Streets {
  int number;                   // number of their random stream
  double spread;                // spacing at half the height of the sky, in cloud scales
  double aside;                 // sideways offset of each, in shares of spread
  std::optional<double> share;  // share of them that are present; none: all
  glm::dvec3 first;             // first position: min and max elevation, and its factor
  double last;                  // elevation of the last position
  glm::dvec2 step;              // from one position to the next: min and max factor of elevation
};

// place(draws, elevation, base_px, x_px) for each of them.
template <class Place>
void along_streets(const SkyParameters& p, const SkyLook& look, const Streets& streets,
                   Place&& position) {
  const double spread_px = streets.spread * cloud_scale_px(p);
  const double reach_px = look.vanishing_px.y - 0.5 * p.horizon_px;
  const auto count = static_cast<std::int64_t>(p.picture_size.x / spread_px) + 3;
  const std::uint64_t seed =
      stream_seed(p.seed, Stream::cloud_banks, static_cast<std::uint64_t>(streets.number));
  for (std::int64_t street = -count; street <= count; ++street) {
    Draws draws(seed, street);
    const double slope =
        (static_cast<double>(street) + draws.between(-streets.aside, streets.aside)) * spread_px /
        reach_px;
    if (streets.share && draws.uniform() > *streets.share) continue;
    for (double elevation = streets.first.x * draws.between(streets.first.y, streets.first.z);
         elevation < streets.last; elevation *= draws.between(streets.step.x, streets.step.y)) {
      const double base_px = p.horizon_px * (1.0 - elevation);
      position(draws, elevation, base_px,
               look.vanishing_px.x + slope * (look.vanishing_px.y - base_px));
    }
  }
}

// Small heaps in rows.
void add_rows(std::vector<Cloud>& clouds, const SkyParameters& p, const SkyLook& look) {
  const double scale_px = cloud_scale_px(p);
  const Streets streets{.number = 7,
                        .spread = 1.25,
                        .aside = 0.3,
                        .share = std::optional(0.75 * look.amount + 0.4 * (p.clouds - 1.0)),
                        .first = {0.045, 0.8, 1.3},
                        .last = 0.66,
                        .step = {1.25, 1.65}};
  along_streets(p, look, streets,
                [&](Draws& draws, double elevation, double base_px, double street_px) {
                  const double x_px = street_px + scale_px * elevation * draws.between(-0.25, 0.25);
                  const double width_px =
                      scale_px * look.size * size_at(elevation) * draws.between(0.22, 0.55);
                  const double kind = std::clamp(look.heaped + draws.between(-0.3, 0.4), 0.0, 1.0);
                  const double chance = draws.uniform();
                  const double opacity = clearness(elevation) * (0.66 + 0.34 * kind);
                  if (chance < 0.30 || x_px < -width_px || x_px > p.picture_size.x + width_px)
                    return;
                  clouds.push_back(make_cloud(p, draws, {x_px, base_px}, width_px, kind, opacity));
                });
}

// A cumulus: towers of rounded heads over a level base, the tallest near its centre.
Cloud make_heap(const SkyParameters& p, Draws& draws, glm::dvec2 centre_px, double width_px,
                double tall, double opacity) {
  const double height_px = width_px * tall;
  Cloud cloud{static_cast<float>(centre_px.y), {}, {}, static_cast<float>(opacity), 0, {}};
  const auto add = [&](double u, double rise_px, double radius_px, double stretch) {
    cloud.heads.push_back(
        {glm::vec2(glm::dvec2(centre_px.x + 0.5 * width_px * u, centre_px.y - rise_px)),
         glm::vec2(glm::dvec2(radius_px * stretch, radius_px))});
  };
  const int towers = 3 + static_cast<int>(3.0 * draws.uniform());
  const double lead = draws.between(-0.35, 0.35);
  for (int t = 0; t < towers; ++t) {
    const double u = -0.85 + 1.7 * (t + draws.uniform()) / towers;
    const double top = (1.0 - 0.75 * std::min(1.0, std::abs(u - lead))) * draws.between(0.70, 1.0);
    const int heads = 3 + static_cast<int>(5.0 * top);
    for (int k = 0; k < heads; ++k) {
      const double s = (k + 0.5) / heads;
      const double radius = height_px * (0.30 - 0.16 * s) * draws.between(0.75, 1.25);
      const double aside = draws.between(-0.22, 0.22) * (1.0 - 0.5 * s);
      add(u + aside, std::max(0.0, top * s * height_px - 0.2 * radius), radius,
          draws.between(1.05, 1.45));
    }
  }
  // Joins them along the base.
  for (int k = 0; k < 5; ++k) {
    const double u = -0.8 + 0.4 * k + draws.between(-0.1, 0.1);
    const double radius = height_px * draws.between(0.12, 0.20);
    add(u, 0.35 * radius, radius, draws.between(1.8, 2.6));
  }
  std::stable_sort(cloud.heads.begin(), cloud.heads.end(),
                   [](const CloudHead& a, const CloudHead& b) { return a.centre.y < b.centre.y; });
  close_cloud(p, cloud, centre_px.y, width_px, height_px);
  return cloud;
}

// Fair-weather heaps all over the sky, in rows, smaller and closer towards the horizon.
void add_cumulus(std::vector<Cloud>& clouds, const SkyParameters& p, const SkyLook& look) {
  const double scale_px = cloud_scale_px(p);
  const Streets streets{.number = 11,
                        .spread = 1.7,
                        .aside = 0.35,
                        .share = std::nullopt,
                        .first = {0.03, 0.8, 1.4},
                        .last = 0.60,
                        .step = {1.4, 2.0}};
  along_streets(
      p, look, streets, [&](Draws& draws, double elevation, double base_px, double street_px) {
        const double aside = draws.between(-0.6, 0.6);
        const double x_px = street_px + scale_px * (0.2 + elevation) * aside;
        const double width_px =
            scale_px * look.size * size_at(elevation) * draws.between(0.45, 1.05);
        const double tall = draws.between(0.26, 0.52) * (p.winter ? 0.6 : 1.0);
        const double chance = draws.uniform();
        const double wanted = (p.winter ? 0.42 : 0.62) * look.amount + 0.3 * (p.clouds - 1.0);
        if (chance > wanted || x_px < -width_px || x_px > p.picture_size.x + width_px) return;
        clouds.push_back(
            make_heap(p, draws, {x_px, base_px}, width_px, tall, clearness(elevation)));
      });
}

// Long level bars in front of a low sun, lit from below, in bundles: the lower, the thinner and
// closer.
void add_bars(std::vector<Cloud>& clouds, const SkyParameters& p, const SkyLook& look) {
  const double scale_px = cloud_scale_px(p);
  const std::uint64_t seed = stream_seed(p.seed, Stream::cloud_banks, 13);
  const auto last = static_cast<std::int64_t>(p.picture_size.x / (2.2 * scale_px)) + 1;
  std::int64_t cell = 0;
  for (double elevation = 0.025; elevation < 0.66; elevation *= 1.34) {
    for (std::int64_t k = -1; k <= last; ++k) {
      Draws draws(seed, cell++);
      const double centre = (static_cast<double>(k) + draws.uniform()) * 2.2 * scale_px;
      const double height = elevation * draws.between(0.85, 1.2);
      const double half_px = scale_px * (0.35 + 1.5 * height) * draws.between(0.7, 1.6);
      const double thick_px = scale_px * (0.012 + 0.10 * height) * draws.between(0.6, 1.3);
      // Like all rows, bars start at the vanishing point: slightly inclined, more so towards the
      // sides.
      const double tilt =
          std::clamp((centre - look.vanishing_px.x) / p.picture_size.x, -0.8, 0.8) * -0.10;
      const double chance = draws.uniform();
      if (chance > 0.62 * look.amount + 0.4 * (p.clouds - 1.0)) continue;
      const double base_px = p.horizon_px * (1.0 - height);
      Cloud bar{static_cast<float>(base_px + std::abs(tilt) * half_px),
                {},
                {},
                static_cast<float>(0.9 * clearness(height)),
                0,
                {}};
      const int heads = 12 + static_cast<int>(10.0 * draws.uniform());
      for (int h = 0; h < heads; ++h) {
        const double u = -1.0 + 2.0 * (h + draws.uniform()) / heads;
        const double swell = std::sqrt(std::max(0.0, 1.0 - u * u));
        const double radius = thick_px * (0.30 + 0.70 * swell) * draws.between(0.6, 1.2);
        const double lift = draws.between(0.3, 1.2) * radius;
        const double stretch = draws.between(3.0, 7.0);
        bar.heads.push_back(
            {glm::vec2(glm::dvec2(centre + half_px * u, base_px + tilt * half_px * u - lift)),
             glm::vec2(glm::dvec2(radius * stretch, radius))});
      }
      std::stable_sort(
          bar.heads.begin(), bar.heads.end(),
          [](const CloudHead& a, const CloudHead& b) { return a.centre.y < b.centre.y; });
      close_cloud(p, bar, base_px, 2.0 * half_px, 2.0 * thick_px);
      bar.underlit = 1.0F;
      clouds.push_back(bar);
    }
  }
}

}  // namespace

// In widths of the picture: the origin of streaks, beyond its left edge, and how much farther out
// it is drawn the farther it is from the centre.
constexpr glm::dvec2 streaks_beside{-0.10, 1.2};

double cloud_scale_px(const SkyParameters& p) {
  return std::min(p.horizon_px, 0.09 * p.picture_size.x);
}

SkyKind find_sky_kind(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, SkyKind>, 8> names = {
      {{"any", SkyKind::any},
       {"fair", SkyKind::fair},
       {"rows", SkyKind::rows},
       {"streaks", SkyKind::streaks},
       {"banks", SkyKind::banks},
       {"cumulus", SkyKind::cumulus},
       {"front", SkyKind::front},
       {"evening", SkyKind::evening}}};
  for (const auto& [known, kind] : names)
    if (known == name) return kind;
  throw Error(ErrorKind::input, "sky",
              "unknown kind of sky \"" + std::string(name) +
                  "\"; allowed: any, fair, rows, streaks, banks, cumulus, front and evening");
}

SkyLook look_of_sky(const SkyParameters& p) {
  Draws draws(stream_seed(p.seed, Stream::sky_kind), 0);
  constexpr std::array<SkyKind, 4> kinds = {SkyKind::fair, SkyKind::rows, SkyKind::streaks,
                                            SkyKind::banks};
  SkyLook look;
  const SkyKind drawn =
      kinds[std::min<std::size_t>(3, static_cast<std::size_t>(4.0 * draws.uniform()))];
  look.kind = p.kind == SkyKind::any ? drawn : p.kind;
  look.amount = draws.between(0.65, 1.05);
  look.size = draws.between(0.78, 1.10);
  look.raised = draws.between(0.75, 1.15);
  look.heaped = look.kind == SkyKind::rows   ? draws.between(0.55, 0.9)
                : look.kind == SkyKind::fair ? draws.between(0.3, 0.8)
                                             : draws.between(0.0, 0.45);
  look.veils = look.kind == SkyKind::streaks ? draws.between(0.85, 1.15) : draws.between(0.35, 1.0);
  const double across = draws.between(0.12, 0.88);
  const double below = draws.between(1.10, 1.30);
  // All streaks lean in one direction, that of the wind: with an origin inside the picture they
  // would fan out like rays over a low sky.
  const double beside = across < 0.5 ? streaks_beside.x - streaks_beside.y * (0.5 - across)
                                     : 1.0 - streaks_beside.x + streaks_beside.y * (across - 0.5);
  look.vanishing_px = {(look.kind == SkyKind::streaks ? beside : across) * p.picture_size.x,
                       below * p.horizon_px};
  return look;
}

std::vector<Cloud> make_clouds(const SkyParameters& p) {
  std::vector<Cloud> clouds;
  if (p.clouds <= 0.0) return clouds;
  const SkyLook look = look_of_sky(p);
  switch (look.kind) {
    case SkyKind::rows:
      add_rows(clouds, p, look);
      break;
    case SkyKind::streaks:
      add_bands(clouds, p, look, streak_bands);
      break;
    case SkyKind::banks:
      add_bands(clouds, p, look, horizon_bands);
      break;
    case SkyKind::cumulus:
      add_cumulus(clouds, p, look);
      break;
    case SkyKind::front:
      add_bands(clouds, p, look, front_bands);
      break;
    case SkyKind::evening:
      add_bars(clouds, p, look);
      break;
    case SkyKind::any:
    case SkyKind::fair:
      add_bands(clouds, p, look, fair_bands);
      break;
  }
  std::stable_sort(clouds.begin(), clouds.end(),
                   [](const Cloud& a, const Cloud& b) { return a.base_px > b.base_px; });
  return clouds;
}

}  // namespace belvedere
