#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "renderer/graph/stage_graph.h"
#include "renderer/stages/copied_ground.h"
#include "renderer/stages/ground_inputs.h"
#include "renderer/stages/picture_layers.h"
#include "renderer/world/lazy_value.h"
#include "texture/strokes/ice_plan.h"
#include "texture/synthesis/guide_stack.h"

// The stages of a sheet, from the first rays to the finished picture. Each is declared once, in stages.cpp: that file is the story of how a
// panorama is made.
namespace belvedere {

struct CrestShift;
struct DrawnFeatures;
const DrawnFeatures& no_features();  // renderer/features/drawn_features.h
struct FinishedPaint;
struct MistSight;

// Everything that needs no exemplar.
struct GroundStages {
  std::shared_ptr<const GroundInputs> inputs = nullptr;
  std::shared_ptr<const LazyValue<IcePlan>> ice = nullptr;  // how ice runs on the sheet, made when a stage first asks for it
  Stage<GuidanceBuffers>* traced = nullptr;                 // what rays find
  Stage<GuidanceBuffers>* wide = nullptr;  // the same in larger pixels, a ray each, for what reaches far; traced where they are no larger
  Stage<GuidanceBuffers>* far = nullptr;   // and for rock, which looks farthest
  Stage<CrestShift>* crests = nullptr;
  Stage<RockRelief>* relief = nullptr;
  Stage<GuidanceBuffers>* crested = nullptr;  // traced channels, crests of rock in place
  Stage<GuidanceBuffers>* raised = nullptr;   // and its relief
  Stage<GuidanceBuffers>* lit = nullptr;      // and tone
  Stage<Grid<float>>* tone = nullptr;
  Stage<BasePicture>* base = nullptr;
  Stage<PaintDraft>* draft = nullptr;
  Stage<GuideStack>* guides = nullptr;         // what synthesis is steered by
  Stage<GuidanceBuffers>* guidance = nullptr;  // all that guidance.exr holds
};
// tile_px: side of the tiles that are made at once, 64…4096; changes no bit.
GroundStages add_ground_stages(StageGraph& graph, GroundInputs inputs, int tile_px);

// A finished picture, and its layers where they are asked for.
struct SheetPicture {
  Grid<glm::vec3> colour;               // encoded sRGB
  std::optional<PictureLayers> layers;  // asked for: there is one
};
struct PictureStages {
  Stage<MatchField>* matches = nullptr;   // null: nothing is copied
  Stage<ModelPaint>* modelled = nullptr;  // null: no class is painted from a texture model
  Stage<KnitPaint>* knitted = nullptr;    // null: seams stay as they are copied
  Stage<Grid<glm::vec3>>* copied = nullptr;
  Stage<MistSight>* mist_sight = nullptr;  // null: there is none
  Stage<MistPaint>* mist_paint = nullptr;
  Stage<FinishedPaint>* finished = nullptr;
  Stage<SheetPicture>* picture = nullptr;
};
// plan: null: everything is painted as strokes. Arguments must outlive the graph.
PictureStages add_picture_stages(StageGraph& graph, const GroundStages& ground, CopyPlan* plan,
                                 const DrawnFeatures& features = no_features());
// To be asked of PictureStages::picture.
SheetPicture with_layers(int width, int height);

}  // namespace belvedere
