#include "renderer/exemplar/scan.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/guidance_buffers.h"
#include "base/math_exact.h"
#include "renderer/exemplar/classes_by_paint.h"
#include "renderer/exemplar/example_sheet.h"
#include "renderer/exemplar/fill_excluded.h"
#include "renderer/exemplar/harmonize.h"
#include "renderer/exemplar/light/painting_tone.h"
#include "renderer/exemplar/painted_edges.h"
#include "renderer/exemplar/texture_models.h"
#include "renderer/exemplar/uncertain_places.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/image/image_io.h"
#include "renderer/image/label_image.h"
#include "renderer/image/srgb.h"
#include "renderer/paint/guides.h"

namespace belvedere {
namespace {

// How far places of a registered painting are off at best, of its width: rivers are narrower.
constexpr double best_registration = 3.0 / 1200.0;

constexpr auto sky_label = static_cast<std::uint8_t>(LandCoverClass::sky);

void check_same_size(const std::string& file, int width, int height,
                     const Grid<glm::vec3>& picture) {
  if (width != picture.width() || height != picture.height())
    throw Error(ErrorKind::input, file,
                fmt::format("{}×{} pixels, but the picture has {}×{}", width, height,
                            picture.width(), picture.height()),
                "the size of the picture");
}

// A painting as read from its files.
struct Raw {
  Grid<glm::vec3> picture;
  GuidanceBuffers guidance;
  bool measured = false;  // guidance comes from the renderer: with distances and all other channels
  bool painted = false;   // so does the picture: what guidance says of its light is exact
  Grid<std::uint8_t> labels;  // class ids, sky included; unused_label is never copied
  Grid<float> deviation_px;   // of the places of pixels; empty: they are known
};

Grid<float> read_share(const std::string& path, const Grid<glm::vec3>& picture) {
  Grid<float> share = read_grey_share(path);
  check_same_size(path, share.width(), share.height(), picture);
  return share;
}

Grid<std::uint8_t> read_classes(const SceneExemplar& settings, const LoadedScene& scene,
                                const Grid<glm::vec3>& picture) {
  const std::string path = find_scene_file(scene, settings.classes);
  Grid<std::uint8_t> ids = read_class_mask(path);
  check_same_size(path, ids.width(), ids.height(), picture);
  return ids;
}

void read_masks(const SceneExemplar& settings, const LoadedScene& scene, Raw& raw) {
  const Grid<std::uint8_t> ids = read_classes(settings, scene, raw.picture);
  GuidanceBuffers& guidance = raw.guidance;
  guidance.depth_m = Grid<float>(ids.width(), ids.height(), 1.F);
  guidance.land_cover = Grid<LandCoverClass>(ids.width(), ids.height());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    guidance.land_cover[i] = static_cast<LandCoverClass>(ids[i]);
    if (guidance.land_cover[i] == LandCoverClass::sky)
      guidance.depth_m[i] = std::numeric_limits<float>::infinity();
  }
  if (!settings.distance.empty()) {
    const Grid<float> share = read_share(find_scene_file(scene, settings.distance), raw.picture);
    const double ratio = settings.distance_range_m[1] / settings.distance_range_m[0];
    for (std::size_t i = 0; i < share.size(); ++i)
      if (!guidance.is_sky(i))
        guidance.depth_m[i] = static_cast<float>(settings.distance_range_m[0] *
                                                 exact::pow(ratio, static_cast<double>(share[i])));
  }
  if (settings.altitude.empty()) return;
  guidance.altitude_m = read_share(find_scene_file(scene, settings.altitude), raw.picture);
  for (float& value : guidance.altitude_m)
    value = static_cast<float>(settings.altitude_range_m[0] +
                               (settings.altitude_range_m[1] - settings.altitude_range_m[0]) *
                                   static_cast<double>(value));
}

// Files of one painting written by the program name the scene they were made from. A disk that
// filled up between them, or a copy of only one, leaves a pair that is not registered. Returns
// whether the program wrote both.
bool check_same_painting(const FileNotes& picture, const FileNotes& guidance,
                         const std::string& path) {
  const auto made_by = picture.find("belvedere:scene");
  const auto its = guidance.find("belvedere:scene");
  if (made_by == picture.end() || its == guidance.end()) return false;
  if (made_by->second == its->second) return true;
  throw Error(ErrorKind::input, path,
              "it belongs to a different painting: the picture was made from another scene",
              "the guidance.exr written together with the picture; if the painting was registered, "
              "trust = \"trust.png\" of its registration as well");
}

// A painting made by the program contains the origin of its paint: class and base colour are read
// there. The header of the file marks the layer without trees. Returns whether it is one.
bool take_paint(const SceneExemplar& settings, const LoadedScene& scene,
                GuidanceBuffers& guidance) {
  // The guidance of a registration is of a scene of its own and does not know the paint.
  if (!settings.trust.empty()) return false;
  const FileNotes notes = read_image_info(find_scene_file(scene, settings.picture)).notes;
  const std::string path = find_scene_file(scene, settings.guidance);
  const bool same = check_same_painting(notes, read_image_info(path).notes, path);
  const auto layer = notes.find(exemplar_layer_note);
  const bool without_trees = layer != notes.end() && layer->second == exemplar_ground_layer;
  const Grid<std::uint32_t>& from = without_trees ? guidance.ground_from : guidance.painted_from;
  if (from.empty() || guidance.base.empty()) return same;
  for (const std::uint32_t index : from)
    if (index >= from.size())
      throw Error(ErrorKind::input, path,
                  fmt::format("a pixel index of {} in painted_from or ground_from", index),
                  fmt::format("indices of the picture's pixels, below {}", from.size()));
  PaintedClasses classes = classes_of_paint(guidance, from);
  guidance.land_cover = std::move(classes.land_cover);
  guidance.base = decode_srgb(classes.base);
  return true;
}

// Removes excluded pixels from the labels; or fills them with the paint around them if the block
// requests it.
void exclude(const SceneExemplar& settings, const LoadedScene& scene, Raw& raw,
             Progress& progress) {
  if (settings.exclude.empty()) return;
  const Grid<float> mask = read_share(find_scene_file(scene, settings.exclude), raw.picture);
  Grid<std::uint8_t> excluded(mask.width(), mask.height());
  for (std::size_t i = 0; i < mask.size(); ++i) excluded[i] = mask[i] > 0.F ? 1 : 0;
  if (settings.excluded == "fill") {
    FilledPaint paint = fill_excluded(raw.picture, raw.labels, excluded, progress);
    progress.note(fmt::format(
        "{}: {} excluded pixels are filled with the paint around them{}", settings.picture,
        paint.filled,
        paint.left > 0
            ? fmt::format(", {} have too little paint of their class around them and stay unused",
                          paint.left)
            : ""));
    raw.picture = std::move(paint.picture);
    raw.labels = std::move(paint.labels);
    for (std::size_t i = 0; i < excluded.size(); ++i)
      if (excluded[i] != 0) raw.guidance.land_cover[i] = static_cast<LandCoverClass>(raw.labels[i]);
    return;
  }
  for (std::size_t i = 0; i < excluded.size(); ++i)
    if (excluded[i] != 0) raw.labels[i] = unused_label;
}

void set_classes(const Grid<std::uint8_t>& ids, GuidanceBuffers& guidance) {
  for (std::size_t i = 0; i < ids.size(); ++i)
    guidance.land_cover[i] = static_cast<LandCoverClass>(ids[i]);
}

Raw read_raw(const SceneExemplar& settings, const LoadedScene& scene, Progress& progress) {
  Raw raw;
  Grid<float> alpha;
  raw.picture = read_painting(find_scene_file(scene, settings.picture), progress, &alpha);
  if (!settings.guidance.empty()) {
    const std::string path = find_scene_file(scene, settings.guidance);
    raw.guidance = read_guidance(path);
    raw.measured = true;
    require_channels(raw.guidance, {&GuidanceBuffers::depth_m, &GuidanceBuffers::land_cover}, path,
                     ErrorKind::input);
    check_same_size(path, raw.guidance.width(), raw.guidance.height(), raw.picture);
    raw.painted = take_paint(settings, scene, raw.guidance);
    if (!settings.classes.empty())
      set_classes(read_classes(settings, scene, raw.picture), raw.guidance);
    else if (!raw.painted && settings.classes_from == "paint" && !raw.guidance.altitude_m.empty())
      set_classes(classes_by_paint(raw.picture, places_of(raw.guidance)), raw.guidance);
  } else {
    read_masks(settings, scene, raw);
  }
  if (!settings.shadow.empty())
    raw.guidance.shadow = read_share(find_scene_file(scene, settings.shadow), raw.picture);
  raw.labels = Grid<std::uint8_t>(raw.picture.width(), raw.picture.height());
  for (std::size_t i = 0; i < raw.labels.size(); ++i)
    raw.labels[i] =
        raw.guidance.is_sky(i) ? sky_label : static_cast<std::uint8_t>(raw.guidance.land_cover[i]);
  // Bare paper between the panels of an example sheet is neither ground nor sky.
  for (std::size_t i = 0; i < raw.guidance.sky_view.size(); ++i)
    if (raw.guidance.is_sky(i) && raw.guidance.sky_view[i] <= 0.F) raw.labels[i] = unused_label;
  if (!settings.trust.empty()) {
    raw.deviation_px =
        place_deviation(read_share(find_scene_file(scene, settings.trust), raw.picture));
    Grid<float> deviation_px = raw.deviation_px;
    if (settings.classes.empty()) {  // a mask that was drawn is exact
      const double best_px = best_registration * raw.picture.width();
      for (float& px : deviation_px) px = std::max(px, static_cast<float>(best_px));
      raw.labels = certain_sky(std::move(raw.labels), static_cast<int>(std::ceil(2.0 * best_px)));
    }
    raw.labels = certain_labels(raw.labels, deviation_px);
  }
  for (std::size_t i = 0; i < alpha.size(); ++i)
    if (alpha[i] < 0.5F) raw.labels[i] = unused_label;  // what is cut out of a picture is not paint
  exclude(settings, scene, raw, progress);
  return raw;
}

void harmonize_all(std::vector<Raw>& raws, const std::string& how, Progress& progress) {
  std::vector<LabelledPicture> pictures;
  std::vector<Raw*> there;
  for (Raw& raw : raws)
    if (!raw.picture.empty()) {
      pictures.push_back({&raw.picture, &raw.labels});
      there.push_back(&raw);
    }
  if (how == "off" || there.size() < 2) return;
  progress.begin("harmonizing the paintings' colours", 0.0);
  std::vector<Grid<glm::vec3>> alike = harmonize_as(how, pictures);
  for (std::size_t i = 0; i < there.size(); ++i) there[i]->picture = std::move(alike[i]);
}

glm::vec3 median_colour(std::vector<glm::vec3>& colours) {
  glm::vec3 out{};
  const auto centre = static_cast<std::ptrdiff_t>(colours.size() / 2);
  for (int c = 0; c < 3; ++c) {
    std::nth_element(colours.begin(), colours.begin() + centre, colours.end(),
                     [c](const glm::vec3& a, const glm::vec3& b) { return a[c] < b[c]; });
    out[c] = colours[static_cast<std::size_t>(centre)][c];
  }
  return out;
}

// The painted sky as a vertical gradient, and its light and dark parts as clouds.
void learn_sky(const Raw& raw, ScannedPainting& scan) {
  constexpr int bands = 5;
  int top = raw.picture.height();
  int bottom = -1;
  for (int y = 0; y < raw.picture.height(); ++y)
    for (int x = 0; x < raw.picture.width(); ++x)
      if (raw.labels(x, y) == sky_label) {
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
  if (bottom < top) return;
  std::array<std::vector<glm::vec3>, bands> colours;
  std::vector<glm::vec3> all;
  for (int y = top; y <= bottom; ++y)
    for (int x = 0; x < raw.picture.width(); ++x) {
      if (raw.labels(x, y) != sky_label) continue;
      colours[static_cast<std::size_t>((y - top) * bands / (bottom - top + 1))].push_back(
          raw.picture(x, y));
      all.push_back(raw.picture(x, y));
    }
  if (all.size() < min_texels) return;
  for (std::size_t k = 0; k < colours.size(); ++k)
    if (!colours[k].empty())
      scan.sky.emplace_back(static_cast<double>(k) / (bands - 1), median_colour(colours[k]));
  std::sort(all.begin(), all.end(), [](const glm::vec3& a, const glm::vec3& b) {
    return a.x + a.y + a.z < b.x + b.y + b.z;
  });
  const auto part = static_cast<std::ptrdiff_t>(std::max<std::size_t>(all.size() / 12, 1));
  std::vector<glm::vec3> light(all.end() - part, all.end());
  std::vector<glm::vec3> shade(all.begin() + 3 * part, all.begin() + 4 * part);
  scan.cloud_light = median_colour(light);
  scan.cloud_shade = median_colour(shade);
}

const Grid<std::uint8_t>& values_of(const GuideStack& guides, const char* name) {
  static const Grid<std::uint8_t> none;
  const Grid<std::uint8_t>* found = guides.find(name);
  return found == nullptr ? none : *found;
}

// Tone, cast shadow and valleys, where guidance does not know them exactly.
void find_light(const SceneExemplar& settings, Raw& raw, Progress& progress) {
  GuidanceBuffers& guidance = raw.guidance;
  const bool registered = raw.measured && !raw.painted;
  if (registered && !guidance.tone.empty() && !guidance.altitude_m.empty())
    guidance.tone =
        spread_tone(combine_tone(raw.picture, raw.labels, settings.stroke_px, guidance.tone,
                                 guidance.altitude_m, guidance.depth_m, raw.deviation_px),
                    raw.labels);
  else if (guidance.tone.empty())
    guidance.tone = estimate_tone(raw.picture, raw.labels, settings.stroke_px);
  if (!raw.measured) guidance.valley_height_m = find_valley_height(raw.labels);
  // Shadow is where the painter put it, not where the sun would have.
  if (registered && settings.shadow.empty()) guidance.shadow = {};
  if (!guidance.shadow.empty() || settings.found_shadow == "ignore") return;
  guidance.shadow = find_shadow(raw.picture, raw.labels, settings.stroke_px);
  std::size_t shaded = 0;
  for (std::size_t i = 0; i < raw.labels.size(); ++i)
    shaded += raw.labels[i] != unused_label && guidance.shadow[i] < lit_from ? 1 : 0;
  progress.note(
      fmt::format("{}: {:.1f} % of it is classified as cast shadow", settings.picture,
                  100.0 * static_cast<double>(shaded) / static_cast<double>(raw.labels.size())));
}

// How far silhouettes of a registered painting may be from where it is painted: two deviations.
Grid<float> silhouette_radius(Grid<float> deviation_px) {
  constexpr float max_px = 24.F;
  const auto best_px = static_cast<float>(best_registration * deviation_px.width());
  for (float& px : deviation_px) px = std::clamp(2.F * std::max(px, best_px), 3.F, max_px);
  return deviation_px;
}

ScannedPainting finish_scan(const SceneExemplar& settings, Raw raw, double residual,
                            Progress& progress) {
  ScannedPainting scan;
  learn_sky(raw, scan);
  for (std::uint8_t& label : raw.labels)
    if (label == sky_label) label = unused_label;  // the sky is painted, not copied
  find_light(settings, raw, progress);
  GuidanceBuffers& guidance = raw.guidance;
  if (guidance.fall_line.empty())
    guidance.fall_line = find_stroke_direction(raw.picture, raw.labels, settings.stroke_px);
  PaintedExemplar& painted = scan.painted;
  painted.exemplar.name = settings.picture;
  painted.exemplar.guides = make_guide_stack(guidance, guidance.land_cover);
  GuideStack& guides = painted.exemplar.guides;
  if (!raw.deviation_px.empty()) {
    average_over_places(raw.deviation_px, guides);
    guides.depth_m = snap_silhouettes(std::move(guides.depth_m), raw.picture,
                                      silhouette_radius(raw.deviation_px));
  }
  const bool has_distance = raw.measured || !settings.distance.empty();
  if (!has_distance)
    std::erase_if(guides.guides, [](const Guide& guide) { return guide.name == "distance"; });
  const Grid<std::uint8_t>& distance = values_of(guides, "distance");
  scan.ramps = fit_ramps(raw.picture, raw.labels, guidance.tone, distance);
  // That of a registered painting is in the program's colours, not in its own.
  if (!guidance.base.empty() && (raw.painted || !raw.measured))
    painted.base = encode_srgb(guidance.base);
  else
    painted.base = make_centred_base(scan.ramps, raw.picture, raw.labels, guidance.tone, distance);
  const bool leave_shadow = settings.found_shadow == "exclude" && !guidance.shadow.empty();
  for (std::size_t i = 0; i < raw.labels.size(); ++i) {
    const auto id = static_cast<LandCoverClass>(raw.labels[i]);
    const bool served =
        settings.serves.empty() ||
        std::find(settings.serves.begin(), settings.serves.end(), id) != settings.serves.end();
    if (!served || (leave_shadow && guidance.shadow[i] < lit_from)) raw.labels[i] = unused_label;
  }
  guides.label = std::move(raw.labels);
  if (!has_distance) guides.depth_m = {};
  painted.picture = std::move(raw.picture);
  painted.exemplar.picture = seam_picture(painted, guides.label, residual);
  return scan;
}

}  // namespace

std::vector<ScannedPainting> read_scans(const LoadedScene& scene, Progress& progress) {
  const std::vector<SceneExemplar>& paintings = scene.scene.exemplars;
  std::vector<Raw> raws(paintings.size());
  for (std::size_t i = 0; i < paintings.size(); ++i) {
    if (paintings[i].picture.empty()) continue;
    if (find_scene_file(scene, paintings[i].picture).empty()) {
      // Missing files that are not optional were rejected before the work began.
      progress.note(fmt::format("exemplar {} does not exist and is left out; get it from {}{}",
                                paintings[i].picture, paintings[i].get_from,
                                similar_scene_file_hint(scene, paintings[i].picture)));
      continue;
    }
    raws[i] = read_raw(paintings[i], scene, progress);
  }
  harmonize_all(raws, scene.scene.synthesis.harmonize, progress);
  std::vector<ScannedPainting> scans(paintings.size());
  for (std::size_t i = 0; i < paintings.size(); ++i)
    if (!raws[i].picture.empty())
      scans[i] =
          finish_scan(paintings[i], std::move(raws[i]), scene.scene.synthesis.residual, progress);
  // A model has colours but no texels.
  const std::vector<SceneTextureModel> models = read_texture_models(scene);
  for (const SceneTextureModel& model : models)
    for (const LandCoverClass id : model.serves)
      scans[model.block].ramps[static_cast<std::size_t>(id)] = model_ramps(models, model, id);
  return scans;
}

double painting_texels(const LoadedScene& scene) {
  double texels = 0.0;
  for (const SceneExemplar& settings : scene.scene.exemplars) {
    const std::string path = find_scene_file(scene, settings.picture);
    if (path.empty()) continue;
    const ImageInfo info = read_image_info(path);
    texels += static_cast<double>(info.width) * info.height;
  }
  return texels;
}

void check_paintings(const LoadedScene& scene) {
  read_texture_models(scene);
  for (const SceneExemplar& settings : scene.scene.exemplars) {
    const std::string path =
        settings.picture.empty() ? std::string() : find_scene_file(scene, settings.picture);
    if (path.empty()) continue;
    const Grid<glm::vec3> picture = read_painting(path, silent_progress());
    for (const std::string* file :
         {&settings.guidance, &settings.classes, &settings.altitude, &settings.distance,
          &settings.trust, &settings.shadow, &settings.exclude}) {
      if (file->empty()) continue;
      const std::string guide = find_scene_file(scene, *file);
      const ImageInfo info = read_image_info(guide);
      check_same_size(guide, info.width, info.height, picture);
      if (file == &settings.classes)
        read_class_mask(guide);
      else if (file != &settings.guidance)
        read_grey_share(guide);
    }
  }
}

}  // namespace belvedere
