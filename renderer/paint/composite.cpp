#include "renderer/paint/composite.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/srgb.h"

namespace belvedere {
namespace {

template <class Curve>
Grid<glm::vec3> map_channels(const Grid<glm::vec3>& picture, Curve curve) {
  Grid<glm::vec3> out(picture.width(), picture.height());
  parallel_rows(picture.height(), [&](int y) {
    const glm::vec3* from = picture.row(y);
    glm::vec3* to = out.row(y);
    for (int x = 0; x < picture.width(); ++x) {
      for (int c = 0; c < 3; ++c) to[x][c] = curve(from[x][c]);
    }
  });
  return out;
}

glm::dvec3 decode(glm::vec3 v) { return {srgb_decoded(v.x), srgb_decoded(v.y), srgb_decoded(v.z)}; }
glm::vec3 encode(glm::dvec3 v) {
  return glm::vec3(srgb_encoded(v.x), srgb_encoded(v.y), srgb_encoded(v.z));
}

// Whether two pixels show different surfaces. The comparison is false for sky against sky
// (infinity) and true for sky against ground.
bool differ(float depth_a, float depth_b) {
  constexpr float ratio = 1.03f;
  return depth_a > ratio * depth_b || depth_b > ratio * depth_a;
}

// Each channel of d, softly limited to ±max.
glm::vec3 softly(glm::vec3 d, float max) {
  const glm::vec3 x = d / max;
  return d / glm::sqrt(1.0F + x * x);
}

// A texel of another position as paint of this one (transfer_residual). Its base is null where it
// is unknown.
glm::vec3 carried_over(glm::vec3 texel, const glm::vec3* its_base, glm::vec3 base,
                       const Residual& residual, LandCoverClass shown) {
  if (its_base == nullptr) return texel;
  if (has_trait(shown, ClassTrait::icy)) return base + softly(texel - *its_base, snow_strokes_max);
  return texel +
         (shown == LandCoverClass::rock ? Residual(rock_residual) : residual).of(base - *its_base);
}

glm::vec3 below_air(glm::vec3 paint, glm::vec3 base, const Grid<float>& haze, std::size_t i) {
  if (!haze.empty()) paint = glm::mix(paint, base, std::clamp(haze[i], 0.0F, 1.0F));
  return glm::clamp(paint, 0.0F, 1.0F);
}

}  // namespace

Image decode_srgb(const Grid<glm::vec3>& encoded) {
  return map_channels(encoded, srgb_decoded_fast);
}
Grid<glm::vec3> encode_srgb(const Image& linear) {
  return map_channels(linear, [](float value) {
    return static_cast<float>(srgb_encoded(static_cast<double>(value)));
  });
}

Grid<glm::vec3> transfer_residual(const MatchField& matches,
                                  const std::vector<PaintedExemplar>& exemplars,
                                  const Grid<glm::vec3>& target_base,
                                  const Grid<float>& target_haze, const Residual& residual,
                                  const Grid<LandCoverClass>& shown) {
  if (!matches.same_size(target_base))
    throw Error(ErrorKind::bug, "composite", "the match field and the base have different sizes");
  if (!target_haze.empty() && !target_haze.same_size(target_base))
    throw Error(ErrorKind::bug, "composite", "haze and base have different sizes");
  for (const PaintedExemplar& e : exemplars) {
    if (!e.base.empty() && !e.base.same_size(e.picture)) {
      throw Error(ErrorKind::input, "exemplar " + e.exemplar.name,
                  "its base and its picture have different sizes");
    }
  }
  if (!shown.empty() && !shown.same_size(target_base))
    throw Error(ErrorKind::bug, "composite", "classes and base have different sizes");
  Grid<glm::vec3> out(target_base.width(), target_base.height());
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      const Match m = matches(x, y);
      if (m.exemplar == Match::none) {
        out(x, y) = target_base(x, y);
        continue;
      }
      if (m.exemplar >= exemplars.size() || !exemplars[m.exemplar].picture.contains(m.x, m.y)) {
        throw Error(ErrorKind::input, "match field", "a match points outside the exemplars");
      }
      const PaintedExemplar& e = exemplars[m.exemplar];
      const glm::vec3* its_base = e.base.empty() ? nullptr : &e.base(m.x, m.y);
      const LandCoverClass id = shown.empty() ? LandCoverClass::sky : shown(x, y);
      const glm::vec3 paint =
          carried_over(e.picture(m.x, m.y), its_base, target_base(x, y), residual, id);
      out(x, y) = below_air(paint, target_base(x, y), target_haze, out.index(x, y));
    }
  });
  return out;
}

void lay_model_paint(Grid<glm::vec3>& picture, const ModelPaint& paint,
                     const Grid<glm::vec3>& target_base, const Grid<float>& target_haze,
                     const Residual& residual, const Grid<LandCoverClass>& shown) {
  if (!picture.same_size(paint.made) || !picture.same_size(target_base) ||
      !picture.same_size(shown))
    throw Error(ErrorKind::bug, "composite",
                "the picture and the model paint have different sizes");
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      const std::size_t i = picture.index(x, y);
      if (paint.made[i] == 0) continue;
      picture[i] = below_air(
          carried_over(paint.texel[i], &paint.base[i], target_base[i], residual, shown[i]),
          target_base[i], target_haze, i);
    }
  });
}

glm::vec3 in_even_light(glm::vec3 texel, const glm::vec3* its_base, const Residual& residual,
                        LandCoverClass shown) {
  return carried_over(texel, its_base, glm::vec3(even_grey), residual, shown);
}

void lay_even_paint(Grid<glm::vec3>& picture, const SeamPaint& paint,
                    const Grid<glm::vec3>& target_base, const Grid<float>& target_haze,
                    const Residual& residual, const Grid<LandCoverClass>& shown) {
  if (!picture.same_size(paint.made) || !picture.same_size(target_base) ||
      !picture.same_size(shown))
    throw Error(ErrorKind::bug, "composite", "the picture and the seam paint have different sizes");
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      const std::size_t i = picture.index(x, y);
      if (paint.made[i] == 0) continue;
      // As in carried_over: in even light snow's strokes are already limited.
      const bool whole = has_trait(shown[i], ClassTrait::icy) || shown[i] == LandCoverClass::rock;
      const Residual share = whole ? Residual(rock_residual) : residual;
      picture[i] = below_air(paint.even[i] + share.of(target_base[i] - even_grey), target_base[i],
                             target_haze, i);
    }
  });
}

Grid<glm::vec3> mix_borders(const Grid<glm::vec3>& copied, const Painting& draft,
                            const Grid<LandCoverClass>& shown,
                            const Grid<LandCoverClass>& land_cover, const Grid<glm::vec3>& base) {
  if (!copied.same_size(draft.under) || !copied.same_size(draft.under_share) ||
      !copied.same_size(shown) || !copied.same_size(land_cover) || !copied.same_size(base))
    throw Error(ErrorKind::bug, "composite", "the picture and its draft have different sizes");
  Grid<glm::vec3> out = copied;
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      const std::size_t i = out.index(x, y);
      if (draft.under_share[i] == 0) continue;
      const std::size_t from = draft.under[i];
      const float share = static_cast<float>(draft.under_share[i]) / 255.0F;
      out[i] =
          glm::mix(copied[i], shown[from] == land_cover[from] ? copied[from] : base[from], share);
    }
  });
  return out;
}

Grid<glm::vec3> blend_edges(const Grid<glm::vec3>& picture, const GuidanceBuffers& guidance) {
  require_channels(guidance, {&GuidanceBuffers::depth_m, &GuidanceBuffers::front}, "edges");
  if (!picture.same_size(guidance.depth_m)) {
    throw Error(ErrorKind::bug, "composite", "the picture and its guidance have different sizes");
  }
  Grid<glm::vec3> out = picture;
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float front = guidance.front(x, y);
      if (!(front < 1.0f)) continue;
      const float depth = guidance.depth_m(x, y);
      glm::dvec3 sum(0.0);
      int count = 0;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, picture.height() - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, picture.width() - 1); ++u) {
          if (!differ(depth, guidance.depth_m(u, v))) continue;
          sum += decode(picture(u, v));
          ++count;
        }
      }
      if (count == 0) continue;
      const double own = std::max(static_cast<double>(front), 0.0);
      out(x, y) = encode(own * decode(picture(x, y)) + (1.0 - own) / count * sum);
    }
  });
  return out;
}

}  // namespace belvedere
