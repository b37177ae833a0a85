// The one file that uses OpenColorIO.
#include "renderer/image/display_conversion.h"
#include "base/text/missing_file.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/srgb.h"

namespace belvedere {
namespace {

namespace ocio = OCIO_NAMESPACE;

constexpr const char* own_name = "own";

// The value of a half from its bits. Subnormal and normal numbers; infinities and NaN become
// ±65504, so that the table stays finite.
float half_value(std::uint32_t bits) {
  const std::uint32_t exponent = std::min(bits >> 10 & 31u, 30u);
  const std::uint32_t mantissa = (bits >> 10 & 31u) == 31u ? 1023u : bits & 1023u;
  const float magnitude = exponent == 0 ? static_cast<float>(mantissa) * 0x1p-24f
                                        : static_cast<float>(mantissa + 1024u) *
                                              std::bit_cast<float>((exponent + 102u) << 23);
  return (bits & 0x8000u) != 0 ? -magnitude : magnitude;
}

// A curve as a table over all halves with linear interpolation. OCIO's own formula for sRGB
// (ExponentWithLinear) joins its two pieces at another point than IEC 61966-2-1 and is up to 1e-5
// off, most of a 16-bit step; the table is off by 1e-7 at most, at any brightness.
ocio::Lut1DTransformRcPtr make_curve(const std::function<double(double)>& curve) {
  auto table = ocio::Lut1DTransform::Create(65536, true);
  for (std::uint32_t bits = 0; bits < 65536; ++bits) {
    const auto v = static_cast<float>(curve(half_value(bits)));
    table->setValue(bits, v, v, v);
  }
  return table;
}

ocio::ColorSpaceRcPtr make_space(const char* name, const char* encoding, const char* description) {
  ocio::ColorSpaceRcPtr space = ocio::ColorSpace::Create();
  space->setName(name);
  space->setEncoding(encoding);
  space->setDescription(description);
  space->setBitDepth(ocio::BIT_DEPTH_F32);
  return space;
}

ocio::BuiltinTransformRcPtr make_builtin(const char* style, ocio::TransformDirection direction) {
  auto transform = ocio::BuiltinTransform::Create();
  transform->setStyle(style);
  transform->setDirection(direction);
  return transform;
}

ocio::ConstConfigRcPtr make_own_config() {
  const ocio::ConfigRcPtr config = ocio::Config::Create();
  config->setMajorVersion(2);
  config->setMinorVersion(1);
  config->setName("belvedere");
  config->addColorSpace(
      make_space("lin_srgb", "scene-linear",
                 "Linear light with the primaries of sRGB, white D65; 1 is diffuse white."));

  const auto srgb = make_space("srgb", "sdr-video", "sRGB as in IEC 61966-2-1.");
  srgb->setTransform(make_curve(srgb_decoded), ocio::COLORSPACE_DIR_TO_REFERENCE);
  srgb->setTransform(make_curve(srgb_encoded), ocio::COLORSPACE_DIR_FROM_REFERENCE);
  config->addColorSpace(srgb);

  const auto ap1_to_srgb =
      make_builtin("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", ocio::TRANSFORM_DIR_FORWARD);
  const auto acescg =
      make_space("acescg", "scene-linear", "ACEScg: linear light with the primaries AP1.");
  acescg->setTransform(ap1_to_srgb, ocio::COLORSPACE_DIR_TO_REFERENCE);
  config->addColorSpace(acescg);

  const auto aces =
      make_space("aces", "scene-linear", "ACES2065-1: linear light with the primaries AP0.");
  const auto ap0_to_srgb = ocio::GroupTransform::Create();
  ap0_to_srgb->appendTransform(make_builtin("ACEScg_to_ACES2065-1", ocio::TRANSFORM_DIR_INVERSE));
  ap0_to_srgb->appendTransform(ap1_to_srgb);
  aces->setTransform(ap0_to_srgb, ocio::COLORSPACE_DIR_TO_REFERENCE);
  config->addColorSpace(aces);

  config->addDisplayView("sRGB", "plain", "srgb", "");
  config->setRole(ocio::ROLE_SCENE_LINEAR, "lin_srgb");
  config->setRole(ocio::ROLE_DEFAULT, "lin_srgb");
  return config;
}

std::string config_name(const DisplayParameters& parameters) {
  if (!parameters.config.empty()) return parameters.config;
  const char* variable = std::getenv("OCIO");
  return variable != nullptr && *variable != '\0' ? variable : own_name;
}

ocio::ConstConfigRcPtr read_config_file(const std::string& name) {
  if (name == own_name) {
    static const ocio::ConstConfigRcPtr own = make_own_config();
    return own;
  }
  if (!std::filesystem::is_regular_file(name)) {
    throw missing_file(name, "an OpenColorIO config (.ocio), named by the scene or by $OCIO");
  }
  return ocio::Config::CreateFromFile(name.c_str());
}

std::string list_spaces(const ocio::Config& config) {
  std::string list;
  for (int i = 0; i < config.getNumColorSpaces(); ++i)
    list += (i > 0 ? ", " : "") + std::string(config.getColorSpaceNameByIndex(i));
  return list;
}

void require_space(const ocio::Config& config, const std::string& config_file,
                   const std::string& name) {
  if (config.getColorSpace(name.c_str()) == nullptr) {
    throw Error(ErrorKind::input, config_file, "has no colour space \"" + name + "\"",
                list_spaces(config));
  }
}

// From the working space to the display, or back.
ocio::ConstCPUProcessorRcPtr make_processor(const DisplayParameters& parameters) {
  ocio::SetLoggingLevel(ocio::LOGGING_LEVEL_NONE);  // errors are thrown; nothing is printed
  const std::string name = config_name(parameters);
  try {
    const ocio::ConstConfigRcPtr config = read_config_file(name);
    require_space(*config, name, parameters.working);
    const std::size_t slash = parameters.display.find('/');
    ocio::ConstProcessorRcPtr processor;
    if (config->getColorSpace(parameters.display.c_str()) == nullptr &&
        slash != std::string::npos) {
      const auto view = ocio::DisplayViewTransform::Create();
      view->setSrc(parameters.working.c_str());
      view->setDisplay(parameters.display.substr(0, slash).c_str());
      view->setView(parameters.display.substr(slash + 1).c_str());
      processor = config->getProcessor(view, ocio::TRANSFORM_DIR_FORWARD);
    } else {
      require_space(*config, name, parameters.display);
      processor = config->getProcessor(parameters.working.c_str(), parameters.display.c_str());
    }
    // Lossless: no fast powers, no merging of steps that would change digits.
    return processor->getOptimizedCPUProcessor(ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32,
                                               ocio::OPTIMIZATION_LOSSLESS);
  } catch (const ocio::Exception& e) {
    throw Error(ErrorKind::input, name,
                std::string("this OpenColorIO config cannot be used: ") + e.what());
  }
}

Grid<glm::vec3> run(Grid<glm::vec3> picture, const ocio::ConstCPUProcessorRcPtr& processor) {
  // Pixels are independent, so bands of any height give the same.
  constexpr int band_rows = 16;
  parallel_rows((picture.height() + band_rows - 1) / band_rows, [&](int band) {
    const int y0 = band * band_rows;
    ocio::PackedImageDesc rows(picture.row(y0), picture.width(),
                               std::min(band_rows, picture.height() - y0), 3);
    processor->apply(rows);
  });
  return picture;
}

}  // namespace

struct DisplayConversion::State {
  ocio::ConstCPUProcessorRcPtr processor;
};

DisplayConversion::DisplayConversion(const DisplayParameters& parameters)
    : state_(std::make_unique<State>(State{make_processor(parameters)})) {}
DisplayConversion::~DisplayConversion() = default;
DisplayConversion::DisplayConversion(DisplayConversion&&) noexcept = default;
DisplayConversion& DisplayConversion::operator=(DisplayConversion&&) noexcept = default;
Grid<glm::vec3> DisplayConversion::convert(Image linear) const {
  return run(std::move(linear), state_->processor);
}

Grid<glm::vec3> to_display(const Image& linear, const DisplayParameters& parameters) {
  return DisplayConversion(parameters).convert(linear);
}

}  // namespace belvedere
