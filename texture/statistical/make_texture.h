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
  int sweeps = 30;      // of the polish, where the model has one
  int polish_from = 1;  // coarsest level that is polished
  double share_floor = PolishParameters{}.share_floor;
  DirectionField direction{};  // of streaks; empty: the crop's own
};

// The same for pixels along a seam. The differences across it are few of all, and they are what is asked for: seams of beach and thicket
// (eight seeds) came to 1.10 in the mean, to 1.19 with the floor of other textures.
inline TextureParameters of_seam(TextureParameters parameters) {
  parameters.share_floor = sampler_share_floor;
  return parameters;
}

// Everything that a run took from counting, so that it can be done again elsewhere without counting: for windows of an endless texture.
struct TextureRecord {
  std::vector<std::vector<FlowRound>> rounds;  // of each level, the coarsest first
  std::vector<PolishRecord> polishes;          // of each level that is polished, the coarsest first
};

// A texture of its own: what is made anew at each size. Border pixels take part in fewer cliques and go wrong, so 32 more are made on every
// side and cut off. Error(limit) over most_texture_pixels. Progress: one step a level.
Grid<Rgb8> make_texture(const CliqueModel& model, int width, int height, const TextureParameters& parameters,
                        Progress& progress = silent_progress());
inline constexpr std::int64_t most_texture_pixels = std::int64_t{1} << 26;
void check_texture_size(std::int64_t width, std::int64_t height);

// As make_texture, but only where `mask` is not 0 and as far around it as its pyramid needs, which is what it costs; other pixels mean
// nothing. The mask may be thin: what is around is made along.
Grid<Rgb8> make_texture_under(const CliqueModel& model, const Grid<std::uint8_t>& mask, const TextureParameters& parameters,
                              Progress& progress = silent_progress());

// Noise over the ranges of all bands: what sampling begins with.
BandPicture noise_picture(const CliqueModel& model, int width, int height, std::uint64_t seed);

// A texture in the making whose model grows: what learning looks at.
class TextureTrial {
 public:
  TextureTrial(const CliqueModel& model, int width, int height, std::uint64_t seed);
  void begin_level(const CliqueModel& model, int level);
  void run(const CliqueModel& model, int level, int rounds);
  const BandPicture& picture(int level) const { return state_.pyramid[static_cast<std::size_t>(level)]; }

 private:
  FlowState state_;
  SeedNoise noise_;
};

// A run of 256² pixels with its tables, from which a texture without end is made. Some 13 MB; never kept in files, since a second makes it
// again.
TextureRecord record_texture(const CliqueModel& model, const TextureParameters& parameters);

// Any window of a texture without end: the same pixels whatever the window, in any order, because it is made of fixed tiles, each with what
// lies endless_margin_px around it. Farther than that nothing moves a pixel by more than one level (measured; the flow reaches as far in
// theory as it has rounds), so that tiles meet without a seam. Error(limit) over most_texture_pixels.
Grid<Rgb8> make_window(const CliqueModel& model, const TextureRecord& record, PixelRect window, const TextureParameters& parameters,
                       Progress& progress = silent_progress());
inline constexpr int endless_tile_px = 512;
inline constexpr int endless_margin_px = 96;
// A piece of such a texture in one, from tables alone; what lies nearer to its border than endless_margin_px is not yet right. Its left and
// upper side come to lie on multiples of 2^levels, at most that far outside: the piece that was made is `piece`.
struct TexturePiece {
  PixelRect piece;
  Grid<Rgb8> picture;
};
TexturePiece make_piece(const CliqueModel& model, const TextureRecord& record, PixelRect piece, const TextureParameters& parameters,
                        Progress& progress = silent_progress());

// Makes anew what `hole` marks (non-zero), to go with what is around it: lettering and figures taken out of a scan, wood grown over a
// clearing. No other pixel changes. The model is of what should stand there. Error(limit)
// where the hole spans more than most_texture_pixels.
Grid<Rgb8> fill_texture(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& hole, const CliqueModel& model,
                        const TextureParameters& parameters, Progress& progress = silent_progress());
// The same in a picture that shows other things too: nothing is taken from pixels where `counts` is 0, as if they were beyond its edge.
// `place`, in whole cells of 2^levels, is where the picture lies on a larger one, so that two parts of that begin with the same noise.
Grid<Rgb8> fill_among(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& hole, const Grid<std::uint8_t>& counts, TexturePlace place,
                      const CliqueModel& model, const TextureParameters& parameters, Progress& progress = silent_progress());

}  // namespace belvedere
