#include "renderer/pipeline/copy_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/math.h"
#include "base/progress.h"
#include "base/random.h"
#include "renderer/exemplar/example_sheet.h"
#include "renderer/exemplar/exemplars.h"
#include "renderer/exemplar/scan.h"
#include "renderer/exemplar/texture_models.h"
#include "renderer/ground/cached_products.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/scene/scene_rules.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/trace/camera.h"
#include "texture/quality/exemplar_survey.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/match_cost.h"

namespace belvedere {
namespace {

constexpr const char* plan_name = "plan";

void note_scarcity(const std::vector<Exemplar>& exemplars, const GuideStack& guides,
                   const SynthesisParameters& parameters, Progress& progress) {
  const std::string scarcity = describe_scarcity(
      class_texels(exemplars, guides.label, parameters.fallback), [](std::uint8_t label) {
        return std::string(class_name(static_cast<LandCoverClass>(label)));
      });
  if (!scarcity.empty()) progress.note(scarcity);
}

// Which classes are painted from models, two bytes each, in light and in shade, appended to the
// plan if a scene names models.
void add_models(std::string& packed, const GroundModels& models) {
  for (const GroundModels::OfClass* of_class : {&models.lit, &models.shaded})
    for (const std::uint8_t model : *of_class) packed += static_cast<char>(model);
}
void take_models(std::string& packed, GroundModels& models, std::size_t count) {
  const std::size_t bytes = models.lit.size() + models.shaded.size();
  if (packed.size() < bytes)
    throw Error(ErrorKind::input, "plan", "it is truncated", "the plan as it was written");
  std::size_t at = packed.size() - bytes;
  for (GroundModels::OfClass* of_class : {&models.lit, &models.shaded})
    for (std::uint8_t& of : *of_class) {
      of = static_cast<std::uint8_t>(packed[at++]);
      if (of != GroundModels::none && of >= count)
        throw Error(ErrorKind::input, "plan", "a model that the scene lacks", "this scene's plan");
    }
  packed.resize(packed.size() - bytes);
}

// Sampling windows of the models that are used.
void make_records(GroundModels& models, std::vector<SceneTextureModel> read, std::uint64_t seed,
                  Progress& progress) {
  if (!models.any()) return;
  progress.begin("preparing texture models", static_cast<double>(read.size()));
  for (std::size_t i = 0; i < read.size(); ++i) {
    GroundModel& of = models.models.emplace_back();
    of.model = std::move(read[i].model);
    of.light_px = read[i].light_px;
    of.seed = stream_seed(seed, Stream::statistical_noise, 1000 + i);
    if (models.uses(i)) of.record = record_texture(of.model, {.seed = of.seed});
    progress.advance(1.0);
  }
}

bool any_painting(const std::vector<Exemplar>& exemplars) {
  return std::any_of(exemplars.begin(), exemplars.end(),
                     [](const Exemplar& e) { return e.name != example_sheet_name; });
}

// Input of the seam models, if the scene synthesizes seams.
void add_seam_sources(CopyPlan& plan, const Scene& scene) {
  if (!scene.synthesis.synthesize_seams) return;
  plan.seams = find_seam_sources(plan.exemplars, plan.residual,
                                 stream_seed(scene.seed, Stream::statistical_noise, 2000));
}

// The plan holds what synthesis compares; the pictures are still needed for copying.
void forget_compared(std::vector<PaintedExemplar>& exemplars) {
  for (PaintedExemplar& painted : exemplars) {
    painted.exemplar.picture = {};
    painted.exemplar.guides = {};
  }
}

}  // namespace

SynthesisParameters to_synthesis_parameters(const Scene& scene) {
  SynthesisParameters parameters = scene.synthesis.search;
  parameters.seed = scene.seed;
  if (scene.synthesis.neighbourhood)
    parameters.neighbourhood = static_cast<int>(*scene.synthesis.neighbourhood);
  // Weights for single guides leave the defaults of the others.
  parameters.weights = SceneSynthesis{}.weights;
  for (const auto& given : scene.synthesis.weights) {
    const auto known =
        std::find_if(parameters.weights.begin(), parameters.weights.end(),
                     [&](const auto& weight) { return weight.first == given.first; });
    if (known != parameters.weights.end())
      known->second = given.second;
    else
      parameters.weights.push_back(given);
  }
  for (const auto& [from, to] : with_stand_ins(scene.synthesis.fallback))
    parameters.fallback[static_cast<std::uint8_t>(from)] = static_cast<std::uint8_t>(to);
  for (const auto& [pair, value] : scene.synthesis.class_dissimilarity)
    if (const auto classes = find_class_pair(pair))
      parameters.class_dissimilarity[{static_cast<std::uint8_t>(classes->first),
                                      static_cast<std::uint8_t>(classes->second)}] = value;
  return parameters;
}

SynthesisParameters fit_to_paintings(const Scene& scene, const std::vector<Exemplar>& exemplars,
                                     Progress& progress) {
  // A guide that explains this share of the paint, or more, costs a random texel of the class this
  // price, about that of a patch that does not fit. On the made painting of GuidesAtWork, with all
  // guides, the rank correlation of distances is .93, and .89 of shaded ground is from shaded
  // paint. Of shadow half a difference does not exist, so it needs more.
  constexpr double full_share = 0.1;
  constexpr double full_price = 70000.0;
  constexpr double full_shadow_price = 160000.0;
  constexpr double min_share = 0.02;        // for a guide that is off by default
  constexpr std::ptrdiff_t max_guides = 8;  // more are priced one by one, at twice the time
  SynthesisParameters parameters = to_synthesis_parameters(scene);
  if (!any_painting(exemplars)) return parameters;
  std::vector<GuideShare> shares = explain_paint(exemplars);
  std::stable_sort(shares.begin(), shares.end(), [](const GuideShare& a, const GuideShare& b) {
    return a.explained > b.explained;
  });
  const bool weights_given = scene.synthesis.weights != default_guide_weights();
  std::string found;
  for (const GuideShare& share : shares) {
    const auto named = [&](const auto& weight) { return weight.first == share.name; };
    const auto& given = scene.synthesis.weights;
    const auto own = std::find_if(parameters.weights.begin(), parameters.weights.end(), named);
    if (own == parameters.weights.end() || !(share.difference > 0.0) ||
        (weights_given && std::any_of(given.begin(), given.end(), named)))
      continue;
    const bool off = own->second == 0.0;
    if (off &&
        (share.explained < min_share ||
         std::count_if(parameters.weights.begin(), parameters.weights.end(),
                       [](const auto& weight) { return weight.second > 0.0; }) >= max_guides))
      continue;
    const double price = (share.name == "shadow" ? full_shadow_price : full_price) *
                         std::min(1.0, share.explained / full_share);
    own->second =
        std::max(own->second,
                 std::min(1.0, price / static_cast<double>(guide_cost(1, 1.0)) / share.difference));
    found += fmt::format("{}{} {:.3f} ({:.0f} %)", found.empty() ? "" : ", ", share.name,
                         own->second, 100.0 * share.explained);
  }
  if (!found.empty())
    progress.note("weights of guides, by the share of the paint's variance they explain: " + found);
  const double stroke_px = scene.synthesis.neighbourhood ? 0.0 : mean_stroke_px(exemplars);
  if (stroke_px > 0.0) {  // a stroke and a pixel beside it; sides over 9 are for those who ask
    parameters.neighbourhood = std::clamp(2 * static_cast<int>((stroke_px + 1.0) / 2.0) + 1, 5, 9);
    progress.note(fmt::format("patches of {} pixels: strokes are {:.1f} pixels long",
                              parameters.neighbourhood, stroke_px));
  }
  return parameters;
}

// Strokes are sized for the paper. Where they have very many pixels, each view of the largest
// example sheet is only a few strokes wide, and large parts of a print are copied from the same
// ones.
std::string fine_print_note(const Scene& scene) {
  constexpr double finest_dpi = 600.0;
  const double dpi = scene.output.width / scene.output.sheet_width_mm * 25.4;
  const bool on_paintings =
      std::any_of(scene.exemplars.begin(), scene.exemplars.end(),
                  [](const SceneExemplar& exemplar) { return !exemplar.picture.empty(); });
  if (dpi <= finest_dpi || on_paintings) return {};
  return fmt::format(
      "{:.0f} dpi are more than people see, and copied texture becomes poor: 300 to 450 dpi, with "
      "a larger output.sheet_width_mm or a smaller output.width, look better",
      dpi);
}

glm::vec3 water_shift(const Palette& palette, const std::vector<ScannedPainting>& scans) {
  constexpr double altitude_m = 1500.0;  // for palettes that change with it
  const auto known = [&](LandCoverClass id) {
    return std::any_of(scans.begin(), scans.end(), [&](const ScannedPainting& scan) {
      return !scan.ramps[static_cast<std::size_t>(id)].ramps.empty();
    });
  };
  const Palette taken = take_colours(palette, scans, {});
  const auto shift_of = [&](LandCoverClass id) {
    glm::vec3 sum(0.F);
    for (const double tone : ramp_tones)
      sum += palette_colour(taken, id, altitude_m, tone) -
             palette_colour(palette, id, altitude_m, tone);
    return sum / static_cast<float>(ramp_tones.size());
  };
  glm::vec3 around(0.F);
  float count = 0.F;
  for (const LandCoverClass id :
       {LandCoverClass::valley_floor, LandCoverClass::pasture, LandCoverClass::forest})
    if (known(id)) around += shift_of(id), ++count;
  return known(LandCoverClass::water) || count == 0.F ? shift_of(LandCoverClass::water)
                                                      : around / count;
}

CopyPlan make_copy_plan(const LoadedScene& loaded, const World& world, ScenePaint& paint,
                        const GroundStages& ground, TileStore::Place& scratch,
                        const WorkFolder& work, const Run& run, bool ground_tells) {
  CopyPlan plan;
  if (const std::string note = fine_print_note(world.scene); !note.empty()) run.progress.note(note);
  // A palette of the paintings has shifted it already.
  if (world.scene.synthesis.colours != "painting")
    plan.water_shift = water_shift(paint.palette, paint.paintings);
  plan.exemplars = make_exemplars(loaded, world.view, paint.palette, std::move(paint.paintings),
                                  run.progress, run.cache);
  std::vector<Exemplar> copied_from;
  copied_from.reserve(plan.exemplars.size());
  for (const PaintedExemplar& painted : plan.exemplars) {
    copied_from.push_back(painted.exemplar);
    plan.own_sheets.push_back(painted.exemplar.name == example_sheet_name);
  }
  plan.residual = world.scene.synthesis.residual;
  if (any_painting(copied_from))
    plan.residual.lightness = std::min(1.0, plan.residual.colour / SceneSynthesis{}.residual);
  const glm::ivec2 sheet = world.camera->size();
  std::vector<SceneTextureModel> models = read_texture_models(loaded);
  add_seam_sources(plan, world.scene);
  const auto unpack = [&](std::string packed) {
    if (!models.empty()) take_models(packed, plan.models, models.size());
    if (!plan.synthesis) plan.synthesis = unpack_plan({packed.begin(), packed.end()}, copied_from);
  };
  if (work.has_bytes(plan_name)) {
    unpack(work.read_bytes(plan_name));
    forget_compared(plan.exemplars);
    make_records(plan.models, std::move(models), world.scene.seed, run.progress);
    if (plan.seams) add_model_sources(*plan.seams, plan.models, plan.residual);
    return plan;
  }
  const StandingBytes standing{.ground = ground_bytes(world),
                               .besides = copying_bytes(plan.exemplars)};
  const SynthesisSheet division =
      divide_sheet(sheet.x, sheet.y, std::llround(world.scene.synthesis.plan_mpx * 1e6));
  const auto choose = [&](Progress& progress) {
    const SynthesisParameters parameters = fit_to_paintings(world.scene, copied_from, progress);
    const auto reduced_guides = [&] {
      RepeatedStages quiet(progress, false);
      const Run told{run.threads, run.memory_bytes, run.tile_px, quiet, run.cache};
      const int factor = 1 << division.level;
      const std::unique_ptr<const Camera> camera = make_reduced_camera(*world.camera, factor);
      const SheetView view = reduced_view(world, *camera, factor);
      StageGraph graph(scratch, quiet);
      const int tile_px = choose_block_px(world.scene, view.pixels_per_unit, standing);
      const GroundStages small =
          add_ground_stages(graph, make_ground_inputs(world, view, paint.palette, told), tile_px);
      return small.guides->read(small.guides->sheet());
    };
    if (division.level > 0 || !ground_tells) progress.begin("drafting the sheet", 0.0);
    GuideStack guides =
        division.level == 0 ? ground.guides->read(ground.guides->sheet()) : reduced_guides();
    for (const ModelledClass& chosen :
         choose_modelled(models, copied_from, guides.label, parameters)) {
      plan.models.lit[static_cast<std::size_t>(chosen.id)] = static_cast<std::uint8_t>(chosen.lit);
      plan.models.shaded[static_cast<std::size_t>(chosen.id)] =
          static_cast<std::uint8_t>(chosen.shaded);
      if (!chosen.why.empty()) progress.note(chosen.why);
    }
    hide_modelled(guides, plan.models);
    note_scarcity(copied_from, guides, parameters, progress);
    plan.synthesis = plan_synthesis(copied_from, guides, division, parameters, progress);
    const std::vector<std::uint8_t> packed = pack_plan(*plan.synthesis);
    std::string bytes(packed.begin(), packed.end());
    if (!models.empty()) add_models(bytes, plan.models);
    return bytes;
  };
  // Proofs of one sheet share the plan of the whole; for a small sheet, planning is as fast as
  // reading a plan.
  const auto key = [&] {
    return make_cache_key(CachedProduct::synthesis_plan,
                          CacheKeyText().add("sheet", to_text(identify(loaded, {}))),
                          subject_of(loaded));
  };
  const std::string packed = division.level == 0
                                 ? choose(run.progress)
                                 : cached<std::string>(run.cache, key, run.progress, choose);
  unpack(packed);
  work.keep_bytes(plan_name, packed);
  forget_compared(plan.exemplars);
  make_records(plan.models, std::move(models), world.scene.seed, run.progress);
  if (plan.seams) add_model_sources(*plan.seams, plan.models, plan.residual);
  return plan;
}

}  // namespace belvedere
