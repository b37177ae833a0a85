#include "renderer/paint/light.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "renderer/paint/ground/snow_relief.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/paint/ribs.h"

namespace belvedere {
namespace {

constexpr double shadow_blur_units = 0.8;
constexpr double sky_blur_units = 1.5;
constexpr float brightest_tone = 1.02F;
constexpr float pool_strength = 0.035F;
// Far ranges: pools of light and shade larger than a mountain, so that several summits belong
// together and one leads; where such a pool is in shade, whole flanks lose detail.
constexpr double far_pool_sigma_units[2][2] = {{121.0, 27.0}, {52.0, 14.0}};
constexpr float far_pool_strength = 0.15F;
constexpr float far_calm = 0.38F;
// Rock inside forest is weathered and mossy: a small white shape there would read as a boulder, not
// as a cliff.
constexpr double outcrop_sigma_units = 12.0;  // forest within this is "around"
constexpr float outcrop_calm = 0.50F;         // share of contrast that it loses …
constexpr float outcrop_shade = 0.20F;        // … and how much darker it is
constexpr float calm_from_m =
    16.0F;  // metres of ground in a unit of the sheet from which forms are simplified …
constexpr float calm_to_m = 42.0F;  // … and at which they are fully simplified

// Snow reflects light, so that its shade has forms too, and its shadows have clear edges.
constexpr float snow_wrap = 0.10F;
constexpr float snow_fill = 0.26F;
constexpr float snow_detail =
    0.68F;  // share of its normal that comes from the ground in full detail
constexpr float snow_toe =
    0.17F;  // tones below and above which the range is compressed instead of clipped
constexpr float snow_shoulder = 0.74F;
constexpr float close_bright = 0.80F;  // tone of near snow above which light is compressed
constexpr float snow_hollow = 0.055F;  // how much darker the hollows of swells are
constexpr float cornice_units = 5.0F;  // height of the overhanging edge drawn below a crest
constexpr float lip_units = 1.3F;      // of that, the lit lip; the rest is its shade

// Share of the ribs that a slope shows: none on flat ground, all where it is steep.
float steepness(float slope_deg) { return std::clamp((slope_deg - 18.0F) / 20.0F, 0.0F, 1.0F); }

// Rock's contrast pushes its shade below the darkest paint, where a wall would lose its forms:
// below `toe` tones are compressed instead.
float keep_forms(float tone) {
  constexpr float toe = 0.26F;
  return tone >= toe
             ? tone
             : toe * static_cast<float>(exact::exp(static_cast<double>((tone - toe) / toe)));
}

// Level of detail of the ground: 1 near, falling to .35 where a unit of the sheet covers so much
// ground that the DEM's small forms would break a range into specks.
float fineness(const GuidanceBuffers& g, std::size_t i, double pixels_per_unit) {
  const float metres_per_unit = g.footprint_m[i] * static_cast<float>(pixels_per_unit);
  return 1.0F - 0.65F * std::clamp((metres_per_unit - calm_from_m) / (calm_to_m - calm_from_m),
                                   0.0F, 1.0F);
}

// Light of one pixel before contrast: sun, sky, relief and edges.
float raw_light(const GuidanceBuffers& g, std::size_t i, float shadow, float sky_view, float fine,
                const GroundLight& own, const ToneParameters& p) {
  const ClassTone& light = class_info(g.land_cover[i]).tone;
  const glm::vec3 detail =
      has_trait(g.land_cover[i], ClassTrait::own_relief) ? g.normal_detail[i] : g.normal[i];
  const float share = light.detail * fine;
  const glm::vec3 normal = glm::normalize(detail * share + g.normal_smooth[i] * (1.0F - share));
  const auto wrap = static_cast<float>(p.wrap);
  const float towards = glm::dot(normal, glm::vec3(own.sun));
  const float facing = std::clamp((towards + wrap) / (1.0F + wrap), 0.0F, 1.0F);
  const float sun = facing * (1.0F - static_cast<float>(p.light.shadow_depth) * (1.0F - shadow));
  const float sky =
      static_cast<float>(exact::pow(static_cast<double>(std::max(sky_view, 0.0F)), 1.3)) *
      (0.6F + 0.4F * normal.z);
  const float relief = 0.5F * std::clamp(g.relief_m_m[i] / 70.0F, -1.0F, 1.0F) +
                       0.5F * std::clamp(g.relief_l_m[i] / 250.0F, -1.0F, 1.0F);
  const float edges = std::clamp(g.relief_s_m[i] / 10.0F, -1.2F, 1.2F);
  return static_cast<float>(p.light.sun) * own.strength * sun +
         static_cast<float>(p.light.sky) * sky + static_cast<float>(p.light.relief) * relief +
         light.edges * fine * edges;
}

// Tone of snow: never quite at the ends of its ramp while it still has forms.
// The transition from light to shade is short, so that its flanks read as planes.
float keep_snow(float tone) {
  constexpr float from = 0.25F;
  constexpr float to = 0.75F;
  constexpr float crispness = 0.65F;
  if (tone > from && tone < to)
    tone += crispness * (from + (to - from) * smoothstep(from, to, tone) - tone);
  if (tone < snow_toe)
    return snow_toe *
           static_cast<float>(exact::exp(static_cast<double>((tone - snow_toe) / snow_toe)));
  constexpr float above = brightest_tone - snow_shoulder;
  if (tone > snow_shoulder)
    return brightest_tone - above * static_cast<float>(exact::exp(
                                        static_cast<double>((snow_shoulder - tone) / above)));
  return tone;
}

// Light before contrast on wind-shaped snow. Steep snow slides: it has runnels (ribs) and no
// drifts.
float snow_light(const GuidanceBuffers& g, std::size_t i, float shadow, float sky_view, float fine,
                 float close, const SnowForm& form, const GroundLight& own,
                 const ToneParameters& p) {
  const float share = snow_detail * fine;
  const glm::vec3 ground =
      glm::normalize(g.normal_detail[i] * share + g.normal[i] * (1.0F - share));
  // Near snow has forms of its own (renderer/close).
  const float laid = (1.0F - 0.75F * smoothstep(24.0F, 44.0F, g.slope_deg[i])) *
                     (0.35F + 0.65F * fine) * (1.0F - close);
  const glm::vec2 rise = glm::vec2(ground) / -std::max(ground.z, 0.15F) + laid * form.slope;
  const glm::vec3 normal = glm::normalize(glm::vec3(-rise, 1.0F));
  const glm::vec3 sun_direction(own.sun);
  const float facing =
      std::clamp((glm::dot(normal, sun_direction) + snow_wrap) / (1.0F + snow_wrap), 0.0F, 1.0F);
  const float sun = facing * (1.0F - static_cast<float>(p.light.shadow_depth) *
                                         (1.0F - smoothstep(0.15F, 0.85F, shadow)));
  const float sky =
      static_cast<float>(exact::pow(static_cast<double>(std::max(sky_view, 0.0F)), 1.3)) *
      (0.6F + 0.4F * normal.z);
  const glm::vec3 opposite = glm::normalize(glm::vec3(-sun_direction.x, -sun_direction.y, 0.35F));
  const float fill = snow_fill * (0.5F * glm::dot(normal, opposite) + 0.2F);
  const float relief = 0.5F * std::clamp(g.relief_m_m[i] / 70.0F, -1.0F, 1.0F) +
                       0.5F * std::clamp(g.relief_l_m[i] / 250.0F, -1.0F, 1.0F);
  const float edges = std::clamp(g.relief_s_m[i] / 10.0F, -1.2F, 1.2F);
  return static_cast<float>(p.light.sun) * own.strength * sun +
         static_cast<float>(p.light.sky) * sky + fill +
         static_cast<float>(p.light.relief) * relief +
         class_info(g.land_cover[i]).tone.edges * fine * edges +
         snow_hollow * laid * std::clamp(form.height, -1.6F, 1.0F);
}

// Pixels that the crest rule looks up for a silhouette and down for its tone.
int crest_px(double pixels_per_unit) {
  return std::max(1, static_cast<int>(std::lround(2.0 * pixels_per_unit)));
}
int below_crest_px(double pixels_per_unit) {
  return std::max(crest_px(pixels_per_unit) + 1,
                  static_cast<int>(std::lround(3.0 * pixels_per_unit)));
}

int cornice_px(double pixels_per_unit) {
  return static_cast<int>(std::ceil(static_cast<double>(cornice_units) * pixels_per_unit));
}

// The crest rule: the topmost pixels of a silhouette face away from the viewer and would draw a
// dark line along every ridge, so they take the tone from below where that is lighter. Only for the
// wanted pixels.
Grid<float> lift_crests(const Grid<float>& tone, const GuidanceBuffers& g, double pixels_per_unit,
                        PixelRect wanted) {
  const int reach = crest_px(pixels_per_unit);
  Grid<float> lifted(wanted.width(), wanted.height());
  parallel_rows(wanted.height(), [&](int row) {
    const int y = wanted.y0 + row;
    const int below = y + below_crest_px(pixels_per_unit);
    for (int x = wanted.x0; x < wanted.x1; ++x) {
      float& out = lifted(x - wanted.x0, row);
      out = tone(x, y);
      const float depth = g.depth_m(x, y);
      if (below >= tone.height() || std::isinf(depth) || !same_surface(depth, g.depth_m(x, below)))
        continue;
      bool crest = false;
      for (int k = 1; k <= reach && y - k >= 0 && !crest; ++k)
        crest = g.depth_m(x, y - k) > depth * (1.0F + surface_tolerance);
      if (crest) out = std::max(tone(x, y), tone(x, below));
    }
  });
  return lifted;
}

// Cornices: along a crest of snow in front of farther ground, an intermittent lit lip above a
// narrow shade. `broken` is noise of deviation 1 at the wanted pixels.
void draw_cornices(Grid<float>& tone, const GuidanceBuffers& g, const Grid<float>& broken,
                   const ToneParameters& p, PixelRect wanted) {
  const auto scale = static_cast<float>(p.pixels_per_unit);
  const int reach = cornice_px(p.pixels_per_unit);
  parallel_rows(wanted.height(), [&](int row) {
    const int y = wanted.y0 + row;
    for (int x = wanted.x0; x < wanted.x1; ++x) {
      if (!has_trait(g.land_cover(x, y), ClassTrait::icy)) continue;
      const float hangs = smoothstep(-0.1F, 0.7F, broken(x - wanted.x0, row));
      if (hangs <= 0.0F) continue;
      const float depth = g.depth_m(x, y);
      int up = 1;
      while (up <= reach && y - up >= 0 &&
             !(g.depth_m(x, y - up) > depth * (1.0F + surface_tolerance)))
        ++up;
      if (up > reach || y - up < 0) continue;
      const float below = (static_cast<float>(up) - 0.5F) / scale;
      float& out = tone(x - wanted.x0, row);
      const float lip = 1.0F - smoothstep(lip_units - 0.5F, lip_units + 0.3F, below);
      const float shade = (1.0F - lip) * (1.0F - smoothstep(lip_units, cornice_units, below));
      out = std::clamp(
          out + hangs * (0.55F * lip * std::max(0.0F, 0.98F - out) - 0.26F * shade * out), 0.0F,
          brightest_tone);
    }
  });
}

// The light of each pixel of `made`; empty where all have the picture's.
Grid<GroundLight> local_lights(const GuidanceBuffers& g, const ToneParameters& p, PixelRect made) {
  if (!p.light_field) return {};
  Grid<GroundLight> lights(g.width(), g.height());
  parallel_rows(made.height(), [&](int row) {
    for (int x = made.x0; x < made.x1; ++x) {
      const std::size_t i = lights.index(x, made.y0 + row);
      if (!g.is_sky(i))
        lights[i] = ground_light(p, glm::dvec2(g.position_m[i]) + glm::dvec2(g.origin_m));
    }
  });
  return lights;
}

Grid<float> sides_of(const Grid<GroundLight>& lights) {
  Grid<float> sides(lights.width(), lights.height());
  for (std::size_t i = 0; i < sides.size(); ++i) sides[i] = lights[i].side;
  return sides;
}

// Large pools of light and shade at the pixels of `made`, about -1.6 (shade) … 1.3.
Grid<float> far_pools(const ToneParameters& p, glm::ivec2 origin_px, PixelRect made) {
  const auto noise = [&](std::uint64_t part) {
    const double* sigma = far_pool_sigma_units[part - 1];
    return make_image_noise(stream_seed(p.seed, Stream::light_pools, part),
                            origin_px + glm::ivec2(made.x0, made.y0), made.width(), made.height(),
                            p.pixels_per_unit, sigma[0], sigma[1]);
  };
  Grid<float> pools = noise(1);
  const Grid<float> small = noise(2);
  for (std::size_t i = 0; i < pools.size(); ++i)
    pools[i] = std::clamp(pools[i] + 0.45F * small[i], -1.6F, 1.3F);
  return pools;
}

// Share of forest around each wide pixel that a rectangle of the sheet reads, 0…1; other pixels
// hold 0.
Grid<float> woods_around(const WideView& wide, double pixels_per_unit, PixelRect sheet_rect) {
  Grid<float> woods(wide.seen.width(), wide.seen.height(), 0.0F);
  for (std::size_t i = 0; i < woods.size(); ++i)
    woods[i] = wide.seen.land_cover[i] == LandCoverClass::forest ? 1.0F : 0.0F;
  const PixelRect asked =
      moved(wide_rect(sheet_rect, wide.factor), -wide.origin_px.x, -wide.origin_px.y);
  return blur_on_surface(woods, wide.seen.depth_m,
                         outcrop_sigma_units * pixels_per_unit / wide.factor,
                         intersection({0, 0, woods.width(), woods.height()}, surface_look(asked)));
}

}  // namespace

bool is_white(LandCoverClass id, bool winter) {
  using enum LandCoverClass;
  if (has_trait(id, ClassTrait::icy)) return true;
  return winter && (id == valley_floor || id == pasture || id == alpine_grass || id == shrub ||
                    id == scree || id == sand);
}

glm::vec3 times_light(const glm::vec3& colour, float light) {
  glm::vec3 out;
  for (int c = 0; c < 3; ++c)
    out[c] = static_cast<float>(
        srgb_encoded(srgb_decoded(static_cast<double>(colour[c])) * static_cast<double>(light)));
  return out;
}

GroundLight ground_light(const ToneParameters& p, glm::dvec2 position_m) {
  if (p.light_field) return p.light_field->at(position_m);
  return {.sun = p.sun_direction, .side = p.sun_image_x < 0.0 ? -1.0F : 1.0F};
}

Grid<float> make_tone(const GuidanceBuffers& guidance, const ToneParameters& parameters,
                      glm::ivec2 origin_px, Progress& progress, PixelRect wanted) {
  return make_tone(guidance, {guidance, 1, origin_px}, parameters, origin_px, progress, wanted);
}

Grid<float> make_tone(const GuidanceBuffers& guidance, const WideView& wide,
                      const ToneParameters& parameters, glm::ivec2 origin_px, Progress& progress,
                      PixelRect wanted) {
  using B = GuidanceBuffers;
  require_channels(guidance,
                   {&B::depth_m, &B::position_m, &B::normal, &B::normal_detail, &B::normal_smooth,
                    &B::altitude_m, &B::land_cover, &B::shadow, &B::sky_view, &B::slope_deg,
                    &B::fall_line, &B::footprint_m, &B::relief_s_m, &B::relief_m_m, &B::relief_l_m},
                   "tone");
  const int width = guidance.width();
  const int height = guidance.height();
  const double ppu = parameters.pixels_per_unit;
  const PixelRect whole{0, 0, width, height};
  if (wanted.empty()) wanted = whole;
  // The crest rule reads the tone of pixels below.
  const PixelRect made =
      intersection(whole, {wanted.x0, wanted.y0, wanted.x1, wanted.y1 + below_crest_px(ppu)});
  progress.begin("light", made.height());
  const bool has_relief = has_channel(guidance, &B::rock_tone);

  const Grid<float> shadow =
      blur_on_surface(guidance.shadow, guidance.depth_m, shadow_blur_units * ppu, made);
  const Grid<float> sky_view =
      blur_on_surface(guidance.sky_view, guidance.depth_m, sky_blur_units * ppu, made);
  Grid<std::uint8_t> ribbed(width, height, 0);
  parallel_ranges(made.height(), 16, [&](int begin, int end) {
    for (int y = made.y0 + begin; y < made.y0 + end; ++y)
      for (int x = made.x0; x < made.x1; ++x) {
        const std::size_t i = ribbed.index(x, y);
        ribbed[i] = class_info(guidance.land_cover[i]).tone.ribs > 0.0F &&
                            steepness(guidance.slope_deg[i]) > 0.0F
                        ? 1
                        : 0;
      }
  });
  const Grid<GroundLight> local = local_lights(guidance, parameters, made);
  const Grid<float> ribs =
      parameters.ribs > 0.0
          ? make_ribs(guidance, wide, ribbed,
                      {ppu, parameters.sun_image_x, parameters.seed, sides_of(local)}, origin_px)
          : Grid<float>(guidance.width(), guidance.height(), 0.0F);
  const GroundLight everywhere{.sun = parameters.sun_direction};
  const Grid<float> woods = woods_around(wide, ppu, moved(made, origin_px.x, origin_px.y));
  const Grid<float> pool = make_image_noise(stream_seed(parameters.seed, Stream::light_pools),
                                            origin_px + glm::ivec2(made.x0, made.y0), made.width(),
                                            made.height(), ppu, 140.0, 60.0);

  const Grid<float> far_pool = far_pools(parameters, origin_px, made);

  const glm::dvec2 wind = snow_wind(parameters.sun_direction);
  Grid<float> tone(width, height, 0.0F);
  parallel_rows(made.height(), [&](int row) {
    const int y = made.y0 + row;
    SnowRelief laid(parameters.seed, wind);
    for (int x = made.x0; x < made.x1; ++x) {
      const std::size_t i = tone.index(x, y);
      if (guidance.is_sky(i)) continue;
      const LandCoverClass id = guidance.land_cover[i];
      const ClassTone& light = class_info(id).tone;
      // Rock with computed relief gets its light from there.
      const bool relief = has_relief && id == LandCoverClass::rock;
      const bool white = is_white(id, parameters.winter);
      float close = 0.0F;  // ground near enough for forms of its own
      float value = 0.0F;
      if (relief) {
        value = middle_tone + (guidance.rock_tone[i] - middle_tone) / light.contrast;
      } else {
        const float fine = fineness(guidance, i, ppu);
        if (has_relief) close = close_share(guidance.footprint_m[i] * static_cast<float>(ppu));
        const GroundLight& own = local.empty() ? everywhere : local[i];
        float raw = 0.0F;
        if (white) {
          const glm::dvec3 position = glm::dvec3(guidance.position_m[i]) + guidance.origin_m;
          const double metres_per_unit =
              std::max(0.01, static_cast<double>(guidance.footprint_m[i]) * ppu);
          const SnowForm form = laid.at({position.x, position.y}, metres_per_unit, ppu);
          raw = snow_light(guidance, i, shadow[i], sky_view[i], fine, close, form, own, parameters);
        } else {
          raw = raw_light(guidance, i, shadow[i], sky_view[i], fine, own, parameters);
        }
        if (ribbed[i] != 0)
          raw += static_cast<float>(parameters.ribs) * light.ribs * fine * ribs[i] *
                 steepness(guidance.slope_deg[i]) * (1.0F - close);
        value =
            std::clamp((raw - raw_black) / raw_range,
                       id == LandCoverClass::rock || white ? -0.3F : 0.0F, white ? 1.3F : 1.05F);
      }
      const float far = far_range_share(parameters.air, static_cast<double>(guidance.depth_m[i]),
                                        static_cast<double>(guidance.altitude_m[i]));
      const float far_light = far_pool(x - made.x0, row);
      if (far > 0.0F && far_light < 0.2F) {
        const GroundLight& own = local.empty() ? everywhere : local[i];
        const float broad =
            (raw_light(guidance, i, shadow[i], sky_view[i], 0.0F, own, parameters) - raw_black) /
            raw_range;
        value += far_calm * far * smoothstep(-0.2F, 1.2F, -far_light) * (broad - value);
      }
      value += light.lift;
      value += pool_strength * pool(x - made.x0, row);
      float contrast = light.contrast * static_cast<float>(parameters.light.contrast);
      if (id == LandCoverClass::rock) {
        const float wood =
            value_on_surface(wide, woods, origin_px.x + x, origin_px.y + y, guidance.depth_m[i]);
        const float outcrop = std::clamp((wood - 0.15F) / 0.4F, 0.0F, 1.0F);
        contrast *= 1.0F - outcrop_calm * outcrop;
        value -= outcrop_shade * outcrop;
      }
      float contrasted = middle_tone + (value - middle_tone) * contrast;
      contrasted += far_pool_strength * far * far_light;
      float kept = id == LandCoverClass::rock ? keep_forms(contrasted)
                   : white                    ? keep_snow(contrasted)
                                              : contrasted;
      if (close > 0.0F) {
        // Room for the forms in full light.
        if (white && kept > close_bright) kept -= close * 0.25F * (kept - close_bright);
        kept += guidance.rock_tone[i];
      }
      tone[i] = std::clamp(kept, 0.0F, brightest_tone);
    }
    progress.advance(1.0);
  });
  Grid<float> lifted = lift_crests(tone, guidance, ppu, wanted);
  const Grid<float> broken = make_image_noise(stream_seed(parameters.seed, Stream::snow_cornices),
                                              origin_px + glm::ivec2(wanted.x0, wanted.y0),
                                              wanted.width(), wanted.height(), ppu, 16.0, 16.0);
  draw_cornices(lifted, guidance, broken, parameters, wanted);
  return lifted;
}

int tone_near_margin_px(const ToneParameters& parameters) {
  const double ppu = parameters.pixels_per_unit;
  static_assert(sky_blur_units > shadow_blur_units);
  return std::max(
             {rib_near_margin_px(ppu), surface_reach_px(sky_blur_units * ppu), cornice_px(ppu)}) +
         below_crest_px(ppu) + 1;
}

int tone_margin_px(const ToneParameters& parameters) {
  const double ppu = parameters.pixels_per_unit;
  const int factor = wide_factor(ppu);
  const int blur =
      factor * (surface_reach_px(outcrop_sigma_units * ppu / factor) + surface_look_rows + 3);
  const int looked_up = std::max(rib_margin_px(ppu), blur) + below_crest_px(ppu) + 1;
  return std::max(looked_up, tone_near_margin_px(parameters));
}

}  // namespace belvedere
