#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "renderer/image/exr/match_file.h"
#include "renderer/image/image_io.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere::tools {

// A pair of corresponding images, of a picture and of the target.
struct GuidePair {
  std::string name;
  std::string source;
  std::string target;
  double weight = 1.0;
};

// Input of `synthesize`, by file name. The first label and the first guide of a name belong to the
// first picture, the second to the second …; their target is always the same file. If only the
// paintings are used, target names are empty.
struct SynthesisFiles {
  std::vector<std::string> pictures;
  std::vector<std::pair<std::string, std::string>>
      labels;  // masks of pixels that are never copied from, by picture; "-" and missing ones: none
  std::vector<GuidePair> guides;
  std::vector<std::string> exclusions;  // matching of colours of several pictures: "off", "common",
                                        // or to the "first", by label or by "regions"
  std::string harmonize = "off";        // colours of several pictures: "off", "common", or like the
                                        // "first", by label or by "regions"
};

struct SynthesisInputs {
  std::vector<Exemplar> exemplars;
  std::vector<Grid<glm::vec3>> pictures;  // full depth, as in the files or harmonized
  GuideStack target;
  std::vector<std::pair<std::string, double>> weights;
  std::vector<Rgb8> label_colours;  // where labels are drawn in colours: the colour of each number
  std::vector<std::uint8_t> profile;  // colour profile of the first picture
};

// Error(usage) where files do not pair up or sizes disagree, Error(input) for files that cannot be
// read or labels over 255.
SynthesisInputs read_synthesis(const SynthesisFiles& files, Progress& progress = silent_progress());

// Content of a file written by --match.
struct StoredMatches {
  MatchField matches;
  std::vector<MatchedPicture> pictures;  // by number; empty where the file does not state it
};

// Channels exemplar, x and y (uint) of each pixel; exemplar is 65535 where nothing was copied. The
// header names the pictures.
void write_matches(const std::string& path, const MatchField& matches,
                   const std::vector<MatchedPicture>& pictures, const FileNotes& notes);
// Error(input) for a file that is not a match field: another format, channels missing or not uint,
// a texel outside its picture.
StoredMatches read_matches(const std::string& path);

// A label from the command line: Error(usage) unless 0 … 254.
std::uint8_t to_label(const std::string& option, int number);
// 8-bit encoded sRGB, as synthesis compares pictures.
Grid<Rgb8> to_rgb8(const Grid<glm::vec3>& encoded);

}  // namespace belvedere::tools
