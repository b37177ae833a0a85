#pragma once

#include <array>

#include "base/grid.h"
#include "renderer/style/style.h"

namespace belvedere {

// The shares of StyleSkyChange::quantiles, and their normal deviates.
inline constexpr std::array<double, 7> sky_quantile_shares = {0.02, 0.1, 0.25, 0.5,
                                                              0.75, 0.9, 0.98};
inline constexpr std::array<double, 7> sky_quantile_deviates = {-2.054, -1.282, -0.674, 0.0,
                                                                0.674,  1.282,  2.054};
// Sigma of the first octave's kernel over the half-correlation length of the sum of octaves. A
// single Gaussian has .6; finer octaves shorten the correlation of the sum.
inline constexpr double sky_sigma_per_length = 1.28;

// Rows of a window that contain sky.
struct SkyWindow {
  glm::ivec2 origin_px;
  int width;
  int height;
};

// How far the clouds of a sky are cumulus, 0…1.
double cumulus_share(const StyleSky& sky);

// Cumulus clouds in a window of the sheet: bodies with round puffs, sharp and lit on their upper
// side, soft and shaded below, with the painting's share of clear sky between them. A function of
// the position on the sheet.
class StyleCumulus {
 public:
  StyleCumulus(const StyleSky& sky, const SkyWindow& window,
               const StylePaintParameters& parameters);

  // Share of cumulus in a row of the window, 0…1; towards the horizon clouds lie level. The other
  // members may be called where it is above 0.
  float share(int row) const;
  // How far a cloud hides the clear sky, 0…1.
  float cover(int x, int row) const;
  // Light on the cloud, as a normal deviate.
  double deviate(int x, int row) const;

 private:
  SkyWindow window_;
  int sky_rows_;
  double share_;
  float bare_ = 0.0F;              // thickness below which the sky is clear
  std::array<float, 7> lights_{};  // light at sky_quantile_shares
  Grid<float> thickness_;
  Grid<float> rise_;
};

}  // namespace belvedere
