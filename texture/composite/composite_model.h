#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "texture/composite/label_map.h"
#include "texture/statistical/clique_model.h"

namespace belvedere {

// A texture of textures (Zalesny et al. 2005): a map of labels, a texture for each label, and one
// for what lies along their borders.
struct CompositeLabel {
  std::string name;  // its key in label pictures: "#0000ff", or a number
  CliqueModel model;
};

struct CompositeModel {
  LabelMapModel map;
  std::vector<CompositeLabel> labels;
  std::optional<CliqueModel> transition;  // none if the crop's borders are too short to learn from

  // Information about the crop, without effect on what is made.
  std::string crop_hash;
};

// A model as a text: TOML with the texture models in tables of their own. It reads back to the same
// bits.
std::string composite_text(const CompositeModel& model);

// Error(usage) with file and line for an invalid composite: keys missing or unknown, another
// version, tables that are cut off, are not shares, or have another number of labels.
// `read_composite` also Error(input) if the file is missing.
CompositeModel parse_composite(const std::string& text, const std::string& name);
CompositeModel read_composite(const std::string& path);

}  // namespace belvedere
