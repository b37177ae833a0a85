#include "renderer/stages/seam_ground.h"

#include <algorithm>
#include <cstddef>

#include "base/error.h"
#include "base/filter.h"
#include "base/grid.h"
#include "texture/composite/make_composite.h"
#include "texture/statistical/learn_texture.h"
#include "texture/synthesis/exemplar.h"

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

namespace {

constexpr std::size_t min_texels =
    1200;  // pixels of a class that make a sample: half of what a model is learnt from

glm::vec3 to_vec3(const Rgb8& rgb) { return glm::vec3(rgb[0], rgb[1], rgb[2]) / 255.F; }

// Whether two depths are one surface, as in blend_edges.
bool one_surface(float depth_a, float depth_b) {
  constexpr float ratio = 1.03F;
  return depth_a <= ratio * depth_b && depth_b <= ratio * depth_a;
}

// The square of a picture (or as much of it as exists) in which most pixels have the label: every
// eighth position is tested.
PixelRect fullest_square(const Grid<std::uint8_t>& labels, std::uint8_t label, std::size_t& max) {
  const int width = std::min(labels.width(), seam_sample_px);
  const int height = std::min(labels.height(), seam_sample_px);
  Grid<std::uint32_t> sums(labels.width() + 1, labels.height() + 1);
  for (int y = 0; y < labels.height(); ++y) {
    std::uint32_t row = 0;
    for (int x = 0; x < labels.width(); ++x) {
      row += labels(x, y) == label ? 1 : 0;
      sums(x + 1, y + 1) = sums(x + 1, y) + row;
    }
  }
  PixelRect best{0, 0, width, height};
  max = 0;
  for (int y = 0; y + height <= labels.height(); y += 8)
    for (int x = 0; x + width <= labels.width(); x += 8) {
      const std::size_t count =
          sums(x + width, y + height) - sums(x, y + height) - sums(x + width, y) + sums(x, y);
      if (count <= max) continue;
      max = count;
      best = {x, y, x + width, y + height};
    }
  return best;
}

// Seams of a window: for each synthesized pixel the two sources that meet there, the smaller first.
using Pair = std::pair<std::uint16_t, std::uint16_t>;
constexpr Pair no_pair{no_source, no_source};

Grid<Pair> find_seams(const PaintBeforeSeams& paint) {
  const Grid<std::uint16_t>& source = paint.source;
  Grid<Pair> seams(source.width(), source.height(), no_pair);
  for (int y = 0; y < source.height(); ++y)
    for (int x = 0; x < source.width(); ++x) {
      const std::uint16_t own = source(x, y);
      if (own == no_source) continue;
      const float depth = paint.depth_m(x, y);
      const auto meets = [&](int u, int v) {
        if (!source.contains(u, v)) return no_source;
        const std::uint16_t other = source(u, v);
        const bool seam = other != no_source && other >> 8U != own >> 8U &&
                          one_surface(depth, paint.depth_m(u, v));
        return seam ? other : no_source;
      };
      const std::uint16_t other =
          std::min({meets(x - 1, y), meets(x + 1, y), meets(x, y - 1), meets(x, y + 1)});
      if (other == no_source) continue;
      const Pair pair{std::min(own, other), std::max(own, other)};
      for (int v = y - seam_half_px + 1; v < y + seam_half_px; ++v)
        for (int u = x - seam_half_px + 1; u < x + seam_half_px; ++u)
          if (source.contains(u, v) && source(u, v) == own && seams(u, v) == no_pair &&
              one_surface(depth, paint.depth_m(u, v)))
            seams(u, v) = pair;
    }
  return seams;
}

}  // namespace

SeamSources find_seam_sources(const std::vector<PaintedExemplar>& exemplars,
                              const Residual& residual, std::uint64_t seed) {
  SeamSources sources;
  sources.seed = seed;
  for (const PaintedExemplar& painted : exemplars) {
    auto& of = sources.of.emplace_back();
    const Grid<std::uint8_t>& labels = painted.exemplar.guides.label;
    for (std::size_t id = 1; id < of.size(); ++id) {
      std::size_t texels = 0;
      const PixelRect square = fullest_square(labels, static_cast<std::uint8_t>(id), texels);
      if (texels < min_texels) continue;
      SeamSample& sample = of[id];
      sample.picture = Grid<Rgb8>(square.width(), square.height());
      sample.counts = Grid<std::uint8_t>(square.width(), square.height());
      for (int y = 0; y < square.height(); ++y)
        for (int x = 0; x < square.width(); ++x) {
          const glm::vec3* base =
              painted.base.empty() ? nullptr : &painted.base(square.x0 + x, square.y0 + y);
          const glm::vec3 texel = painted.picture(square.x0 + x, square.y0 + y);
          sample.picture(x, y) =
              to_rgb8(in_even_light(texel, base, residual, static_cast<LandCoverClass>(id)));
          sample.counts(x, y) = labels(square.x0 + x, square.y0 + y) == id ? 1 : 0;
        }
    }
  }
  return sources;
}

void add_model_sources(SeamSources& sources, const GroundModels& models, const Residual& residual) {
  for (std::size_t m = 0; m < models.models.size(); ++m) {
    auto& of = sources.of.emplace_back();
    Grid<Rgb8> made;
    Grid<glm::vec3> texel(seam_sample_px, seam_sample_px);
    Grid<glm::vec3> light = texel;
    for (std::size_t id = 1; id < of.size(); ++id) {
      if (models.lit[id] != m && models.shaded[id] != m) continue;
      if (made.empty()) {
        made = make_texture(models.models[m].model, seam_sample_px, seam_sample_px,
                            {.seed = models.models[m].seed});
        for (int c = 0; c < 3; ++c) {
          Grid<float> channel(made.width(), made.height());
          for (std::size_t i = 0; i < made.size(); ++i)
            channel[i] = texel[i][c] = to_vec3(made[i])[c];
          const Grid<float> blurred = gaussian_blur(channel, models.models[m].light_px);
          for (std::size_t i = 0; i < made.size(); ++i) light[i][c] = blurred[i];
        }
      }
      SeamSample& sample = of[id];
      sample.picture = made;
      sample.counts = Grid<std::uint8_t>(made.width(), made.height(), 1);
      for (std::size_t i = 0; i < made.size(); ++i)
        sample.picture[i] =
            to_rgb8(in_even_light(texel[i], &light[i], residual, static_cast<LandCoverClass>(id)));
    }
  }
}

// If the source has too little paint of a class, the class of which it has most is used instead:
// that paint replaced it in the copy too.
const SeamSample& SeamModels::sample_of(std::uint16_t source) const {
  const auto& of = sources_->of.at(source >> 8U);
  const SeamSample& own = of.at(source & 0xffU);
  if (!own.picture.empty()) return own;
  const auto texels = [](const SeamSample& sample) {
    return std::count(sample.counts.begin(), sample.counts.end(), std::uint8_t{1});
  };
  return *std::max_element(of.begin(), of.end(), [&](const SeamSample& a, const SeamSample& b) {
    return texels(a) < texels(b);
  });
}

const CliqueModel* SeamModels::find(std::uint16_t one, std::uint16_t other) {
  const auto [position, missing] =
      models_.try_emplace({std::min(one, other), std::max(one, other)});
  if (missing) {
    const SeamSample& first = sample_of(position->first.first);
    const SeamSample& second = sample_of(position->first.second);
    if (!first.picture.empty() && !second.picture.empty())
      position->second = learn_seam(first, second);
  }
  return position->second ? &*position->second : nullptr;
}

SeamPaint synthesize_ground_seams(SeamModels& models, const PaintBeforeSeams& paint, PixelRect tile,
                                  PixelRect window, std::uint64_t seed) {
  SeamPaint with_seam{Grid<std::uint8_t>(tile.width(), tile.height()),
                      Grid<glm::vec3>(tile.width(), tile.height())};
  const Grid<Pair> seams = find_seams(paint);
  const PixelRect inside = moved(tile, -window.x0, -window.y0);
  std::map<Pair, PixelRect> boxes;  // of seams that touch the tile, in the order of their sources
  for (int y = inside.y0; y < inside.y1; ++y)
    for (int x = inside.x0; x < inside.x1; ++x) {
      if (seams(x, y) == no_pair) continue;
      PixelRect& box = boxes.try_emplace(seams(x, y), PixelRect{x, y, x, y}).first->second;
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
             std::max(box.y1, y + 1)};
    }
  for (const auto& [pair, touched] : boxes) {
    const CliqueModel* model = models.find(pair.first, pair.second);
    if (model == nullptr) continue;
    // Whole cells of the sheet, so that both tiles of a continuing seam begin with the same noise.
    PixelRect box = grown(moved(touched, window.x0, window.y0), seam_margin_px);
    const int cells = (1 << model->levels) - 1;
    box = intersection({box.x0 & ~cells, box.y0 & ~cells, box.x1, box.y1}, window);
    const PixelRect part = moved(box, -window.x0, -window.y0);
    Grid<Rgb8> picture(part.width(), part.height());
    SeamZone zone{Grid<std::uint8_t>(part.width(), part.height()),
                  Grid<std::uint8_t>(part.width(), part.height())};
    for (int y = 0; y < part.height(); ++y)
      for (int x = 0; x < part.width(); ++x) {
        const int u = part.x0 + x;
        const int v = part.y0 + y;
        picture(x, y) = to_rgb8(paint.even(u, v));
        const bool hole = seams(u, v) == pair;
        const std::uint16_t source = paint.source(u, v);
        // Pixels of another seam are synthesized there: here they are unknown.
        if (seams(u, v) != no_pair && !hole) continue;
        zone.side(x, y) = source == pair.first ? 1 : source == pair.second ? 2 : 0;
        zone.hole(x, y) = hole ? 1 : 0;
      }
    const Grid<Rgb8> made = synthesize_seam(picture, zone, {box.x0, box.y0}, *model, seed);
    for (int y = touched.y0; y < touched.y1; ++y)
      for (int x = touched.x0; x < touched.x1; ++x) {
        if (seams(x, y) != pair) continue;
        with_seam.made(x - inside.x0, y - inside.y0) = 1;
        with_seam.even(x - inside.x0, y - inside.y0) = to_vec3(made(x - part.x0, y - part.y0));
      }
  }
  return with_seam;
}

}  // namespace belvedere
