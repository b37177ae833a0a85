#include "renderer/exemplar/painting_segments.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/land_cover_class.h"
#include "base/parallel.h"
#include "renderer/image/srgb.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

// Sums over pixels, which add up when parts are merged.
struct LookSums {
  glm::dvec3 oklab{0.0};
  double y = 0.0;
  double upper_edge = 0.0;
  double across = 0.0;
  double down = 0.0;
  double pixels = 0.0;
  LookSums& operator+=(const LookSums& other) {
    oklab += other.oklab;
    y += other.y;
    upper_edge += other.upper_edge;
    across += other.across;
    down += other.down;
    pixels += other.pixels;
    return *this;
  }
};

std::vector<LookSums> measure_looks(const Grid<glm::vec3>& oklab, const Superpixels& pieces) {
  std::vector<LookSums> sums(pieces.count);
  for (int y = 0; y < oklab.height(); ++y)
    for (int x = 0; x < oklab.width(); ++x) {
      LookSums& sum = sums[pieces.of(x, y)];
      const double lightness = oklab(x, y).x;
      sum.oklab += oklab(x, y);
      sum.y += (y + 0.5) / oklab.height();
      sum.upper_edge += y == 0 ? 1.0 / oklab.width() : 0.0;
      sum.across += std::abs(static_cast<double>(oklab.clamped(x + 1, y).x) - lightness);
      sum.down += std::abs(static_cast<double>(oklab.clamped(x, y + 1).x) - lightness);
      sum.pixels += 1.0;
    }
  return sums;
}

std::vector<std::uint8_t> infer_nodes(std::vector<LookSums> sums, const JoinTree& tree) {
  for (const auto& [a, b] : tree.joins) {
    LookSums both = sums[a];
    both += sums[b];
    sums.push_back(both);
  }
  const LookSums& whole = sums.back();
  const double usual = std::max((whole.across + whole.down) / whole.pixels, 1e-6);
  std::vector<std::uint8_t> inferred;
  inferred.reserve(sums.size());
  for (const LookSums& sum : sums) {
    PartLook look{sum.oklab / sum.pixels, sum.y / sum.pixels, sum.upper_edge,
                  sum.across / sum.pixels, sum.down / sum.pixels};
    look.rough = (look.across + look.down) / usual;
    inferred.push_back(infer_class(look));
  }
  return inferred;
}

void check_picture(const Grid<glm::vec3>& picture, const Grid<float>& alpha,
                   const std::string& path) {
  if (std::min(picture.width(), picture.height()) < min_segment_side)
    throw Error(ErrorKind::input, path,
                fmt::format("{} × {} pixels", picture.width(), picture.height()),
                fmt::format("at least {} pixels on each side", min_segment_side));
  if (std::all_of(picture.begin(), picture.end(),
                  [&](const glm::vec3& colour) { return colour == picture[0]; }))
    throw Error(ErrorKind::input, path, "the picture has a single colour",
                "a painting with several colours");
  if (!alpha.empty() && std::all_of(alpha.begin(), alpha.end(), [](float a) { return a < 1.F; }))
    throw Error(ErrorKind::input, path, "the picture is fully transparent",
                "a painting with opaque parts");
}

}  // namespace

std::uint8_t infer_class(const PartLook& look) {
  using enum LandCoverClass;
  const double lightness = look.oklab.x;
  const double red = look.oklab.y;     // positive towards red, negative towards green
  const double yellow = look.oklab.z;  // positive towards yellow, negative towards blue
  const double chroma = std::sqrt(red * red + yellow * yellow);
  const bool blue = yellow < -0.012;
  const bool pale = lightness > 0.68 && chroma < 0.05;
  const bool green = red < -0.006 && yellow > 0.0 && chroma > 0.015;
  const bool olive =
      red < 0.0045 && yellow > 0.025 && yellow < 0.05;  // forest and fields under old varnish
  const bool warm = yellow > 0.03 && red > -0.01;
  const bool level = look.down > 1.25 * look.across;
  // Leaves against the sky are as bright as the sky, and the roughest texture of all; a cliff in
  // blue shade is not sky either. A part that covers much of the upper edge may be as rough as the
  // rest.
  const bool smooth = look.rough < (look.upper_edge > 0.25 ? 1.15 : 0.8);
  const auto of = [&] {
    if (look.height < 0.5 && lightness > 0.45 && smooth && (!green || pale) &&
        (blue || pale || look.upper_edge > 0.02))
      return sky;
    if (look.height < 0.65 && lightness > 0.68 && chroma < 0.03 && look.rough < 0.6)
      return sky;  // haze above the horizon
    if (look.height >= (level ? 0.35 : 0.5) && blue && (level || chroma > 0.04)) return water;
    if (look.height > 0.5 && blue && chroma > 0.025 && look.rough < 1.2) return water;
    if (lightness > 0.72 && chroma < 0.035) return snow;
    if (green || olive) return lightness < 0.5 || look.rough > 1.8 ? forest : pasture;
    if (warm && lightness > 0.72) return sand;
    if (warm && chroma > 0.09) return valley_floor;
    if (look.height > 0.5 && smooth && lightness > 0.45 && red > 0.01 && yellow > 0.01)
      return sand;  // wet, or in shade
    if (lightness < 0.28 || (lightness < 0.4 && yellow > 0.01)) return forest;
    return rock;
  };
  return static_cast<std::uint8_t>(of());
}

PaintingSegments segment_painting(const Grid<glm::vec3>& picture, const Grid<float>& alpha,
                                  double theta, const std::string& path) {
  check_picture(picture, alpha, path);
  // In a long and narrow painting the short side must not become too short.
  const int factor = std::min(segment_reduction(picture.width(), picture.height()),
                              std::min(picture.width(), picture.height()) / min_segment_side);
  Grid<glm::vec3> oklab = reduce_blocks(picture, factor);
  parallel_rows(oklab.height(), [&](int y) {
    for (int x = 0; x < oklab.width(); ++x) oklab(x, y) = glm::vec3(to_oklab(oklab(x, y)));
  });
  const Segments segments = find_segments(oklab);
  PaintingSegments out;
  const Partition groups = group_pieces(segments, theta);
  out.groups = std::size_t{*std::max_element(groups.begin(), groups.end())} + 1;
  out.tree = join_pieces(segments.distance, segments.pixels, groups);
  out.inferred = infer_nodes(measure_looks(oklab, segments.pieces), out.tree);
  out.pieces = enlarge_pieces(segments.pieces.of, picture, factor);
  for (std::size_t i = 0; i < alpha.size(); ++i)
    if (alpha[i] < 1.F) out.pieces[i] = no_piece;
  return out;
}

Grid<std::uint8_t> class_mask(const PaintingSegments& segments, const Partition& groups,
                              const std::vector<std::uint8_t>& classes) {
  Grid<std::uint8_t> mask(segments.pieces.width(), segments.pieces.height(), unused_label);
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (segments.pieces[i] != no_piece) mask[i] = classes[groups[segments.pieces[i]]];
  return mask;
}

std::vector<std::uint8_t> inferred_class_of(const PaintingSegments& segments, std::size_t count) {
  const std::vector<std::uint16_t> nodes = cut_nodes(segments.tree, count);
  std::vector<std::uint8_t> out;
  out.reserve(nodes.size());
  for (const std::uint16_t node : nodes) out.push_back(segments.inferred[node]);
  return out;
}

}  // namespace belvedere
