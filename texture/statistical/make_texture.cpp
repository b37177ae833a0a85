#include "texture/statistical/make_texture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "base/error.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "texture/statistical/clique_model.h"

namespace belvedere {
namespace {

constexpr int border_px = 32;        // added around a texture and cut off
constexpr int under_mask_px = 16;    // added around a mask: two pixels of the coarsest level
constexpr int sampler_sweeps = 300;  // of a model that is made by sampling only
constexpr int settling_rounds = 4;   // at the end of a level, without momentum
constexpr int record_px = 256;
constexpr int around_hole_px = 64;  // width of the picture that a hole's paint is fitted to
constexpr float even_spread =
    1.73F;  // √3: a uniform distribution of this half width has deviation 1

// Width of the differences of neighbours at a level: the detail that noise should add.
float detail_of(const CliqueModel& model, int level, int band) {
  constexpr float tenths_of_normal =
      3.1F;  // range between the chosen knots, in deviations of a normal distribution
  float widest = 0.F;
  for (const Clique& clique : model.cliques) {
    const CliqueType& t = clique.type;
    if (t.level != level || t.head != band || t.tail != band || t.single() ||
        std::abs(t.dx) + std::abs(t.dy) > 2)
      continue;
    const CliqueKnots knots = decode_knots(model.bands, clique);
    widest = std::max(widest, (knots[clique_knots - 5] - knots[4]) / tenths_of_normal);
  }
  return widest;
}

SeedNoise noise_of(const CliqueModel& model, const TextureParameters& parameters) {
  return {model.seed, model.seed_px,
          parameters.direction ? parameters.direction : own_directions(model, parameters.seed),
          parameters.seed};
}

// Fills changeable pixels with means of the known values around, from the edge inwards.
Grid<float> spread_known(const Grid<float>& known, const Grid<std::uint8_t>& states) {
  Grid<float> out = known;
  Grid<std::uint8_t> open = states;
  for (bool more = true; more;) {
    more = false;
    const Grid<float> before = out;
    const Grid<std::uint8_t> still = open;
    for (int y = 0; y < out.height(); ++y)
      for (int x = 0; x < out.width(); ++x) {
        if ((still(x, y) & pixel_changes) == 0) continue;
        float sum = 0.F;
        float count = 0.F;
        for (int j = std::max(0, y - 1); j < std::min(out.height(), y + 2); ++j)
          for (int i = std::max(0, x - 1); i < std::min(out.width(), x + 2); ++i)
            if (still(i, j) == pixel_counts) {
              sum += before(i, j);
              count += 1.F;
            }
        if (count == 0.F) continue;
        out(x, y) = sum / count;
        open(x, y) = pixel_counts;
        more = true;
      }
  }
  return out;
}

// Initial state of a level: noise over all values at the coarsest, otherwise the coarser level plus
// noise. Fixed pixels are those of `known`; where there are some, the coarsest level begins close
// to them: the flow moves values to the model's and keeps their order, so that what is bright next
// to the hole continues bright.
void begin_level(FlowState& state, const CliqueModel& model, int level, const SeedNoise& noise,
                 TexturePosition position, const BandPyramid* known = nullptr) {
  BandPicture& picture = state.pyramid[static_cast<std::size_t>(level)];
  const bool top = level == model.levels;
  for (int b = 0; b < 3; ++b) {
    const auto band = static_cast<std::size_t>(b);
    const Grid<float> grain =
        seed_noise(noise, position, picture.width(), picture.height(), level, b);
    // Detail of width 0 cannot be stretched, so there is always some.
    const float amplitude = 2.F * std::max(.5F, .5F * (top ? 0.F : detail_of(model, level, b)));
    const float low = model.bands.low[band];
    const float high = model.bands.high[band];
    const bool beside = top && known != nullptr;
    const Grid<float> around =
        beside ? spread_known((*known)[static_cast<std::size_t>(level)].bands[band], picture.states)
               : Grid<float>();
    constexpr float free_share =
        .25F;  // share of the value range that noise adds near known pixels
    parallel_rows(picture.height(), [&](int y) {
      for (int x = 0; x < picture.width(); ++x) {
        if ((picture.states(x, y) & pixel_changes) == 0) {
          if (known != nullptr)
            picture.bands[band](x, y) = (*known)[static_cast<std::size_t>(level)].bands[band](x, y);
          continue;
        }
        const float u = grain(x, y);
        picture.bands[band](x, y) =
            beside ? std::clamp(around(x, y) + free_share * (u - .5F) * (high - low), low, high)
            : top  ? low + u * (high - low)
                  : enlarged(state.pyramid[static_cast<std::size_t>(level) + 1].bands[band], x, y) +
                        amplitude * even_spread * (u - .5F);
      }
    });
  }
  state.speed = BandPicture(picture.width(), picture.height());
}

// Round i of n at a level. Tables are counted, or given; the tables used are returned.
FlowRound flow_once(FlowState& state, const CliqueModel& model, int level, int i, int n,
                    const FlowRound* given) {
  renew_coarser(state.pyramid, level);
  FlowRound tables = given != nullptr ? *given : find_tables(state.pyramid, model, level);
  FlowStep step;
  if (i + settling_rounds >= n) step.momentum = 0.F;
  flow(state, model, level, tables, step);
  return tables;
}

struct Making {
  const TextureRecord* replay = nullptr;
  TextureRecord* record = nullptr;
  const BandPyramid* known = nullptr;
};

// From a pyramid whose states mark what is made, to its finest picture.
BandPicture run(const CliqueModel& model, BandPyramid pyramid, TexturePosition position,
                const TextureParameters& parameters, Making making, Progress& progress) {
  const std::int64_t pixels = static_cast<std::int64_t>(pyramid.front().states.size());
  FlowState state{std::move(pyramid), {}};
  const SeedNoise noise = noise_of(model, parameters);
  const int rounds = model.sampled ? 0 : parameters.rounds;
  PolishParameters polishing{
      .sweeps = parameters.sweeps, .share_floor = parameters.share_floor, .seed = parameters.seed};
  if (model.sampled)
    polishing = {.sweeps = sampler_sweeps,
                 .share_floor = sampler_share_floor,
                 .seed = parameters.seed,
                 .resolve = false};
  std::size_t polished = 0;
  for (int level = model.levels; level >= 0; --level) {
    begin_level(state, model, level, noise, position, making.known);
    const auto at = static_cast<std::size_t>(model.levels - level);
    if (making.record != nullptr) making.record->rounds.emplace_back();
    for (int i = 0; i < rounds; ++i) {
      const FlowRound* given = making.replay != nullptr
                                   ? &making.replay->rounds[at][static_cast<std::size_t>(i)]
                                   : nullptr;
      FlowRound taken = flow_once(state, model, level, i, rounds, given);
      if (making.record != nullptr) making.record->rounds[at].push_back(std::move(taken));
    }
    if (model.polish && polishing.sweeps > 0 && level <= parameters.polish_from) {
      const TexturePosition pixel{position.x >> level, position.y >> level};
      PolishRecord* record =
          making.record != nullptr ? &making.record->polishes.emplace_back() : nullptr;
      polish(state, model, level, polishing, pixel,
             making.replay != nullptr ? &making.replay->polishes[polished++] : nullptr, record);
    }
    progress.advance(static_cast<double>(pixels >> (2 * level)));
  }
  return std::move(state.pyramid.front());
}

BandPyramid empty_pyramid(int width, int height, int levels) {
  return make_pyramid(BandPicture(width, height), levels);
}

double work_of(std::int64_t pixels, int levels) {
  double work = 0.0;
  for (int level = 0; level <= levels; ++level) work += static_cast<double>(pixels >> (2 * level));
  return work;
}

}  // namespace

void check_texture_size(std::int64_t width, std::int64_t height) {
  if (width >= 1 && height >= 1 && width <= max_texture_pixels && height <= max_texture_pixels &&
      width * height <= max_texture_pixels)
    return;
  throw Error(
      ErrorKind::limit, "the texture's size", fmt::format("{} × {} pixels", width, height),
      fmt::format("1 pixel to {} Mpixels; make larger ones in windows", max_texture_pixels >> 20));
}

TextureTrial::TextureTrial(const CliqueModel& model, int width, int height, std::uint64_t seed)
    : state_{make_pyramid(BandPicture(width, height), model.levels), {}},
      noise_{TextureSeed::white, 0.F, {}, seed} {}

void TextureTrial::begin_level(const CliqueModel& model, int level) {
  belvedere::begin_level(state_, model, level, noise_, {});
}

void TextureTrial::run(const CliqueModel& model, int level, int rounds) {
  for (int i = 0; i < rounds; ++i) flow_once(state_, model, level, i, rounds, nullptr);
}

BandPicture noise_picture(const CliqueModel& model, int width, int height, std::uint64_t seed) {
  CliqueModel alone = model;
  alone.levels = 0;
  FlowState state{make_pyramid(BandPicture(width, height), 0), {}};
  begin_level(state, alone, 0, {TextureSeed::white, 0.F, {}, seed}, {});
  return std::move(state.pyramid.front());
}

Grid<Rgb8> make_texture(const CliqueModel& model, int width, int height,
                        const TextureParameters& parameters, Progress& progress) {
  check_texture_size(width, height);
  const int wide = width + 2 * border_px;
  const int high = height + 2 * border_px;
  progress.begin("making a texture", work_of(std::int64_t{wide} * high, model.levels));
  const BandPicture made =
      run(model, empty_pyramid(wide, high, model.levels), {}, parameters, {}, progress);
  return part_of(to_picture(made, model.bands),
                 {border_px, border_px, border_px + width, border_px + height});
}

Grid<Rgb8> make_texture_under(const CliqueModel& model, const Grid<std::uint8_t>& mask,
                              const TextureParameters& parameters, Progress& progress) {
  check_texture_size(mask.width(), mask.height());
  const PixelRect box = box_of(mask);
  Grid<Rgb8> out(mask.width(), mask.height());
  if (box.empty()) return out;
  // Multiples of the pyramid's cells, so that these are the same for any mask.
  const int cell = 1 << model.levels;
  const auto down = [cell](int at) {
    return (at >= 0 ? at / cell : -((cell - 1 - at) / cell)) * cell;
  };
  const PixelRect around{down(box.x0 - border_px), down(box.y0 - border_px), box.x1 + border_px,
                         box.y1 + border_px};
  Grid<std::uint8_t> wide(around.width(), around.height());
  for (int y = 0; y < wide.height(); ++y)
    for (int x = 0; x < wide.width(); ++x) wide(x, y) = mask.clamped(around.x0 + x, around.y0 + y);
  BandPicture finest(around.width(), around.height());
  wide = widened(wide, under_mask_px);
  for (std::size_t i = 0; i < wide.size(); ++i)
    finest.states[i] = wide[i] != 0 ? pixel_free : std::uint8_t{0};
  progress.begin("making a texture", work_of(static_cast<std::int64_t>(wide.size()), model.levels));
  const BandPicture made = run(model, make_pyramid(std::move(finest), model.levels),
                               {around.x0, around.y0}, parameters, {}, progress);
  const Grid<Rgb8> picture = to_picture(made, model.bands);
  for (int y = box.y0; y < box.y1; ++y)
    std::copy_n(picture.row(y - around.y0) + (box.x0 - around.x0), box.width(),
                out.row(y) + box.x0);
  return out;
}

TextureRecord record_texture(const CliqueModel& model, const TextureParameters& parameters) {
  TextureRecord record;
  run(model, empty_pyramid(record_px, record_px, model.levels), {}, parameters, {.record = &record},
      silent_progress());
  return record;
}

TexturePiece make_piece(const CliqueModel& model, const TextureRecord& record, PixelRect piece,
                        const TextureParameters& parameters, Progress& progress) {
  const int mask = (1 << model.levels) - 1;
  piece.x0 &= ~mask;  // also for negative numbers
  piece.y0 &= ~mask;
  check_texture_size(piece.width(), piece.height());
  BandPyramid pyramid = empty_pyramid(piece.width(), piece.height(), model.levels);
  const BandPicture made = run(model, std::move(pyramid), {piece.x0, piece.y0}, parameters,
                               {.replay = &record}, progress);
  return {piece, to_picture(made, model.bands)};
}

Grid<Rgb8> make_window(const CliqueModel& model, const TextureRecord& record, PixelRect window,
                       const TextureParameters& parameters, Progress& progress) {
  if (model.sampled)
    throw Error(ErrorKind::usage, "the texture model",
                "it is made by sampling from noise, so its windows do not match",
                "a size instead of a window, or a model learnt with --method flow");
  check_texture_size(window.width(), window.height());
  const PixelRect tiles{tile_below(window.x0), tile_below(window.y0), tile_below(window.x1 - 1) + 1,
                        tile_below(window.y1 - 1) + 1};
  constexpr int side = endless_tile_px + 2 * endless_margin_px;
  progress.begin("making a window",
                 work_of(std::int64_t{side} * side, model.levels) * tiles.width() * tiles.height());
  Grid<Rgb8> out(window.width(), window.height());
  for (int ty = tiles.y0; ty < tiles.y1; ++ty) {
    for (int tx = tiles.x0; tx < tiles.x1; ++tx) {
      const PixelRect inner = {tx * endless_tile_px, ty * endless_tile_px,
                               (tx + 1) * endless_tile_px, (ty + 1) * endless_tile_px};
      const TexturePiece tile =
          make_piece(model, record, grown(inner, endless_margin_px), parameters, progress);
      const PixelRect part = intersection(inner, window);
      for (int y = part.y0; y < part.y1; ++y)
        std::copy_n(tile.picture.row(y - tile.piece.y0) + (part.x0 - tile.piece.x0), part.width(),
                    out.row(y - window.y0) + (part.x0 - window.x0));
    }
  }
  return out;
}

namespace {

// Removes the step at a hole's border as in seamless cloning (Pérez, Gangnet, Blake 2003): the
// difference between the known neighbours and the pixels made next to them is diffused into the
// hole, fading within some pixels, and added.
void meet_border(BandPicture& made, const BandSpace& space) {
  constexpr float share = .75F;  // of the difference: neighbours in paint differ too
  constexpr float keeps = .96F;  // of it, per pixel
  constexpr int sweeps = 48;
  const int width = made.width();
  const int height = made.height();
  const Grid<std::uint8_t> states = made.states;
  const auto free_at = [&](int x, int y) {
    return states.contains(x, y) && (states(x, y) & pixel_changes) != 0;
  };
  constexpr std::array<std::array<int, 2>, 4> beside = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (std::size_t b = 0; b < 3; ++b) {
    Grid<float>& band = made.bands[b];
    Grid<float> correction(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (free_at(x, y) || (states(x, y) & pixel_counts) == 0) continue;
        float sum = 0.F;
        float count = 0.F;
        for (const auto& step : beside)
          if (free_at(x + step[0], y + step[1])) {
            sum += band(x + step[0], y + step[1]);
            count += 1.F;
          }
        if (count > 0.F) correction(x, y) = share * (band(x, y) - sum / count);
      }
    for (int n = 0; n < sweeps; ++n) {
      const Grid<float> before = correction;
      parallel_rows(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
          if (!free_at(x, y)) continue;
          float sum = 0.F;
          float count = 0.F;
          for (const auto& step : beside)
            if (states.contains(x + step[0], y + step[1])) {
              sum += before(x + step[0], y + step[1]);
              count += 1.F;
            }
          correction(x, y) = keeps * sum / count;
        }
      });
    }
    for (std::size_t i = 0; i < band.size(); ++i)
      if ((states[i] & pixel_changes) != 0)
        band[i] = std::clamp(band[i] + correction[i], space.low[b], space.high[b]);
  }
}

}  // namespace

Grid<Rgb8> fill_texture(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& hole,
                        const CliqueModel& model, const TextureParameters& parameters,
                        Progress& progress) {
  return fill_among(picture, hole, Grid<std::uint8_t>(picture.width(), picture.height(), 1), {},
                    model, parameters, progress);
}

Grid<Rgb8> fill_among(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& hole,
                      const Grid<std::uint8_t>& counts, TexturePosition position,
                      const CliqueModel& model, const TextureParameters& parameters,
                      Progress& progress) {
  if (!hole.same_size(picture) || !counts.same_size(picture))
    throw Error(ErrorKind::bug, "fill_among", "picture, hole and counts have different sizes");
  PixelRect box = box_of(hole);
  if (box.empty()) return picture;
  // The pyramid's cells depend on the box, so it begins at whole ones.
  const int cell = 1 << model.levels;
  box = intersection(grown(box, around_hole_px), {0, 0, picture.width(), picture.height()});
  box.x0 -= box.x0 % cell;
  box.y0 -= box.y0 % cell;
  if (std::int64_t{box.width()} * box.height() > max_texture_pixels)
    throw Error(
        ErrorKind::limit, "the hole",
        fmt::format("spans {} × {} pixels with its surroundings", box.width(), box.height()),
        fmt::format("at most {} Mpixels; fill its parts one after the other",
                    max_texture_pixels >> 20));

  Grid<std::uint8_t> known_states(box.width(), box.height(), pixel_free);
  Grid<std::uint8_t> states(box.width(), box.height(), pixel_counts);
  for (int y = 0; y < box.height(); ++y)
    for (int x = 0; x < box.width(); ++x)
      if (hole(box.x0 + x, box.y0 + y) != 0) {
        known_states(x, y) = 0;
        states(x, y) = pixel_free;
      } else if (counts(box.x0 + x, box.y0 + y) == 0) {
        known_states(x, y) = 0;
        states(x, y) = 0;
      }
  const BandPyramid known =
      make_pyramid(to_bands(part_of(picture, box), model.bands, known_states), model.levels);
  BandPicture finest(box.width(), box.height());
  finest.states = states;
  BandPyramid pyramid = make_pyramid(std::move(finest), model.levels);
  // A coarse pixel changes only if all four that it covers do: one across the border would request
  // all of the change from its new half.
  for (std::size_t l = 1; l < pyramid.size(); ++l) {
    const Grid<std::uint8_t>& fine = pyramid[l - 1].states;
    Grid<std::uint8_t>& coarse = pyramid[l].states;
    for (int y = 0; y < coarse.height(); ++y)
      for (int x = 0; x < coarse.width(); ++x) {
        std::uint8_t all = pixel_free;
        std::uint8_t any = 0;
        for (int j = 0; j < 2; ++j)
          for (int i = 0; i < 2; ++i) {
            all &= fine.clamped(2 * x + i, 2 * y + j);
            any |= fine.clamped(2 * x + i, 2 * y + j);
          }
        coarse(x, y) = static_cast<std::uint8_t>((all & pixel_changes) | (any & pixel_counts));
      }
  }
  progress.begin("filling", work_of(static_cast<std::int64_t>(states.size()), model.levels));
  const TexturePosition at{position.x + box.x0, position.y + box.y0};
  BandPicture filled = run(model, std::move(pyramid), at, parameters, {.known = &known}, progress);
  meet_border(filled, model.bands);
  const Grid<Rgb8> made = to_picture(filled, model.bands);
  Grid<Rgb8> out = picture;
  for (int y = 0; y < box.height(); ++y)
    for (int x = 0; x < box.width(); ++x)
      if (states(x, y) == pixel_free) out(box.x0 + x, box.y0 + y) = made(x, y);
  return out;
}

}  // namespace belvedere
