#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/strokes/class_strokes.h"
#include "texture/strokes/parcels.h"
#include "texture/strokes/stroke_parts.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {
namespace {

// A position for a house in a row along a street: a cell of a lattice on the ground that is as fine
// as houses on the sheet allow.
struct Plot {
  std::uint64_t key;   // of the cell, for random numbers
  double away_px;      // from the pixel where it was found
  glm::vec2 position;  // px
  std::uint32_t pixel;
  bool street;                             // left open: a lane across the rows
  glm::vec2 lane_from{0.F}, lane_to{0.F};  // px: its part of the lane; equal where it is at none
};

using enum LandCoverClass;

constexpr float plot_width = 3.7F;      // units of the sheet per plot in a row …
constexpr float plot_height = 3.0F;     // … and vertically, with its garden
constexpr float same_plot_units = 8.F;  // plots farther apart are not duplicates
constexpr double turn_step = 0.3927;    // rad, 22.5°: a quarter has one direction
// Towns that grew over time have no grid: streets bend, plots vary in width, and rows of houses
// begin anywhere.
constexpr double bend_plots = 6.0;   // length of a street's bend, in plots …
constexpr double bend_rows = 0.9;    // … and its sideways offset, in rows
constexpr double width_plots = 2.2;  // extent of plots of one width, in plots …
constexpr double width_share = 0.5;  // … and the shift of their borders, in plots
constexpr int rows_of_block = 2;     // rows back to back, between two streets

glm::dvec2 ground_at(const StrokeScene& scene, std::size_t i) {
  const glm::dvec3 p = glm::dvec3(scene.guidance.position_m[i]) + scene.guidance.origin_m;
  return {p.x, p.y};
}

// The mapping between picture and ground around a pixel: metres of ground per pixel to the right
// and down, and its inverse.
struct GroundJacobian {
  glm::dvec2 right{0.0}, down{0.0};
  double area = 0.0;  // of the two, m²; 0: the ground is not visible from above

  glm::dvec2 to_picture(glm::dvec2 m) const {
    return glm::dvec2(m.x * down.y - m.y * down.x, right.x * m.y - right.y * m.x) / area;
  }
};

GroundJacobian ground_jacobian(const StrokeScene& scene, glm::vec2 position, std::size_t i) {
  const float step = std::max(1.F, std::round(1.5F * scene.scale()));
  const auto across = [&](glm::vec2 direction) {
    const glm::vec2 from = position - direction * step;
    const glm::vec2 to = position + direction * step;
    if (!scene.on_canvas(from) || !scene.on_canvas(to)) return glm::dvec2(0.0);
    const std::size_t a = scene.pixel(from);
    const std::size_t b = scene.pixel(to);
    for (const std::size_t k : {a, b})
      if (!(std::abs(scene.guidance.depth_m[k] / scene.guidance.depth_m[i] - 1.F) < 0.03F))
        return glm::dvec2(0.0);
    return (ground_at(scene, b) - ground_at(scene, a)) / (2.0 * static_cast<double>(step));
  };
  GroundJacobian lie;
  lie.right = across({1.F, 0.F});
  lie.down = across({0.F, 1.F});
  lie.area = lie.right.x * lie.down.y - lie.right.y * lie.down.x;
  return lie;
}

// A pitch of at least `min_m`, in steps of the square root of 2: neighbours agree on it.
double pitch_m(double min_m) {
  return exact::exp2(0.5 * std::ceil(2.0 * exact::log2(std::max(min_m, 1.0))));
}

bool find_plot(const StrokeScene& scene, Stream stream, glm::vec2 at, Plot& plot) {
  const std::size_t i = scene.pixel(at);
  if (scene.class_at(i) != settlement) return false;
  const GroundJacobian lie = ground_jacobian(scene, at, i);
  if (std::abs(lie.area) < 1e-6) return false;
  // Streets follow the relief; without a direction each quarter has its own.
  const glm::vec2 grain = scene.guidance.grain[i];
  double angle =
      0.6 * static_cast<double>(ground_noise(scene, i, Stream::street_directions, 900.0));
  if (std::abs(grain.x) + std::abs(grain.y) > 0.1F)
    angle = 0.5 * exact::atan2(static_cast<double>(grain.y), static_cast<double>(grain.x));
  const auto turn = static_cast<std::int64_t>(std::lround(angle / turn_step));
  const exact::Turn street = exact::turn(turn_step * static_cast<double>(turn));
  const glm::dvec2 along{street.cosine, street.sine};
  const glm::dvec2 across{-along.y, along.x};
  const auto plots_a_metre = [&](glm::dvec2 direction) {
    const glm::dvec2 d = lie.to_picture(direction) / static_cast<double>(scene.scale());
    return glm::length(d / glm::dvec2(plot_width, plot_height));
  };
  const double length = pitch_m(1.0 / plots_a_metre(along));
  const double depth = pitch_m(1.15 / plots_a_metre(across));
  const glm::dvec2 here = ground_at(scene, i);
  const auto bent = [&](std::uint64_t part, double sigma_m) {
    return gaussian_noise(stream_seed(scene.parameters.seed, Stream::street_directions, 1 + part),
                          here.x, here.y, sigma_m);
  };
  const double v = glm::dot(here, across) / depth + bend_rows * bent(0, bend_plots * length);
  const auto row = static_cast<std::int64_t>(std::floor(v));
  const std::int64_t block =
      row >= 0 ? row / rows_of_block : (row - rows_of_block + 1) / rows_of_block;
  const std::uint64_t key = stream_seed(scene.parameters.seed, stream);
  const double begins = random_uniform(key, block, turn, 1);
  const double u =
      glm::dot(here, along) / length + width_share * bent(1, width_plots * length) + 6.0 * begins;
  const auto column = static_cast<std::int64_t>(std::floor(u));
  plot.key =
      random_bits(key, column, row,
                  static_cast<std::uint64_t>(turn * 4096 + std::lround(length + 64.0 * depth)));
  // Rows are straighter than the gaps in them.
  const double aside = 0.5 + 0.36 * (random_uniform(plot.key, 0, 0) - 0.5);
  const double back = 0.5 + 0.2 * (random_uniform(plot.key, 0, 1) - 0.5);
  // Bends are smooth: at the nearest pixel, which decides, they hardly move a house.
  const glm::dvec2 to = along * ((static_cast<double>(column) + aside - u) * length) +
                        across * ((static_cast<double>(row) + back - v) * depth);
  const glm::dvec2 offset = lie.to_picture(to);
  plot.away_px = glm::length(offset);
  plot.position = at + glm::vec2(offset);
  if (plot.away_px > 4.0 * static_cast<double>(scene.scale()) || !scene.on_canvas(plot.position))
    return false;
  const std::size_t there = scene.pixel(plot.position);
  plot.pixel = static_cast<std::uint32_t>(there);
  plot.street = column % 6 == 0;
  // Between two blocks of rows runs a lane, across them another.
  const auto ground_px = [&](double plots_on, double rows_on) {
    return at + glm::vec2(
                    lie.to_picture(along * ((static_cast<double>(column) + plots_on - u) * length) +
                                   across * ((static_cast<double>(row) + rows_on - v) * depth)));
  };
  plot.lane_from = plot.lane_to = plot.position;
  if (plot.street) {
    plot.lane_from = ground_px(0.5, -0.1);
    plot.lane_to = ground_px(0.5, 1.1);
  } else if (row == block * rows_of_block) {
    plot.lane_from = ground_px(-0.1, 0.0);
    plot.lane_to = ground_px(1.1, 0.0);
  }
  return scene.class_at(there) == settlement &&
         std::abs(scene.guidance.depth_m[there] / scene.guidance.depth_m[i] - 1.F) < 0.03F;
}

// All plots of the picture, each once: found from the nearest pixel of a grid that is finer than
// the plots.
std::vector<Plot> find_plots(const StrokeScene& scene, Stream stream) {
  const float step = std::max(1.F, 1.4F * scene.scale());
  const SeededCells cells = scene.seeded_cells(step, false);
  const int down = std::max(0, cells.lines.last - cells.lines.first + 1);
  std::vector<std::vector<Plot>> rows(static_cast<std::size_t>(down));
  parallel_rows(down, [&](int row) {
    for (int x = cells.columns.first; x <= cells.columns.last; ++x) {
      const glm::vec2 at = (glm::vec2(x, cells.lines.first + row) + 0.5F) * step;
      Plot plot{};
      if (scene.on_canvas(at) && find_plot(scene, stream, at, plot))
        rows[static_cast<std::size_t>(row)].push_back(plot);
    }
  });
  std::vector<Plot> plots;
  for (const auto& row : rows) plots.insert(plots.end(), row.begin(), row.end());
  std::stable_sort(plots.begin(), plots.end(), [](const Plot& a, const Plot& b) {
    return a.key != b.key ? a.key < b.key : a.away_px < b.away_px;
  });
  std::vector<Plot> kept;
  for (std::size_t k = 0; k < plots.size(); ++k) {
    bool found_nearer = false;
    for (std::size_t other = k; other-- > 0 && plots[other].key == plots[k].key && !found_nearer;)
      found_nearer =
          glm::length(plots[other].position - plots[k].position) < same_plot_units * scene.scale();
    if (!found_nearer) kept.push_back(plots[k]);
  }
  return kept;
}

using enum LandCoverClass;

// Roofs: brick, old brick, weathered wood, slate; walls; encoded sRGB in full light.
constexpr std::array<glm::vec3, 4> roofs = {
    glm::vec3(0.76F, 0.37F, 0.26F), glm::vec3(0.64F, 0.30F, 0.22F), glm::vec3(0.49F, 0.31F, 0.27F),
    glm::vec3(0.42F, 0.44F, 0.50F)};
constexpr std::size_t red_roofs = 2;  // of them, from the first
constexpr glm::vec3 wall{0.97F, 0.93F, 0.84F};
constexpr glm::vec3 snowed{0.90F, 0.92F, 0.96F};
constexpr glm::vec3 dusk{0.33F, 0.36F, 0.50F};    // colour of a house's shadow
constexpr glm::vec3 leaves{0.27F, 0.40F, 0.24F};  // garden trees
constexpr glm::vec3 bare{0.38F, 0.38F, 0.42F};    // … in winter

// In villages drawn house by house most red roofs are a grey rose: red stays on groups, as accents.
constexpr float group_units = 3.0F;  // extent of a group on the sheet
constexpr float red_above = 0.52F;   // noise of deviation 1: 30 % of the roofs
constexpr glm::vec3 rose{1.10F, 0.99F, 0.93F};

// Lanes, where villages are drawn house by house.
constexpr float lane_width = 0.85F;       // units of the sheet
constexpr float lane_alpha = 0.75F;       // most of its paint …
constexpr float lane_from_built = 0.06F;  // … from this density of houses on, …
constexpr float lane_to_built = 0.20F;    // … all of it from here
constexpr glm::vec3 trodden{0.88F, 0.83F, 0.72F};
constexpr glm::vec3 trodden_snow{0.74F, 0.76F, 0.82F};

// 0 at the edge of a hamlet … .3 in a village … 1 in the centre of a large town.
float built_at(const StrokeScene& scene, std::size_t i) {
  return std::clamp(scene.guidance.built[i], 0.F, 1.F);
}

struct House {
  glm::vec2 foot;        // centre of the lower edge, px
  float width;           // px
  float height;          // of walls and roof, px
  std::size_t roof = 0;  // index into `roofs`
  float faded = 0.F;     // 0…1: how grey its roof has become
};

glm::vec3 roof_colour(const House& house) {
  const glm::vec3 tiles = roofs[house.roof];
  const float grey = 0.30F * tiles.r + 0.59F * tiles.g + 0.11F * tiles.b;
  return glm::mix(tiles, grey * rose + 0.03F, house.faded);
}

// How grey a red roof is: by groups, where villages are drawn house by house.
float faded_at(const StrokeScene& scene, std::size_t i, std::size_t roof) {
  if (roof >= red_roofs) return 0.F;
  const float share = village_share(scene.metres_per_unit(i));
  if (share <= 0.F) return 0.F;
  const float group = patch_noise(scene, i, Stream::house_density, group_units);
  return share * (1.F - smoothstep(red_above - 0.1F, red_above + 0.1F, group));
}

// A shadow away from the sun, a lit front, a gable in shade, and a roof with a sunlit edge.
void build(const StrokeScene& scene, const House& house, std::size_t i, StrokeSeed& seed,
           std::vector<Stroke>& out) {
  const float side = scene.sun_side(i);
  const float tone = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  const float light = 0.62F + 0.42F * tone;
  Stroke body = standing_stroke(scene, i);
  body.order = body.depth_m - 1.F;
  const float half = 0.5F * house.width;
  const float stripe = 0.5F * house.height;
  Stroke shade = body;
  shade.gate = StrokeGate::surface;
  set_line(shade, house.foot + glm::vec2(-0.7F * half * side, 0.F),
           house.foot + glm::vec2(-1.8F * half * side, 0.06F * house.height), 1.1F * stripe,
           0.6F * stripe);
  shade.alpha = 0.40F + 0.3F * tone;
  shade.colour = through_air(scene, i, dusk);
  out.push_back(shade);
  const float inner = half;
  const float value = 0.03F * seed.normal();
  Stroke front = body;
  front.tip = StrokeTip::square;
  front.order -= 0.5F;
  set_line(front, house.foot + glm::vec2(-inner, -0.5F * stripe),
           house.foot + glm::vec2(inner, -0.5F * stripe), stripe, stripe);
  front.alpha = 0.95F;
  front.colour = through_air(scene, i, wall * light + value);
  out.push_back(front);
  Stroke gable = front;
  gable.order -= 0.2F;
  const float end = -0.8F * half * side;
  set_line(gable, house.foot + glm::vec2(end, -0.25F * stripe),
           house.foot + glm::vec2(end, -stripe), 0.55F * half, 0.5F * half);
  gable.alpha = 0.75F;
  gable.colour = through_air(scene, i, glm::vec3(0.60F, 0.60F, 0.70F) * light);
  out.push_back(gable);
  Stroke roof = front;
  roof.order -= 0.5F;
  const glm::vec2 ridge{0.F, -house.height + 0.2F * stripe};
  set_line(roof, house.foot + ridge + glm::vec2(-inner * 1.1F, 0.F),
           house.foot + ridge + glm::vec2(inner * 1.1F, 0.F), 1.1F * stripe, 1.1F * stripe);
  const bool white = scene.parameters.winter && seed.uniform() < 0.7F;
  const float shift = 0.035F * seed.normal();
  const glm::vec3 tiles = white ? snowed : roof_colour(house) + shift;
  roof.colour = through_air(scene, i, tiles * (0.86F * light));
  out.push_back(roof);
  Stroke edge = roof;
  edge.order -= 0.2F;
  const glm::vec2 top = house.foot + ridge + glm::vec2(0.25F * half * side, -0.2F * stripe);
  set_line(edge, top - glm::vec2(0.35F * inner, 0.F), top + glm::vec2(0.55F * inner, 0.F),
           0.5F * stripe, 0.45F * stripe);
  edge.alpha = 0.25F + 0.5F * tone;
  edge.colour = through_air(
      scene, i, glm::min(tiles * light + glm::vec3(0.09F, 0.06F, 0.03F), glm::vec3(1.F)));
  out.push_back(edge);
}

// The part of a lane at a plot, only between houses.
void draw_lane(const StrokeScene& scene, const Plot& plot, float built, std::vector<Stroke>& out) {
  const std::size_t i = plot.pixel;
  const float share =
      village_share(scene.metres_per_unit(i)) * smoothstep(lane_from_built, lane_to_built, built);
  if (share <= 0.F || plot.lane_from == plot.lane_to) return;
  const float light = 0.58F + 0.42F * std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  StrokeSeed seed(plot.key, 2, 0);
  Stroke lane = ground_stroke(scene, i, seed);
  lane.order -= 0.5F;
  lane.gate = StrokeGate::same_class;
  const float width = lane_width * scene.scale();
  set_line(lane, plot.lane_from, plot.lane_to, width, width);
  lane.alpha = lane_alpha * share;
  lane.colour = through_air(scene, i, (scene.parameters.winter ? trodden_snow : trodden) * light);
  out.push_back(lane);
}

// A tree in a garden: a dark crown and its sunny side.
void plant_garden(const StrokeScene& scene, glm::vec2 foot, float width, std::size_t i,
                  StrokeSeed& seed, std::vector<Stroke>& out) {
  const float side = scene.sun_side(i);
  const float light = 0.62F + 0.42F * std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  const glm::vec3 crown = (scene.parameters.winter ? bare : leaves) + 0.03F * seed.normal();
  Stroke body = standing_stroke(scene, i);
  body.order = body.depth_m - 1.2F;
  body.gate = StrokeGate::upright;
  set_line(body, foot, foot - glm::vec2(0.F, 0.6F * width), width, 0.85F * width);
  body.alpha = 0.8F;
  body.colour = through_air(scene, i, crown * light);
  out.push_back(body);
  set_line(body, foot + glm::vec2(0.2F * side * width, -0.55F * width),
           foot + glm::vec2(0.15F * side * width, -0.8F * width), 0.5F * width, 0.4F * width);
  body.order -= 0.2F;
  body.alpha = 0.7F;
  body.colour = through_air(scene, i, crown * (1.4F * light) + glm::vec3(0.06F, 0.04F, 0.F));
  out.push_back(body);
}

// Centres of villages are searched on a grid over the sheet. Of two that are too close only the
// denser has a church, so that a search around a position decides whether there is one.
constexpr float net_units = 2.F;
constexpr int same_village = 8;  // nodes of the grid
constexpr float min_built = 0.12F;

// Density of houses at a node of the grid; nothing outside settlements.
std::optional<float> built_on_net(const StrokeScene& scene, glm::ivec2 node) {
  const glm::vec2 position = (glm::vec2(node) + 0.5F) * (net_units * scene.scale());
  if (!scene.on_canvas(position)) return std::nullopt;
  const std::size_t i = scene.pixel(position);
  if (scene.class_at(i) != settlement) return std::nullopt;
  return scene.guidance.built[i];
}

// The density at a node that is a local maximum: the centre of a village or a quarter.
std::optional<float> centre_at(const StrokeScene& scene, glm::ivec2 node) {
  const std::optional<float> here = built_on_net(scene, node);
  if (!here || *here < min_built) return std::nullopt;
  for (const glm::ivec2 way :
       {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)})
    if (const std::optional<float> beside = built_on_net(scene, node + way);
        beside && *beside > *here)
      return std::nullopt;
  return here;
}

// Whether another centre in the same village is denser; ties are resolved at random.
bool is_outdone(const StrokeScene& scene, glm::ivec2 node, float built, std::uint64_t key) {
  const std::uint64_t lot = random_bits(key, node.x, node.y);
  for (int y = -same_village; y <= same_village; ++y)
    for (int x = -same_village; x <= same_village; ++x) {
      if ((x == 0 && y == 0) || x * x + y * y >= same_village * same_village) continue;
      const glm::ivec2 other = node + glm::ivec2(x, y);
      const std::optional<float> density = centre_at(scene, other);
      if (density &&
          (*density > built || (*density == built && random_bits(key, other.x, other.y) > lot)))
        return true;
    }
  return false;
}

// A church: nave and spire, which rises above the roofs and is visible from afar.
void build_church(const StrokeScene& scene, glm::vec2 foot, float unit, std::size_t i,
                  StrokeSeed& seed, std::vector<Stroke>& out) {
  build(scene, {foot, 4.2F * unit, 2.6F * unit, 3}, i, seed, out);
  Stroke tower = standing_stroke(scene, i);
  tower.order = tower.depth_m - 3.F;
  tower.gate = StrokeGate::upright;
  const float side = scene.sun_side(i);
  const glm::vec2 base = foot + glm::vec2(-1.9F * side * unit, 0.F);
  const float light = 0.62F + 0.42F * std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  set_line(tower, base, base + glm::vec2(0.F, -3.6F * unit), 1.3F * unit, 1.2F * unit);
  tower.tip = StrokeTip::square;
  tower.alpha = 0.95F;
  tower.colour = through_air(scene, i, wall * light);
  out.push_back(tower);
  set_line(tower, base + glm::vec2(0.F, -3.8F * unit), base + glm::vec2(0.F, -7.6F * unit),
           1.3F * unit, 0.1F * unit);
  tower.tip = StrokeTip::square;
  tower.order -= 0.5F;
  tower.colour = through_air(scene, i, roofs[3] * (0.8F * light));
  out.push_back(tower);
}

}  // namespace

std::vector<Stroke> houses(const StrokeScene& scene, Stream stream) {
  std::vector<Stroke> all;
  for (const Plot& plot : find_plots(scene, stream)) {
    StrokeSeed seed(plot.key, 1, 0);
    const float built = built_at(scene, plot.pixel);
    const float quarter = 0.12F * ground_noise(scene, plot.pixel, Stream::house_density, 160.0);
    draw_lane(scene, plot, built, all);
    // Blocks between lanes in the centre, scattered houses and gardens at the edge.
    const bool lane = plot.street && built > 0.3F;
    if (lane || seed.uniform() > std::clamp(0.34F + 0.75F * built + quarter, 0.15F, 0.97F)) {
      if (!lane && seed.uniform() < 0.55F)
        plant_garden(scene, plot.position, seed.between(1.5F, 2.4F) * scene.scale(), plot.pixel,
                     seed, all);
      continue;
    }
    const float u = seed.uniform();
    const bool large = built > 0.55F && seed.uniform() < 0.07F;  // a hall, a school, a factory
    const float width =
        large ? seed.between(4.6F, 6.6F) : seed.between(2.1F, 2.9F) + (0.4F + 1.1F * built) * u * u;
    const float height = large ? seed.between(2.2F, 3.0F) : seed.between(1.9F, 2.5F) + 0.6F * built;
    const float r = seed.uniform();
    const std::size_t roof = large ? 3 : r < 0.44F ? 0 : r < 0.72F ? 1 : r < 0.90F ? 2 : 3;
    build(scene,
          {plot.position, width * scene.scale(), height * scene.scale(), roof,
           faded_at(scene, plot.pixel, roof)},
          plot.pixel, seed, all);
  }
  return all;
}

// A church in the centre of every village, a few in a town.
std::vector<Stroke> churches(const StrokeScene& scene, Stream stream) {
  std::vector<Stroke> all =
      sow(scene, 24.F, stream,
          [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
            if (scene.class_at(i) != settlement || seed.uniform() > 0.45F) return;
            const auto stands = [&](std::size_t k) { return scene.class_at(k) == settlement; };
            if (share_around(scene, position, 3.F, stands) < 1.F || scene.guidance.built[i] < 0.5F)
              return;
            build_church(scene, position, seed.between(0.9F, 1.15F) * scene.scale(), i, seed, out);
          });
  const std::uint64_t key = stream_seed(scene.parameters.seed, Stream::church_centres);
  const float step = net_units * scene.scale();
  const auto [columns, lines] = scene.seeded_cells(step);
  for (int y = lines.first; y <= lines.last; ++y)
    for (int x = columns.first; x <= columns.last; ++x) {
      const std::optional<float> built = centre_at(scene, {x, y});
      if (!built || is_outdone(scene, {x, y}, *built, key)) continue;
      const glm::vec2 centre = (glm::vec2(x, y) + 0.5F) * step;
      StrokeSeed seed(key, x, y);
      build_church(scene, centre, (0.85F + 0.4F * *built) * scene.scale(), scene.pixel(centre),
                   seed, all);
    }
  return all;
}

// Single farms on valley floors and gentle slopes, each with a barn or a tree.
std::vector<Stroke> farms(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 13.F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        const LandCoverClass id = scene.class_at(i);
        const bool level = scene.slope_deg(i) < (id == pasture ? 15.F : 6.F);
        if ((id != valley_floor && id != pasture && !(id == snow && scene.parameters.winter)) ||
            !level || scene.altitude_m(i) > 1250.F)
          return;
        const float dense = 0.10F + 0.09F * ground_noise(scene, i, Stream::farm_density, 900.0);
        if (seed.uniform() > dense) return;
        const float scale = scene.scale();
        const float width = seed.between(2.4F, 3.2F) * scale;
        const float height = seed.between(2.0F, 2.5F) * scale;
        const std::size_t roof = seed.uniform() < 0.6F ? 0 : 2;
        build(scene, {position, width, height, roof}, i, seed, out);
        const float right = seed.uniform() < 0.5F ? 1.F : -1.F;
        const float down = seed.between(-1.F, 1.F);
        const float away = seed.between(3.F, 4.5F);
        const glm::vec2 beside = position + glm::vec2(right * away, down) * scale;
        if (!scene.on_canvas(beside)) return;
        const std::size_t k = scene.pixel(beside);
        if (scene.class_at(k) != id ||
            std::abs(scene.guidance.depth_m[k] / scene.guidance.depth_m[i] - 1.F) > 0.03F)
          return;
        if (seed.uniform() < 0.5F)
          build(scene, {beside, seed.between(1.8F, 2.4F) * scale, 1.8F * scale, 2}, k, seed, out);
        else
          plant_garden(scene, beside, 2.2F * scale, k, seed, out);
      });
}

}  // namespace belvedere
