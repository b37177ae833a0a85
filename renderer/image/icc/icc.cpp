#include <algorithm>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/icc/lcms.h"

namespace belvedere {
namespace {

constexpr const char* rgb_allowed = "the ICC profile of an RGB monitor, printer or colour space";

}  // namespace

struct ProfileConversion::State {
  icc::Context context;
  icc::Transform transform;
};

ProfileConversion::ProfileConversion(const std::vector<std::uint8_t>& profile,
                                     const DeviceParameters& parameters,
                                     const std::vector<std::uint8_t>& source)
    : state_(std::make_unique<State>()) {
  const icc::Context& context = state_->context;
  // The serialized profile instead of lcms2's own in memory: its numbers are rounded as in files,
  // so that sRGB to sRGB changes nothing.
  const icc::Profile from = icc::open_profile(context, source.empty() ? srgb_profile() : source);
  const icc::Profile to = icc::open_profile(context, profile);
  icc::require_device("ICC profile", context, to, cmsSigRgbData, rgb_allowed);
  state_->transform =
      icc::make_transform(context, from, TYPE_RGB_FLT, to, TYPE_RGB_FLT, parameters);
}
ProfileConversion::~ProfileConversion() = default;
ProfileConversion::ProfileConversion(ProfileConversion&&) noexcept = default;
ProfileConversion& ProfileConversion::operator=(ProfileConversion&&) noexcept = default;

Grid<glm::vec3> ProfileConversion::convert(const Grid<glm::vec3>& encoded_srgb) const {
  Grid<glm::vec3> out(encoded_srgb.width(), encoded_srgb.height());
  parallel_rows(out.height(), [&](int y) {
    glm::vec3* row = out.row(y);
    cmsDoTransform(state_->transform.get(), encoded_srgb.row(y), row,
                   static_cast<cmsUInt32Number>(out.width()));
    for (int x = 0; x < out.width(); ++x) {
      for (int c = 0; c < 3; ++c) row[x][c] = std::clamp(row[x][c], 0.0f, 1.0f);
    }
  });
  return out;
}

}  // namespace belvedere
