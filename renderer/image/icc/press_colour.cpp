#include "renderer/image/icc/press_colour.h"

#include <algorithm>
#include <glm/common.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/icc/lcms.h"

namespace belvedere {
namespace {

constexpr double steps_a_percent = 65536.0;
constexpr double tolerance_percent = 0.5;

struct RowCount {
  std::uint64_t above = 0;
  std::uint64_t sum = 0;
  double highest_percent = 0.0;
};

}  // namespace

void InkCount::add(const Grid<Inks>& rows) {
  std::vector<RowCount> counts(static_cast<std::size_t>(rows.height()));
  parallel_rows(rows.height(), [&](int y) {
    RowCount& count = counts[static_cast<std::size_t>(y)];
    const Inks* row = rows.row(y);
    for (int x = 0; x < rows.width(); ++x) {
      const double percent =
          100.0 * (static_cast<double>(row[x].x) + row[x].y + row[x].z + row[x].w);
      count.above += percent > coverage_.limit_percent + tolerance_percent ? 1 : 0;
      count.sum += static_cast<std::uint64_t>(std::max(0.0, percent) * steps_a_percent);
      count.highest_percent = std::max(count.highest_percent, percent);
    }
  });
  for (const RowCount& count : counts) {
    coverage_.pixels_above += count.above;
    coverage_.highest_percent = std::max(coverage_.highest_percent, count.highest_percent);
    sum_ += count.sum;
  }
  coverage_.pixels += rows.size();
}

InkCoverage InkCount::coverage() const {
  InkCoverage coverage = coverage_;
  if (coverage.pixels > 0)
    coverage.mean_percent =
        static_cast<double>(sum_) / steps_a_percent / static_cast<double>(coverage.pixels);
  return coverage;
}

namespace {

constexpr const char* press_allowed = "the ICC profile of a printing press, in CMYK";
constexpr const char* device_allowed =
    "the ICC profile of an RGB monitor, printer or colour space, or of a printing press in CMYK";
constexpr const char* source_allowed = "a picture in RGB, with the profile of an RGB space or none";
constexpr DeviceParameters measured = {
    RenderingIntent::relative, false};  // colours unchanged, relative to the device's own white
constexpr float percent = 100.0F;       // lcms2 counts inks in percent

icc::Profile open_press(const icc::Context& context, const std::vector<std::uint8_t>& bytes,
                        const std::string& where) {
  icc::Profile profile = icc::open_profile(context, bytes);
  icc::require_device(where, context, profile, cmsSigCmykData, press_allowed);
  // Proofs and reports need the appearance of inks, so tables in both directions are needed.
  if (cmsIsIntentSupported(profile.get(), INTENT_RELATIVE_COLORIMETRIC, LCMS_USED_AS_INPUT) == 0)
    throw Error(ErrorKind::input, where, "is a profile without a table of the inks' appearance",
                press_allowed);
  return profile;
}

icc::Profile open_source(const icc::Context& context, const std::vector<std::uint8_t>& bytes) {
  icc::Profile profile = icc::open_profile(context, bytes.empty() ? srgb_profile() : bytes);
  icc::require_device("the picture's ICC profile", context, profile, cmsSigRgbData, source_allowed);
  return profile;
}

icc::Profile open_lab(const icc::Context& context) {
  return icc::Profile(cmsCreateLab4ProfileTHR(context, nullptr));
}

bool has_colours(const std::vector<std::uint8_t>& bytes, cmsColorSpaceSignature space) {
  const icc::Context context;
  const icc::Profile profile = icc::open_profile(context, bytes);
  return profile != nullptr && icc::colours_of(profile) == space;
}

template <class From, class To>
void transform_row(const icc::Transform& transform, const From* from, To* to, int width) {
  cmsDoTransform(transform.get(), from, to, static_cast<cmsUInt32Number>(width));
}

template <class To, class From>
Grid<To> transform_rows(const icc::Transform& transform, const Grid<From>& from) {
  Grid<To> out(from.width(), from.height());
  parallel_rows(out.height(),
                [&](int y) { transform_row(transform, from.row(y), out.row(y), out.width()); });
  return out;
}

}  // namespace

std::vector<std::uint8_t> read_press_profile(const std::string& path) {
  std::vector<std::uint8_t> bytes = icc::read_profile_bytes(path);
  const icc::Context context;
  open_press(context, bytes, path);
  return bytes;
}

std::vector<std::uint8_t> read_device_profile(const std::string& path) {
  std::vector<std::uint8_t> bytes = icc::read_profile_bytes(path);
  const icc::Context context;
  if (is_cmyk_profile(bytes))
    open_press(context, bytes, path);
  else
    icc::require_device(path, context, icc::open_profile(context, bytes), cmsSigRgbData,
                        device_allowed);
  return bytes;
}

bool is_cmyk_profile(const std::vector<std::uint8_t>& profile) {
  return has_colours(profile, cmsSigCmykData);
}
bool is_rgb_profile(const std::vector<std::uint8_t>& profile) {
  return has_colours(profile, cmsSigRgbData);
}

std::string profile_name(const std::vector<std::uint8_t>& bytes) {
  const icc::Context context;
  const icc::Profile profile = icc::open_profile(context, bytes);
  char text[256] = {};
  if (profile == nullptr ||
      cmsGetProfileInfoASCII(profile.get(), cmsInfoDescription, "en", "US", text, sizeof text) == 0)
    return {};
  return text;
}

double press_ink_limit_percent(const std::vector<std::uint8_t>& profile) {
  const icc::Context context;
  const icc::Profile press = open_press(context, profile, "ICC profile");
  const double found = cmsDetectTAC(press.get());
  return found > 0.0 ? std::min(found, 400.0) : 400.0;
}

struct PressConversion::State {
  icc::Context context;
  icc::Transform to_inks;
};

PressConversion::PressConversion(const std::vector<std::uint8_t>& press,
                                 const DeviceParameters& parameters,
                                 const std::vector<std::uint8_t>& source)
    : state_(std::make_unique<State>()) {
  const icc::Context& context = state_->context;
  const icc::Profile from = open_source(context, source);
  const icc::Profile to = open_press(context, press, "ICC profile");
  state_->to_inks = icc::make_transform(context, from, TYPE_RGB_FLT, to, TYPE_CMYK_FLT, parameters);
}
PressConversion::~PressConversion() = default;
PressConversion::PressConversion(PressConversion&&) noexcept = default;
PressConversion& PressConversion::operator=(PressConversion&&) noexcept = default;

Grid<Inks> PressConversion::convert(const Grid<glm::vec3>& encoded) const {
  Grid<Inks> out(encoded.width(), encoded.height());
  parallel_rows(out.height(), [&](int y) {
    Inks* row = out.row(y);
    transform_row(state_->to_inks, encoded.row(y), row, out.width());
    for (int x = 0; x < out.width(); ++x) row[x] = glm::clamp(row[x] / percent, 0.0F, 1.0F);
  });
  return out;
}

struct SoftProof::State {
  icc::Context context;
  double outside_delta_e = 0.0;
  icc::Transform to_inks;  // as the picture is printed
  icc::Transform to_lab;   // of the picture
  icc::Transform ink_lab;  // of the print
  icc::Transform nearest;  // inks whose colour is nearest
  icc::Transform show;     // the print on a monitor
};

SoftProof::SoftProof(const std::vector<std::uint8_t>& press, const ProofParameters& parameters,
                     const std::vector<std::uint8_t>& source)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  const icc::Profile rgb = open_source(s.context, source);
  const icc::Profile monitor = open_source(s.context, {});
  const icc::Profile inks = open_press(s.context, press, "ICC profile");
  const icc::Profile lab = open_lab(s.context);
  s.outside_delta_e = parameters.outside_delta_e;
  s.to_inks =
      icc::make_transform(s.context, rgb, TYPE_RGB_FLT, inks, TYPE_CMYK_FLT, parameters.device);
  s.to_lab = icc::make_transform(s.context, rgb, TYPE_RGB_FLT, lab, TYPE_Lab_FLT, measured);
  s.ink_lab = icc::make_transform(s.context, inks, TYPE_CMYK_FLT, lab, TYPE_Lab_FLT, measured);
  s.nearest = icc::make_transform(s.context, lab, TYPE_Lab_FLT, inks, TYPE_CMYK_FLT, measured);
  const DeviceParameters seen = {
      parameters.paper ? RenderingIntent::absolute : RenderingIntent::relative, false};
  s.show = icc::make_transform(s.context, inks, TYPE_CMYK_FLT, monitor, TYPE_RGB_FLT, seen);
}
SoftProof::~SoftProof() = default;

ProofRows SoftProof::make(const Grid<glm::vec3>& encoded) const {
  const State& s = *state_;
  const int width = encoded.width();
  const int height = encoded.height();
  ProofRows out{Grid<glm::vec3>(width, height), Grid<float>(width, height),
                Grid<std::uint8_t>(width, height), Grid<Inks>(width, height)};
  parallel_rows(height, [&](int y) {
    const auto w = static_cast<std::size_t>(width);
    std::vector<glm::vec3> picture(w);
    std::vector<glm::vec3> print(w);
    std::vector<glm::vec3> best(w);
    std::vector<Inks> inks(w);
    Inks* printed = out.inks.row(y);
    transform_row(s.to_lab, encoded.row(y), picture.data(), width);
    transform_row(s.to_inks, encoded.row(y), printed, width);
    for (int x = 0; x < width; ++x) printed[x] = glm::clamp(printed[x], 0.0F, percent);
    transform_row(s.ink_lab, printed, print.data(), width);
    transform_row(s.show, printed, out.shown.row(y), width);
    transform_row(s.nearest, picture.data(), inks.data(), width);
    transform_row(s.ink_lab, inks.data(), best.data(), width);
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(x);
      out.delta_e(x, y) = static_cast<float>(delta_e_2000(picture[i], print[i]));
      out.outside(x, y) = delta_e_2000(picture[i], best[i]) > s.outside_delta_e ? 1 : 0;
      out.shown(x, y) = glm::clamp(out.shown(x, y), 0.0F, 1.0F);
      printed[x] /= percent;
    }
  });
  return out;
}

double delta_e_2000(glm::vec3 lab_a, glm::vec3 lab_b) {
  const cmsCIELab a = {lab_a.x, lab_a.y, lab_a.z};
  const cmsCIELab b = {lab_b.x, lab_b.y, lab_b.z};
  return cmsCIE2000DeltaE(&a, &b, 1.0, 1.0, 1.0);
}

struct InkLook::State {
  icc::Context context;
  icc::Transform to_lab;
};

InkLook::InkLook(const std::vector<std::uint8_t>& press) : state_(std::make_unique<State>()) {
  const icc::Profile inks = open_press(state_->context, press, "ICC profile");
  state_->to_lab = icc::make_transform(state_->context, inks, TYPE_CMYK_FLT,
                                       open_lab(state_->context), TYPE_Lab_FLT, measured);
}
InkLook::~InkLook() = default;

Grid<glm::vec3> InkLook::lab(const Grid<Inks>& inks) const {
  Grid<Inks> hundreds = inks;
  for (Inks& one : hundreds) one *= percent;
  return transform_rows<glm::vec3>(state_->to_lab, hundreds);
}

Grid<glm::vec3> rgb_to_lab(const Grid<glm::vec3>& encoded,
                           const std::vector<std::uint8_t>& profile) {
  const icc::Context context;
  const icc::Profile from = open_source(context, profile);
  return transform_rows<glm::vec3>(
      icc::make_transform(context, from, TYPE_RGB_FLT, open_lab(context), TYPE_Lab_FLT, measured),
      encoded);
}

}  // namespace belvedere
