#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "renderer/image/color.h"
#include "renderer/image/icc/ink_count.h"
#include "renderer/image/image_file.h"

namespace belvedere {

// How a finished picture is written.
struct PictureColors {
  ColorParameters display;                   // scene-linear to encoded
  std::vector<std::uint8_t> device_profile;  // ICC, of the printer, RGB or CMYK; empty: none
  DeviceParameters device = {};              // how colours come into it
  double ink_limit_percent = 0.0;            // of CMYK, 1…400; 0: what the profile's own tables reach
};

// A scene-linear picture as STEM.ENDING for each of the endings, from one pass over its rows. Encoded ones are sRGB and carry its profile,
// `device` formats the printer's where there is one; a format with a longest side (PNG) gets pictures that are larger reduced by a whole
// factor, each pixel the mean in linear light, its resolution divided by the factor. Memory does not grow with the height,
// and how the rows come changes no byte. Without finish() older files of these names stay as they are.
class PictureFiles {
 public:
  // Error(usage) for an unknown ending, before anything is written; Error(limit) for a format that packs pictures whole, over the budget;
  // Error(input) for colours that cannot be had; Error(output).
  PictureFiles(const std::string& stem, const std::vector<std::string>& endings, int width, int height, const PictureColors& colors,
               double dots_per_inch, const FileNotes& notes);
  ~PictureFiles();
  PictureFiles(const PictureFiles&) = delete;
  PictureFiles& operator=(const PictureFiles&) = delete;

  // The next rows from the top, any number of them.
  void write_rows(const Image& linear);
  // Completes all files and checks what was written; only then the older ones are replaced.
  void finish();
  // Of the rows so far, where a file is CMYK.
  std::optional<InkCoverage> ink() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// What is worth a line in the log, such as "panorama.png is 6667 × 2667 pixels, the picture reduced by 3": one for each reduced format.
std::vector<std::string> reduction_notes(const std::string& name, const std::vector<std::string>& endings, int width, int height);

// "panorama.tif asks for up to 312 % of ink, 140 % on average; .4 % of its pixels for more than 300 %"
std::string ink_note(const std::string& file, const InkCoverage& ink);

}  // namespace belvedere
