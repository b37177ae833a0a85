#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/pixel_rect.h"
#include "base/progress.h"
#include "texture/statistical/clique_polish.h"
#include "texture/statistical/seed_noise.h"

namespace belvedere {

struct TextureParameters {
  std::uint64_t seed = 1;
  int rounds = 24;      // of the flow at each level
  int sweeps = 30;      // of the polish, if the model has one
  int polish_from = 1;  // coarsest level that is polished
  double share_floor = PolishParameters{}.share_floor;
  DirectionField direction{};  // of streaks; empty: the crop's own
};

// The same for pixels along a seam. The differences across it are few, yet they are what matters:
// seams of beach and thicket (eight seeds) reached a ratio of 1.10 on average, and 1.19 with the
// floor of other textures.
inline TextureParameters of_seam(TextureParameters parameters) {
  parameters.share_floor = sampler_share_floor;
  return parameters;
}

// All counted tables of a run, so that it can be repeated elsewhere without counting: for windows
// of an unbounded texture.
struct TextureRecord {
  std::vector<std::vector<FlowRound>> rounds;  // of each level, the coarsest first
  std::vector<PolishRecord> polishes;          // of each level that is polished, the coarsest first
};

// A texture of its own, made again for each size. Border pixels are part of fewer cliques and come
// out wrong, so 32 more are made on every side and cut off. Error(limit) over max_texture_pixels.
// Progress: one step per level.
Grid<Rgb8> make_texture(const CliqueModel& model, int width, int height,
                        const TextureParameters& parameters,
                        Progress& progress = silent_progress());
inline constexpr std::int64_t max_texture_pixels = std::int64_t{1} << 26;
void check_texture_size(std::int64_t width, std::int64_t height);

// As make_texture, but only where `mask` is not 0 and as far around it as its pyramid needs, which
// determines the cost; other pixels are undefined. The mask may be thin: its surroundings are made
// too.
Grid<Rgb8> make_texture_under(const CliqueModel& model, const Grid<std::uint8_t>& mask,
                              const TextureParameters& parameters,
                              Progress& progress = silent_progress());

// Noise over the ranges of all bands: the initial state of sampling.
BandPicture noise_picture(const CliqueModel& model, int width, int height, std::uint64_t seed);

// A texture in progress whose model grows: evaluated by learning.
class TextureTrial {
 public:
  TextureTrial(const CliqueModel& model, int width, int height, std::uint64_t seed);
  void begin_level(const CliqueModel& model, int level);
  void run(const CliqueModel& model, int level, int rounds);
  const BandPicture& picture(int level) const {
    return state_.pyramid[static_cast<std::size_t>(level)];
  }

 private:
  FlowState state_;
  SeedNoise noise_;
};

// A run of 256² pixels with its tables, from which an unbounded texture is made. About 13 MB; not
// kept in files, because it takes only a second to make.
TextureRecord record_texture(const CliqueModel& model, const TextureParameters& parameters);

// Any window of an unbounded texture: the same pixels whatever the window, in any order, because it
// is made of fixed tiles, each with its surroundings of endless_margin_px. Beyond that no pixel
// changes by more than one level (measured; in theory the flow reaches as far as its number of
// rounds), so that tiles meet without a seam. Error(limit) over max_texture_pixels.
Grid<Rgb8> make_window(const CliqueModel& model, const TextureRecord& record, PixelRect window,
                       const TextureParameters& parameters, Progress& progress = silent_progress());
inline constexpr int endless_tile_px = 512;
// The tile of a pixel along one axis, also left of and above 0.
inline int tile_below(int at) {
  return (at >= 0 ? at : at - endless_tile_px + 1) / endless_tile_px;
}
inline constexpr int endless_margin_px = 96;
// A piece of such a texture in one go, from tables alone; pixels closer to its border than
// endless_margin_px are not yet right. Its left and upper side are moved to multiples of 2^levels,
// at most that far outside: `piece` is the piece actually made.
struct TexturePiece {
  PixelRect piece;
  Grid<Rgb8> picture;
};
TexturePiece make_piece(const CliqueModel& model, const TextureRecord& record, PixelRect piece,
                        const TextureParameters& parameters,
                        Progress& progress = silent_progress());

// Synthesizes the pixels marked in `hole` (non-zero) to match their surroundings: lettering and
// figures removed from a scan, forest grown over a clearing. No other pixel changes. The model is
// that of the missing texture. Error(limit) if the hole spans more than max_texture_pixels.
Grid<Rgb8> fill_texture(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& hole,
                        const CliqueModel& model, const TextureParameters& parameters,
                        Progress& progress = silent_progress());
// The same in a picture that shows other things too: pixels where `counts` is 0 are ignored, as if
// they were beyond its edge. `position`, in whole cells of 2^levels, is the picture's position on a
// larger one, so that two parts of that begin with the same noise.
Grid<Rgb8> fill_among(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& hole,
                      const Grid<std::uint8_t>& counts, TexturePosition position,
                      const CliqueModel& model, const TextureParameters& parameters,
                      Progress& progress = silent_progress());

}  // namespace belvedere
