#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/land_cover_class.h"
#include "renderer/exemplar/fitted_ramps.h"
#include "renderer/scene/scene_file.h"
#include "texture/statistical/clique_model.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// The ground that a model paints, within its classes.
enum class ModelLight { any, lit, shaded };

// An [[exemplar]] block that is a texture model (docs/textures.md), or one label of a block that is
// a composite (NAME.composite).
struct SceneTextureModel {
  std::string name;  // its file as written in the scene, with the class where it is a label
  CliqueModel model;
  std::vector<LandCoverClass> serves;
  bool always = false;  // otherwise only where paintings have too few texels of a class
  ModelLight light = ModelLight::any;
  double light_px = 6.0;
  std::size_t block = 0;  // index of the scene's [[exemplar]] block
};

// Reads the texture models of a scene, in order; optional ones that are missing are left out.
// Labels of a composite are class numbers, as in masks of paintings; each paints its class, or only
// the classes that the block serves. Error(usage) for an invalid model, or a composite with other
// labels.
std::vector<SceneTextureModel> read_texture_models(const LoadedScene& scene);

// A class that is painted from models, as indices into read_texture_models; the first that serves
// the class in that light.
struct ModelledClass {
  LandCoverClass id;
  std::size_t lit;     // for lit ground
  std::size_t shaded;  // for shaded ground; the same if one model serves both
  std::string why;     // a sentence for the user; empty if the picture has no pixels of the class
};
// Classes that are painted from models: those of which the exemplars have no texels or, for what
// `target` shows, too few (pixels_per_texel; classes that fall back to a class count with it), and
// those whose model always serves.
std::vector<ModelledClass> choose_modelled(const std::vector<SceneTextureModel>& models,
                                           const std::vector<Exemplar>& exemplars,
                                           const Grid<std::uint8_t>& target,
                                           const SynthesisParameters& parameters);

// A model's colours from dark to light, for pictures that take the colours of their paintings: its
// mean, shifted along the main axis of its colours by the range of its coarsest pixels.
LabelRamps model_ramps(const CliqueModel& model);
// The ramps of a class that a model serves: if another model serves the other light of it, dark
// colours are the shaded model's, light ones the lit one's.
LabelRamps model_ramps(const std::vector<SceneTextureModel>& models, const SceneTextureModel& model,
                       LandCoverClass id);

}  // namespace belvedere
