#include "renderer/paint/clouds/front_deck.h"

#include <algorithm>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "base/random_streams.h"

namespace belvedere {
namespace {

std::uint64_t deck_seed(const SkyParameters& parameters, std::uint64_t part) {
  return stream_seed(parameters.seed, Stream::front_decks, part);
}

}  // namespace

FrontDeck::FrontDeck(const SkyParameters& parameters, const SkyLook& look)
    : parameters_(parameters),
      look_(look),
      // It approaches from the side away from the light; otherwise the whole sky would be dark.
      side_(parameters.sun_image_x > 0.0 ? -1.0 : 1.0),
      edge_slope_(0.0),
      ragged_(deck_seed(parameters, 0), 1.0),
      torn_(deck_seed(parameters, 1), 1.0),
      folds_(deck_seed(parameters, 2), 1.0),
      fine_(deck_seed(parameters, 3), 1.0) {
  // Where the edge crosses the top of the picture: within its central half.
  const double across =
      0.5 + side_ * (0.05 - 0.30 * random_uniform(deck_seed(parameters, 4), 0, 0));
  const double x_px =
      (across - 0.12 * side_ * (parameters.clouds - 1.0)) * parameters.picture_size.x;
  edge_slope_ = (x_px - look.vanishing_px.x) / look.vanishing_px.y;
}

FrontDeck::Look FrontDeck::at(double x_px, double y_px) {
  const double elevation = 1.0 - y_px / parameters_.horizon_px;
  const double rise_px = look_.vanishing_px.y - y_px;
  if (elevation < 0.03 || rise_px <= 0.0) return {};
  const double along = exact::log(rise_px / cloud_scale_px(parameters_));
  const double ray = (x_px - look_.vanishing_px.x) / rise_px;
  const double beyond = side_ * (ray - edge_slope_);
  const float ragged =
      0.55F * ragged_(ray / 0.55, along / 0.16) + 0.30F * torn_(ray / 0.16, along / 0.07);
  const float density = static_cast<float>(beyond) * 1.1F + ragged;
  Look look;
  look.cover =
      smoothstep(-0.25F, 0.45F, density) * smoothstep(0.03F, 0.16F, static_cast<float>(elevation));
  // Rolls across its direction of movement, and threads along it; bright where it is thin.
  const float rolls =
      0.5F * folds_(ray / 1.3, along / 0.075) + 0.28F * fine_(ray / 0.22, along / 0.16);
  const float thin = 1.0F - smoothstep(0.10F, 1.25F, density);
  look.light = unit(0.30F + 0.24F * rolls + 0.62F * thin);
  return look;
}

}  // namespace belvedere
