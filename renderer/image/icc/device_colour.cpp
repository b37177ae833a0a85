#include "renderer/image/icc/device_colour.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <utility>

#include "base/error.h"
#include "renderer/image/icc/lcms.h"

namespace belvedere {
namespace {

struct RgbSpace {
  std::string_view name;
  const char* title;
  cmsCIExyYTRIPLE primaries;
  bool srgb_curve;  // else the power 563/256 of Adobe RGB (1998), 4.3.1.2
};

constexpr cmsCIExyY d65 = {0.3127, 0.3290, 1.0};
constexpr std::array spaces = {
    RgbSpace{"display-p3",
             "Display P3",
             {{0.680, 0.320, 1.0}, {0.265, 0.690, 1.0}, {0.150, 0.060, 1.0}},
             true},
    RgbSpace{"adobe-rgb",
             "compatible with Adobe RGB (1998)",
             {{0.64, 0.33, 1.0}, {0.21, 0.71, 1.0}, {0.15, 0.06, 1.0}},
             false}};

}  // namespace

const std::vector<RenderingIntentName>& rendering_intents() {
  static const std::vector<RenderingIntentName> all = {
      {"perceptual", RenderingIntent::perceptual,
       "all colours shift together, so that steps between them stay"},
      {"relative", RenderingIntent::relative,
       "colours that the device can show stay, others are mapped to the nearest; paper is white"},
      {"saturation", RenderingIntent::saturation, "vivid colours stay vivid"},
      {"absolute", RenderingIntent::absolute,
       "like relative, but with the paper's own colour: for proofs on another printer"}};
  return all;
}

std::vector<std::string> rendering_intent_names() {
  std::vector<std::string> names;
  for (const RenderingIntentName& one : rendering_intents()) names.emplace_back(one.name);
  return names;
}

RenderingIntent rendering_intent(const std::string& name) {
  for (const RenderingIntentName& one : rendering_intents())
    if (one.name == name) return one.intent;
  throw Error(ErrorKind::usage, "rendering intent", fmt::format("\"{}\"", name),
              fmt::format("{}", fmt::join(rendering_intent_names(), ", ")));
}

std::vector<std::uint8_t> srgb_profile() {
  const icc::Context context;
  return icc::save_dated(context, icc::Profile(cmsCreate_sRGBProfileTHR(context)), "sRGB");
}

std::vector<std::string> colour_space_names() {
  std::vector<std::string> names = {"srgb"};
  for (const RgbSpace& space : spaces) names.emplace_back(space.name);
  return names;
}

std::vector<std::uint8_t> colour_space_profile(const std::string& name) {
  if (name == "srgb") return srgb_profile();
  const icc::Context context;
  for (const RgbSpace& space : spaces) {
    if (space.name != name) continue;
    // The pieces of IEC 61966-2-1 as lcms2's curve 4: (a x + b)^g above d, c x below.
    const cmsFloat64Number srgb[5] = {2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045};
    const cmsFloat64Number power[1] = {563.0 / 256.0};
    cmsToneCurve* curve = space.srgb_curve ? cmsBuildParametricToneCurve(context, 4, srgb)
                                           : cmsBuildParametricToneCurve(context, 1, power);
    cmsToneCurve* const curves[3] = {curve, curve, curve};
    icc::Profile profile(cmsCreateRGBProfileTHR(context, &d65, &space.primaries, curves));
    cmsFreeToneCurve(curve);
    return icc::save_dated(context, std::move(profile), space.title);
  }
  throw Error(ErrorKind::usage, "colour space", fmt::format("\"{}\"", name),
              fmt::format("{}", fmt::join(colour_space_names(), ", ")));
}

}  // namespace belvedere
