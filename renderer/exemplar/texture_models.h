#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/land_cover_class.h"
#include "renderer/exemplar/fitted_ramps.h"
#include "renderer/scene/scene_file.h"
#include "texture/statistical/clique_model.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/synthesis_parameters.h"

namespace belvedere {

// Which ground of its classes a model paints.
enum class ModelLight { any, lit, shaded };

// An [[exemplar]] block that is a texture model (docs/textures.md), or one label of a block that is a composite (NAME.composite).
struct SceneTextureModel {
  std::string name;  // as the scene writes its file, with the class where it is a label
  CliqueModel model;
  std::vector<LandCoverClass> serves;
  bool always = false;  // else only where paintings have too few texels of a class
  ModelLight light = ModelLight::any;
  double light_px = 6.0;
  std::size_t block = 0;  // which [[exemplar]] of the scene
};

// Those of a scene, in its order; optional ones that are missing are left out. Labels of a composite are numbers of classes, as masks of
// paintings have them; each paints its class, or where the block says which it serves, those. Error(usage) for what is no model, or a
// composite of other labels.
std::vector<SceneTextureModel> read_texture_models(const LoadedScene& scene);

// A class that is painted from models, numbers in the order of read_texture_models; the first that serves the class in that light.
struct ModelledClass {
  LandCoverClass id;
  std::size_t lit;     // of ground in the light
  std::size_t shaded;  // and in the shade; the same where a model serves both
  std::string why;     // as a sentence for the user; empty where the picture has nothing of the class
};
// Classes that are painted from models: those of which the exemplars have no texel or, for what `target` shows, too few (pixels_per_texel;
// what falls back to a class counts with it), and those whose model always serves.
std::vector<ModelledClass> choose_modelled(const std::vector<SceneTextureModel>& models, const std::vector<Exemplar>& exemplars,
                                           const Grid<std::uint8_t>& target, const SynthesisParameters& parameters);

// A model's colours from dark to light, for pictures that take the colours of their paintings: its mean, moved along the widest axis of its
// colours as far as its coarsest pixels lie from that.
LabelRamps model_ramps(const CliqueModel& model);
// Those of a class that a model serves: where another has the other light of it, dark ones are the shaded model's, light ones the lit
// one's.
LabelRamps model_ramps(const std::vector<SceneTextureModel>& models, const SceneTextureModel& model, LandCoverClass id);

}  // namespace belvedere
