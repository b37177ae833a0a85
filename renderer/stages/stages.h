#pragma once

#include <memory>
#include <optional>

#include "renderer/graph/stage_graph.h"
#include "renderer/stages/copied_ground.h"
#include "renderer/stages/ground_inputs.h"
#include "renderer/stages/picture_layers.h"
#include "renderer/world/lazy_value.h"
#include "texture/strokes/ice/ice_plan.h"
#include "texture/synthesis/exemplar.h"

// The stages of a sheet, from the first rays to the finished picture. Each is declared once, in
// order: those of the ground in ground_stages.cpp, those of the paint over it in
// picture_stages.cpp.
namespace belvedere {

struct CrestShift;
struct DrawnFeatures;
const DrawnFeatures& no_features();  // renderer/features/drawn_features.h
struct FinishedPaint;
struct MistSight;
struct StyleGround;

// Stages of the ground: everything that needs no exemplar.
struct GroundStages {
  std::shared_ptr<const GroundInputs> inputs = nullptr;
  std::shared_ptr<const LazyValue<IcePlan>> ice =
      nullptr;                               // flow of ice on the sheet, made on first use
  Stage<GuidanceBuffers>* traced = nullptr;  // results of rays
  Stage<GuidanceBuffers>* wide = nullptr;    // the same in larger pixels, one ray each, for wide
                                             // effects; equal to traced where pixels are no larger
  Stage<GuidanceBuffers>* far = nullptr;     // the same for rock, with the widest reach
  Stage<Grid<glm::vec2>>* fall =
      nullptr;  // smoothed fall lines of `far`; null: it is thinned first
  Stage<CrestShift>* crests = nullptr;
  Stage<RockRelief>* relief = nullptr;
  Stage<GuidanceBuffers>* crested = nullptr;  // traced channels after the crest shift
  Stage<GuidanceBuffers>* raised = nullptr;   // `crested` with the relief of rock
  Stage<GuidanceBuffers>* lit = nullptr;      // `raised` with tone
  Stage<Grid<float>>* tone = nullptr;
  Stage<BasePicture>* base = nullptr;
  Stage<PaintDraft>* draft = nullptr;
  Stage<GuideStack>* guides = nullptr;         // guides of synthesis
  Stage<GuidanceBuffers>* guidance = nullptr;  // everything in guidance.exr
};
// tile_px: side of the tiles that are made at once, 64…4096; does not change the result.
GroundStages add_ground_stages(StageGraph& graph, GroundInputs inputs, int tile_px);

// A finished picture, and its layers if requested.
struct SheetPicture {
  Grid<glm::vec3> colour;               // encoded sRGB
  std::optional<PictureLayers> layers;  // present if requested
};
struct PictureStages {
  Stage<MatchField>* matches = nullptr;   // null: nothing is copied
  Stage<ModelPaint>* modelled = nullptr;  // null: no class is painted from a texture model
  Stage<SeamPaint>* with_seam = nullptr;  // null: seams stay as copied
  Stage<Grid<glm::vec3>>* copied = nullptr;
  Stage<MistSight>* mist_sight = nullptr;  // null: no mist
  Stage<MistPaint>* mist_paint = nullptr;
  Stage<FinishedPaint>* finished = nullptr;
  Stage<Grid<glm::vec3>>* below_style = nullptr;  // null: the picture is in no painter's style
  Stage<StyleGround>* style_ground = nullptr;
  Stage<Grid<glm::vec3>>* styled = nullptr;  // encoded sRGB
  Stage<SheetPicture>* picture = nullptr;
};
// plan: null: everything is painted as strokes. Arguments must outlive the graph.
PictureStages add_picture_stages(StageGraph& graph, const GroundStages& ground, CopyPlan* plan,
                                 const DrawnFeatures& features = no_features());
// Requested from PictureStages::picture.
SheetPicture with_layers(int width, int height);

}  // namespace belvedere
