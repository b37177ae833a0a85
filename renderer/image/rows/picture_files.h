#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/image/image_file.h"

namespace belvedere {

// How a finished picture is written.
struct PictureColours {
  DisplayParameters display;                 // scene-linear to encoded
  std::vector<std::uint8_t> device_profile;  // ICC, of the printer, RGB or CMYK; empty: none
  DeviceParameters device = {};              // how colours are mapped into it
  double ink_limit_percent = 0.0;  // of CMYK, 1…400; 0: the maximum of the profile's own tables
};

// A scene-linear picture as STEM.EXT for each of the extensions, from one pass over its rows.
// Encoded ones are sRGB and carry its profile, `device` formats the printer's if there is one; in a
// format with a longest side (PNG) larger pictures are reduced by a whole factor, each pixel the
// mean in linear light, the resolution divided by the factor. Memory does not grow with the height,
// and the split into rows changes no byte. Without finish() older files of these names are
// unchanged.
class PictureFiles {
 public:
  // Error(usage) for an unknown extension, before anything is written; Error(limit) for a format
  // that packs pictures whole, over the budget; Error(input) for an invalid colour conversion;
  // Error(output).
  PictureFiles(const std::string& stem, const std::vector<std::string>& extensions, int width,
               int height, const PictureColours& colours, double dots_per_inch,
               const FileNotes& notes);
  ~PictureFiles();
  PictureFiles(const PictureFiles&) = delete;
  PictureFiles& operator=(const PictureFiles&) = delete;

  // The next rows from the top, any number of them.
  void write_rows(const Image& linear);
  // Completes all files and checks what was written; only then the older ones are replaced.
  void finish();
  // Ink coverage of the rows so far, where a file is CMYK.
  std::optional<InkCoverage> ink() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Notes for the log, such as "panorama.png is 6667 × 2667 pixels, the picture reduced by 3": one
// for each reduced format.
std::vector<std::string> reduction_notes(const std::string& name,
                                         const std::vector<std::string>& extensions, int width,
                                         int height);

// "panorama.tif uses up to 312 % of ink, 140 % on average; .4 % of its pixels exceed 300 %"
std::string ink_note(const std::string& file, const InkCoverage& ink);

}  // namespace belvedere
