#include "renderer/style/stroke_direction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/style/fit/missing_classes.h"
#include "renderer/style/style_cumulus.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// In units of the sheet.
constexpr double fine_sigma_units = 1.6;     // details smaller than this have no direction
constexpr double form_sigma_units = 4.0;     // window of the structure tensor
constexpr double turn_sigma_units = 1.2;     // smoothing of directions
constexpr double wave_sigma_x_units = 72.0;  // of nearly level strokes
constexpr double wave_sigma_y_units = 48.0;
// Swirls of the scales between which StyleBrushwork::steadiness is measured, px of the painting.
// With these sigmas and this flow a sky rendered in van Gogh's style has the painting's steadiness
// within 0.06.
constexpr std::array<double, 3> swirl_sigmas_px = {14.0, 28.0, 56.0};
constexpr double flow_share = 1.8;
constexpr double swirl_width = 1.25;
constexpr std::array<double, 4> usual_steadiness = {0.8, 0.65, 0.45, 0.35};
// Small swirls come in groups: a gentle share everywhere, the rest where another noise is high.
constexpr float even_share = 0.25F;
constexpr float group_share = 1.6F;
// Sky strokes that are coherent but not level run in swirls. Of the paintings fitted so far only
// van Gogh's have them.
constexpr double max_level_of_swirls = 0.4;
constexpr double min_coherence_of_swirls = 0.5;

constexpr double form_share = 1.4;
constexpr double level_on_slopes = 0.35;  // level strokes occur mostly on plains
constexpr double upright_trees = 0.6;

// Weights of the directions that the strokes of a class mix.
struct ClassDirection {
  float level = 0.0F;
  float form = 0.0F;
  float fall = 0.0F;
  float upright = 0.0F;
};

ClassDirection direction_of(const StyleBrushwork& brushwork, LandCoverClass id) {
  const bool plain = id == water || id == valley_floor || id == pasture;
  const bool steep = !plain && id != settlement && id != sand;
  ClassDirection of;
  of.level = static_cast<float>(std::max(brushwork.level, 0.0) * (plain ? 1.0 : level_on_slopes));
  of.form = static_cast<float>(form_share * std::max(brushwork.form, 0.1));
  of.fall = steep ? 0.8F : 0.3F;
  if (id == forest) of.upright = static_cast<float>(upright_trees);
  return of;
}

// Direction of light and dark forms by the structure tensor: the vector of the doubled angle, whose
// length is the coherence, 0…1.
std::array<Grid<float>, 2> form_direction(const Grid<glm::vec3>& lab, double ppu,
                                          glm::ivec2 origin_px) {
  Grid<float> light(lab.width(), lab.height());
  for (std::size_t i = 0; i < lab.size(); ++i) light[i] = lab[i].x;
  light = blur_in_picture(light, std::max(fine_sigma_units * ppu, 0.8), origin_px);
  Grid<float> xx_yy(lab.width(), lab.height());
  Grid<float> xy2(lab.width(), lab.height());
  Grid<float> both(lab.width(), lab.height());
  parallel_rows(lab.height(), [&](int y) {
    for (int x = 0; x < lab.width(); ++x) {
      const float gx = light.clamped(x + 1, y) - light.clamped(x - 1, y);
      const float gy = light.clamped(x, y + 1) - light.clamped(x, y - 1);
      const std::size_t i = light.index(x, y);
      xx_yy[i] = gx * gx - gy * gy;
      xy2[i] = 2.0F * gx * gy;
      both[i] = gx * gx + gy * gy;
    }
  });
  for (Grid<float>* grid : {&xx_yy, &xy2, &both})
    *grid = blur_in_picture(*grid, form_sigma_units * ppu, origin_px);
  // Forms run perpendicular to the gradient, which negates the doubled angle's vector.
  for (std::size_t i = 0; i < both.size(); ++i) {
    const float even = -1.0F / std::max(both[i], 1e-9F);
    xx_yy[i] *= even;
    xy2[i] *= even;
  }
  return {std::move(xx_yy), std::move(xy2)};
}

bool shows_sky(const GuidanceBuffers& guidance) {
  for (std::size_t i = 0; i < guidance.depth_m.size(); ++i)
    if (guidance.is_sky(i)) return true;
  return false;
}

// Nearly level: doubled angles. Empty where the window has no sky.
std::array<Grid<float>, 2> level_direction(const StyleBrushwork& brushwork,
                                           const GuidanceBuffers& guidance,
                                           const StylePaintParameters& parameters,
                                           glm::ivec2 origin_px) {
  if (!shows_sky(guidance)) return {};
  const int width = guidance.width();
  const int height = guidance.height();
  Grid<float> waves(width, height, 0.0F);
  for (int octave = 0; octave < 2; ++octave) {
    const double finer = 1.0 / (1 << octave);
    const Grid<float> noise = make_image_noise(
        stream_seed(parameters.seed, Stream::style_directions, static_cast<std::uint64_t>(octave)),
        origin_px, width, height, parameters.pixels_per_unit, finer * wave_sigma_x_units,
        finer * wave_sigma_y_units);
    const float share = octave == 0 ? 0.95F : 0.3F;
    for (std::size_t i = 0; i < waves.size(); ++i) waves[i] += share * noise[i];
  }
  const double max_angle = 0.12 * (1.0 - std::clamp(brushwork.level, 0.0, 1.0)) + 0.02;
  std::array<Grid<float>, 2> of = {Grid<float>(width, height), Grid<float>(width, height)};
  parallel_ranges(height, 16, [&](int begin, int end) {
    for (std::size_t i = waves.index(0, begin); i < waves.index(0, end); ++i) {
      const exact::Turn turn = exact::turn(2.0 * max_angle * waves[i]);
      of[0][i] = static_cast<float>(turn.cosine);
      of[1][i] = static_cast<float>(turn.sine);
    }
  });
  return of;
}

// Swirls of several sizes in a level flow: along the contours of a stream function. Each size turns
// as much of the flow as the painting's strokes turn on that scale. Doubled angles; empty where the
// window has no sky.
std::array<Grid<float>, 2> swirl_direction(const Style& style, const GuidanceBuffers& guidance,
                                           const StylePaintParameters& parameters,
                                           glm::ivec2 origin_px) {
  if (!shows_sky(guidance)) return {};
  const StyleBrushwork& brushwork = brushwork_of(style, sky);
  const auto& kept = brushwork.steadiness.front() > 0.0 ? brushwork.steadiness : usual_steadiness;
  const double ppu = parameters.pixels_per_unit;
  const double px = sheet_px_per_painting_px(style, parameters);
  const int width = guidance.width();
  const int height = guidance.height();
  Grid<float> stream(width + 2, height + 2, 0.0F);  // with a border of one pixel
  const auto noise_of = [&](std::size_t which, double sigma_units) {
    return make_image_noise(stream_seed(parameters.seed, Stream::style_directions,
                                        2 + static_cast<std::uint64_t>(which)),
                            origin_px - 1, width + 2, height + 2, ppu, swirl_width * sigma_units,
                            sigma_units);
  };
  for (std::size_t k = 0; k < swirl_sigmas_px.size(); ++k) {
    const double sigma_px = swirl_sigmas_px[k] * px;
    // A noise's slope has the deviation 1 / (√2 sigma).
    const auto height_px = static_cast<float>(
        std::sqrt(2.0 * std::max(0.0, square(kept[k]) - square(kept[k + 1]))) * sigma_px);
    const Grid<float> noise = noise_of(2 * k, sigma_px / ppu);
    const bool largest = k + 1 == swirl_sigmas_px.size();
    const Grid<float> groups = largest ? Grid<float>() : noise_of(2 * k + 1, 3.0 * sigma_px / ppu);
    for (std::size_t i = 0; i < stream.size(); ++i)
      stream[i] += height_px * noise[i] *
                   (largest ? 1.0F : even_share + group_share * std::max(0.0F, groups[i]));
  }
  const auto flow = static_cast<float>(2.0 * flow_share * kept.back());  // over two pixels
  std::array<Grid<float>, 2> of = {Grid<float>(width, height), Grid<float>(width, height)};
  parallel_ranges(height, 16, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      for (int x = 0; x < width; ++x) {
        // Along the contour: perpendicular to the gradient.
        const float down = stream(x + 1, y + 2) - stream(x + 1, y) + flow;
        const float right = stream(x + 2, y + 1) - stream(x, y + 1);
        const float even = 1.0F / std::max(down * down + right * right, 1e-12F);
        of[0](x, y) = (down * down - right * right) * even;
        of[1](x, y) = -2.0F * down * right * even;
      }
  });
  return of;
}

// Unit vector of half of a doubled angle, by square roots alone.
glm::vec2 half_turn(float cosine, float sine) {
  const float length = std::sqrt(cosine * cosine + sine * sine);
  if (!(length > 1e-6F)) return {1.0F, 0.0F};
  const float c = std::sqrt(std::max(0.0F, 0.5F * (1.0F + cosine / length)));
  const float s = std::sqrt(std::max(0.0F, 0.5F * (1.0F - cosine / length)));
  return {c, sine < 0.0F ? -s : s};
}

}  // namespace

bool has_swirls(const StyleBrushwork& sky) {
  return sky.level < max_level_of_swirls && sky.coherence > min_coherence_of_swirls;
}

const StyleBrushwork& brushwork_of(const Style& style, LandCoverClass id) {
  const auto own = [&](LandCoverClass of) -> const StyleBrushwork& {
    return style.brushwork[static_cast<std::size_t>(of)];
  };
  if (own(id).length_px > 0.0) return own(id);
  if (id == water && own(sky).length_px > 0.0) return own(sky);  // as for its colours
  for (const LandCoverClass relative : relatives_of(id))
    if (own(relative).length_px > 0.0) return own(relative);
  for (std::size_t k = style.brushwork.size(); k-- > 0;)
    if (style.brushwork[k].length_px > 0.0) return style.brushwork[k];
  return own(id);
}

Grid<glm::vec2> make_stroke_direction(const Style& style, const GuidanceBuffers& guidance,
                                      const Grid<glm::vec3>& lab,
                                      const StylePaintParameters& parameters,
                                      glm::ivec2 origin_px) {
  const double ppu = parameters.pixels_per_unit;
  // Cosines and sines of doubled angles.
  const std::array<Grid<float>, 2> forms = form_direction(lab, ppu, origin_px);
  std::array<ClassDirection, land_cover_class_count> mixes;
  for (const LandCoverClassInfo& row : land_cover_classes())
    mixes[static_cast<std::size_t>(row.id)] = direction_of(brushwork_of(style, row.id), row.id);
  const StyleBrushwork& sky_brushwork = brushwork_of(style, sky);
  const std::array<Grid<float>, 2> skies =
      has_swirls(sky_brushwork) ? swirl_direction(style, guidance, parameters, origin_px)
                                : level_direction(sky_brushwork, guidance, parameters, origin_px);
  // Strokes follow the forms of cumulus clouds.
  const auto cumulus =
      static_cast<float>(cumulus_share(style.sky) * form_share * std::max(sky_brushwork.form, 0.0));

  Grid<float> cosine(lab.width(), lab.height());
  Grid<float> sine(lab.width(), lab.height());
  parallel_ranges(lab.height(), 16, [&](int begin, int end) {
    for (std::size_t i = lab.index(0, begin); i < lab.index(0, end); ++i) {
      if (guidance.is_sky(i)) {
        cosine[i] = skies[0][i] + cumulus * forms[0][i];
        sine[i] = skies[1][i] + cumulus * forms[1][i];
        continue;
      }
      const ClassDirection& of = mixes[static_cast<std::size_t>(guidance.land_cover[i])];
      const glm::vec2 fall = guidance.fall_line[i];
      const float c =
          of.level + of.form * forms[0][i] + of.fall * (square(fall.x) - square(fall.y));
      const float s = of.form * forms[1][i] + of.fall * 2.0F * fall.x * fall.y;
      const float rest = 1.0F - of.upright * (2.0F / 3.0F);
      cosine[i] = rest * c - of.upright;
      sine[i] = rest * s;
    }
  });
  cosine = blur_in_picture(cosine, turn_sigma_units * ppu, origin_px);
  sine = blur_in_picture(sine, turn_sigma_units * ppu, origin_px);
  Grid<glm::vec2> along(lab.width(), lab.height());
  parallel_ranges(lab.height(), 16, [&](int begin, int end) {
    for (std::size_t i = along.index(0, begin); i < along.index(0, end); ++i)
      along[i] = half_turn(cosine[i], sine[i]);
  });
  return along;
}

int stroke_direction_margin_px(const StylePaintParameters& parameters) {
  const double ppu = parameters.pixels_per_unit;
  return blur_reach_px(std::max(fine_sigma_units * ppu, 0.8)) + 1 +
         blur_reach_px(form_sigma_units * ppu) + blur_reach_px(turn_sigma_units * ppu);
}

}  // namespace belvedere
