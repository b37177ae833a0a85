#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/press/page_plan.h"
#include "renderer/press/proof.h"

namespace belvedere {

struct PdfParameters {
  std::vector<std::uint8_t>
      press;  // CMYK profile; empty: the picture stays RGB, with its own profile
  DeviceParameters device = {RenderingIntent::relative, true};
  double ink_limit_percent = 0.0;  // for the report; 0: the profile's limit
  int bits = 8;                    // of a channel, 8 or 16
  double width_mm = 0.0;           // of the picture; 0: by its resolution
  PageParameters pages;
  std::string labels;  // an SVG over the whole picture; empty: none
  std::string title;
};

struct PdfReport {
  std::size_t pages = 0;
  glm::dvec2 picture_mm{0.0};
  InkCoverage ink;  // pixels 0 where there is no press
};

// A picture as PDF. With a press profile it is PDF/X-4 (ISO 15930-7): output intent with the
// profile, the picture in CMYK, page boxes, metadata, no device-dependent colour but its own;
// neutral labels print in black ink alone. Read, converted and packed row by row; memory holds the
// packed picture. Its dates are the picture's, so the same inputs give the same bytes. Error(usage)
// where neither file nor parameters give its width.
PdfReport write_print_pdf(const std::string& path, const PressPicture& picture,
                          const PdfParameters& parameters, Progress& progress);

}  // namespace belvedere
