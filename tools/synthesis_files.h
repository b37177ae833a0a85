#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "renderer/image_io.h"
#include "texture/exemplar.h"
#include "texture/guide_stack.h"
#include "texture/match_field.h"

namespace belvedere::tools {

// A pair of images that say the same thing about a picture and about the target.
struct GuidePair {
  std::string name;
  std::string source;
  std::string target;
  double weight = 1.0;
};

// What `synthesize` works on, by file name. The first label and the first guide of a name belong to the first picture, the second to the
// second …; their target is always the same file.
struct SynthesisFiles {
  std::vector<std::string> pictures;
  std::vector<std::pair<std::string, std::string>> labels;  // of the picture, of the target
  std::vector<GuidePair> guides;
};

struct SynthesisInputs {
  std::vector<Exemplar> exemplars;
  std::vector<Grid<glm::vec3>> pictures;  // full depth, as in the files
  GuideStack target;
  std::vector<std::pair<std::string, double>> weights;
  std::vector<std::uint8_t> profile;  // colour profile of the first picture
};

// Error(usage) where files do not pair up or sizes disagree, Error(input) for files that cannot be read or labels over 255.
SynthesisInputs read_synthesis(const SynthesisFiles& files);

// Channels exemplar, x and y (uint) of each pixel; exemplar is 65535 where nothing was copied.
void write_matches(const std::string& path, const MatchField& matches, const FileNotes& notes);

}  // namespace belvedere::tools
