#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "renderer/image/exr/match_file.h"
#include "renderer/image/image_io.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"
#include "texture/synthesis/match_field.h"

namespace belvedere::tools {

// A pair of images that say the same thing about a picture and about the target.
struct GuidePair {
  std::string name;
  std::string source;
  std::string target;
  double weight = 1.0;
};

// What `synthesize` works on, by file name. The first label and the first guide of a name belong to the first picture, the second to the
// second …; their target is always the same file. Where only the paintings matter, target names are empty.
struct SynthesisFiles {
  std::vector<std::string> pictures;
  std::vector<std::pair<std::string, std::string>> labels;  // of the picture, of the target
  std::vector<GuidePair> guides;
  std::vector<std::string> exclusions;  // masks of what is never copied from, by picture; "-" and missing ones: none
  std::string harmonize = "off";        // colours of several pictures: "off", "common", or like the "first", by label or by "regions"
};

struct SynthesisInputs {
  std::vector<Exemplar> exemplars;
  std::vector<Grid<glm::vec3>> pictures;  // full depth, as in the files or harmonized
  GuideStack target;
  std::vector<std::pair<std::string, double>> weights;
  std::vector<Rgb8> label_colours;    // where labels are drawn in colours: that of each number
  std::vector<std::uint8_t> profile;  // colour profile of the first picture
};

// Error(usage) where files do not pair up or sizes disagree, Error(input) for files that cannot be read or labels over 255.
SynthesisInputs read_synthesis(const SynthesisFiles& files);

// What a file that --match wrote holds.
struct StoredMatches {
  MatchField matches;
  std::vector<MatchedPicture> pictures;  // by number; empty where the file does not say
};

// Channels exemplar, x and y (uint) of each pixel; exemplar is 65535 where nothing was copied. The header says which pictures they are.
void write_matches(const std::string& path, const MatchField& matches, const std::vector<MatchedPicture>& pictures, const FileNotes& notes);
// Error(input) for a file that is no match field: another format, channels missing or not uint, a texel outside of its picture.
StoredMatches read_matches(const std::string& path);

// A label from the command line: Error(usage) unless 0 … 254.
std::uint8_t to_label(const std::string& option, int number);
// 8-bit encoded sRGB, as synthesis compares pictures.
Grid<Rgb8> to_rgb8(const Grid<glm::vec3>& encoded);

}  // namespace belvedere::tools
