#include "texture/composite/synthesize_seam.h"

#include <algorithm>
#include <cstddef>

#include "base/error.h"
#include "texture/composite/make_composite.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {
namespace {

constexpr int between_px =
    16;  // gap between two samples in the picture for learning: larger than a clique
// A band of six pixels has no coarse pixels of its own, so coarser levels contribute nothing.
constexpr int seam_levels = 1;
constexpr int seam_types = 24;
constexpr int seam_rounds = 12;
constexpr int seam_sweeps = 12;

}  // namespace

std::optional<CliqueModel> learn_seam(const SeamSample& one, const SeamSample& other) {
  const int width = one.picture.width() + between_px + other.picture.width();
  Grid<Rgb8> both(width, std::max(one.picture.height(), other.picture.height()));
  Grid<std::uint8_t> states(both.width(), both.height());
  std::size_t counted = 0;
  bool varied = false;
  const auto lay = [&](const SeamSample& sample, int left) {
    for (int y = 0; y < sample.picture.height(); ++y)
      for (int x = 0; x < sample.picture.width(); ++x) {
        both(left + x, y) = sample.picture(x, y);
        if (sample.counts(x, y) == 0) continue;
        states(left + x, y) = pixel_free;
        ++counted;
        varied |= x > 0 && sample.counts(x - 1, y) != 0 &&
                  sample.picture(x - 1, y) != sample.picture(x, y);
      }
  };
  lay(one, 0);
  lay(other, one.picture.width() + between_px);
  constexpr std::size_t min = std::size_t{min_crop_px} * min_crop_px;
  if (counted < min || !varied || both.height() < min_crop_px) return std::nullopt;
  LearnParameters learning;
  learning.types = seam_types;
  learning.levels = seam_levels;
  return learn_texture(both, states, learning).model;
}

Grid<Rgb8> synthesize_seam(const Grid<Rgb8>& picture, const SeamZone& zone,
                           TexturePosition position, const CliqueModel& model, std::uint64_t seed) {
  if (!zone.side.same_size(picture))
    throw Error(ErrorKind::bug, "synthesize_seam", "picture and sides have different sizes");
  TextureParameters making;
  making.seed = seed;
  making.rounds = seam_rounds;
  making.sweeps = seam_sweeps;
  making.polish_from = 0;
  Grid<Rgb8> out = fill_among(picture, zone.hole, zone.side, position, model, of_seam(making));
  // The zone contains pixels of neither side too, so that their colours count for neither; they
  // stay unchanged.
  Grid<std::uint8_t> remade = zone.hole;
  for (std::size_t i = 0; i < remade.size(); ++i)
    if (zone.side[i] == 0) remade[i] = 1;
  Grid<Rgb8> snapped = out;
  snap_colours(snapped, zone.side, remade, seam_half_px);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (zone.hole[i] != 0) out[i] = snapped[i];
  return out;
}

}  // namespace belvedere
