#include "tools/fuzz/targets.h"

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>

#include "base/cache/bytes.h"
#include "base/cache/cache.h"
#include "base/cache/content_hash.h"
#include "base/progress.h"
#include "base/random.h"
#include "renderer/exemplar/available_texels.h"
#include "renderer/exemplar/example_sheet_plan.h"
#include "renderer/features/feature_style.h"
#include "renderer/image/exif.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/image/label_image.h"
#include "renderer/labels/label_points.h"
#include "renderer/labels/label_shapes.h"
#include "renderer/labels/label_style.h"
#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "renderer/scene/scene_lock.h"
#include "renderer/sheet/piece_file.h"
#include "renderer/style/style_file.h"
#include "terrain/climate/stations.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/rule_program.h"
#include "terrain/cover/towns.h"
#include "terrain/fetch/map_source.h"
#include "terrain/io/crs.h"
#include "terrain/io/csv.h"
#include "terrain/io/dem.h"
#include "terrain/io/features.h"
#include "terrain/layers/fit/colour_regions.h"
#include "terrain/layers/layers_file.h"
#include "terrain/register/control_pairs.h"
#include "texture/composite/make_composite.h"
#include "texture/sheet/synthesis_plan.h"
#include "texture/statistical/clique_model.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

using Read = std::function<void(const std::string& bytes)>;
using ReadFile = std::function<void(const std::string& path)>;

constexpr char crs[] = "EPSG:32632";

// A folder in memory, where there is one, that goes with the process.
class Folder {
 public:
  Folder() {
    std::error_code none;
    const bool in_memory = fs::is_directory("/dev/shm", none);
    std::string name =
        (in_memory ? "/dev/shm" : fs::temp_directory_path().string()) + "/belvedere-fuzz-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for files");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string write_file(const std::string& name, const std::string& bytes) {
  static const Folder folder;
  std::string path = folder / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  return path;
}

// The bytes as a file of that name.
Read of_file(const std::string& name, const ReadFile& read) {
  return [=](const std::string& bytes) { read(write_file(name, bytes)); };
}

void must(bool holds) {
  if (!holds) std::abort();
}

// A scene that was read must be written such that it reads back as the same.
void read_scene_text(const std::string& text) {
  const LoadedScene scene = parse_scene(text, "scene.toml", "/nowhere", {});
  scene_inputs(scene);
  source_credits(scene);
  const std::string written = write_scene(scene.scene);
  must(write_scene(parse_scene(written, "written.toml", "/nowhere", {}).scene) == written);
}

void read_layers_text(const std::string& text) {
  const std::string written = surface_layers_text(parse_surface_layers(text, "layers.toml"));
  must(surface_layers_text(parse_surface_layers(written, "written.toml")) == written);
}

void read_style_text(const std::string& text) {
  const std::string written = style_text(parse_style(text, "style.toml"));
  parse_style(written, "written.toml");
}

void read_lock_text(const std::string& text) {
  const SceneLock lock = parse_lock(text, "scene.lock");
  must(write_lock(parse_lock(write_lock(lock), "scene.lock")) == write_lock(lock));
}

void read_sheet_plan(const std::string& text) {
  const ExampleSheetPlan plan = parse_example_sheet_plan(text, "sheet.toml");
  const std::string written = write_example_sheet_plan(plan);
  must(write_example_sheet_plan(parse_example_sheet_plan(written, "sheet.toml")) == written);
}

void read_labels(const std::string& path) {
  static const LabelStyle style = load_label_style("classic");
  for (const NamesAre names : {NamesAre::needed, NamesAre::optional})
    read_label_points(path, crs, style, silent_progress(), names);
}

void read_vectors(const std::string& path) {
  static const LabelStyle style = load_label_style("classic");
  read_map_features(path, {.also = {"name"}, .box = MapBox{{6e5, 5.2e6}, {7e5, 5.3e6}}}, crs);
  read_map_features(path, {}, crs);
  read_label_shapes(path, crs, style, silent_progress());
}

void read_terrain(const std::string& path) {
  RasterSource source;
  source.path = path;
  source.crs = crs;
  read_codes(source);
  DemParameters parameters;
  parameters.sources = {source};
  parameters.crs = crs;
  parameters.cell_m = 100.0;
  read_dem(parameters, silent_progress());
}

void read_pairs(const std::string& path) {
  static const Dem dem = make_dem(
      {Grid<float>(40, 40, 1000.F), {666000.0, 5250000.0, 300.0, 300.0}, normalize_crs(crs)});
  read_control_pairs(path, {1200, 550}, dem);
}

void read_painting_file(const std::string& path) {
  Grid<float> alpha;
  read_painting(path, silent_progress(), &alpha);
}

// A piece: what is not whole must be refused, and what is whole must be read. Odd inputs get the
// hash that makes them whole.
void read_piece(const std::string& bytes) {
  static const PieceKey key{"0123", "panorama", {0, 0, 4, 3}};
  std::string content = bytes;
  if (!bytes.empty() && (bytes.back() & 1) != 0) content += hash_bytes(content);
  const std::string path = write_file("a.piece", content);
  is_whole_piece(path, key);
  Grid<float> light(4, 3);
  Grid<std::uint8_t> id(4, 3);
  const auto try_to = [](const auto& read) {
    try {
      read();
    } catch (const Error&) {
    }
  };
  try_to([&] { read_piece_bytes(path); });
  try_to([&] { read_piece_rows(path, key, 0, 3, 0, {plane_of(light), plane_of(id)}); });
}

// An entry of the cache with this header and payload.
void read_cache_entry(const std::string& bytes) {
  static const Folder folder;
  static const Cache cache({.folder = folder / "", .limit_bytes = 1 << 24});
  const CacheKey key{"product", "scene", "key"};
  const std::string path = (folder / "") + hash_bytes(key.product + '\n' + key.text) + ".cache";
  constexpr std::size_t head = 18 + 4 * 8 + 7 + 5 + 3;
  std::string content = bytes;
  if (content.size() >= head && (bytes.back() & 1) != 0)
    content += hash_bytes(std::string_view(content).substr(head));
  std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
  cache_entries(folder / "");
  cache.find(key, silent_progress());
  std::ofstream(path, std::ios::binary | std::ios::trunc) << content;  // a damaged one is gone
  std::vector<std::string> notes;
  std::vector<double> numbers;
  cache.read(
      key, [&](ByteReader& reader) { reader(notes, numbers); }, silent_progress());
}

// The bytes of cached values, as a changed version of the program would find them.
void read_values(const std::string& bytes) {
  std::vector<std::string> notes;
  std::vector<double> numbers;
  Grid<std::uint8_t> cells;
  ByteReader reader(std::as_bytes(std::span(bytes)));
  reader(notes, numbers, cells);
}

// Numbers of a good plan of synthesis, changed: each 5 bytes are a position and what is added
// there. The checksum is right.
void read_synthesis_plan(const std::string& bytes) {
  static const std::vector<Exemplar> exemplars = [] {
    Exemplar exemplar{"painting", Grid<Rgb8>(24, 20), {}};
    exemplar.guides.label = Grid<std::uint8_t>(24, 20, 3);
    exemplar.guides.guides.push_back({"tone", Grid<std::uint8_t>(24, 20)});
    for (std::size_t i = 0; i < exemplar.picture.size(); ++i) {
      const auto value = static_cast<std::uint8_t>(random_index(256, 1, static_cast<int>(i), 0));
      exemplar.picture[i] = {value, value, value};
      exemplar.guides.guides[0].values[i] = value;
    }
    return std::vector{exemplar};
  }();
  static const std::vector<std::uint8_t> good = [] {
    return pack_plan(
        plan_synthesis(exemplars, exemplars[0].guides, {48, 40, 1, 64}, {}, silent_progress()));
  }();
  std::vector<std::uint8_t> plan = good;
  const std::size_t content = plan.size() - 8;
  for (std::size_t i = 0; i + 5 <= bytes.size(); i += 5) {
    std::uint32_t at = 0;
    std::memcpy(&at, bytes.data() + i, sizeof at);
    std::uint8_t& byte = plan[at % content];
    byte = static_cast<std::uint8_t>(byte + static_cast<std::uint8_t>(bytes[i + 4]));
  }
  std::uint64_t sum = content;
  for (std::size_t i = 0; i < content; ++i) sum = mix_bits(sum ^ plan[i]);
  for (std::size_t i = 0; i < 8; ++i) plan[content + i] = static_cast<std::uint8_t>(sum >> (8 * i));
  unpack_plan(plan, exemplars);
}

}  // namespace

const std::vector<FuzzTarget>& fuzz_targets() {
  static const std::vector<FuzzTarget> targets = {
      {"scene", "scenes/demo data/sheet/scene.toml", read_scene_text},
      {"legend", "data/legends", of_file("legend.toml", [](auto& path) { read_legend(path); })},
      {"legend_csv", "", of_file("legend.csv", [](auto& path) { read_legend(path); })},
      {"class_rules", "data/layers",
       of_file("rules.toml", [](auto& path) { read_class_rules(path); })},
      {"layers", "", read_layers_text},
      {"style", "data/styles/monet.toml", read_style_text},
      {"palette", "data/palettes", [](auto& text) { parse_palette(text, "palette.toml"); }},
      {"texture_model", "", [](auto& text) { parse_model(text, "model.toml"); }},
      {"composite_model", "", [](auto& text) { parse_composite(text, "model.toml"); }},
      {"lock", "", read_lock_text},
      {"csv", "scenes/karwendel_names.csv", [](auto& text) { parse_csv(text, "table.csv"); }},
      {"label_style", "data/labels", [](auto& text) { parse_label_style(text, "labels.toml"); }},
      {"feature_style", "data/features",
       [](auto& text) { parse_feature_style(text, "features.toml"); }},
      {"label_points", "scenes/karwendel_names.csv", of_file("names.csv", read_labels)},
      {"towns", "",
       of_file("towns.csv", [](auto& path) { read_towns(path, crs, silent_progress()); })},
      {"stations", "",
       of_file("stations.csv", [](auto& path) { read_stations(path, crs, silent_progress()); })},
      {"control_pairs", "", of_file("pairs.csv", read_pairs)},
      {"sheet_plan", "data/sheet/plan.toml", read_sheet_plan},
      {"needed_texels", "data/sheet/needed_texels.toml",
       [](auto& text) { parse_needed_texels(text, "needed.toml"); }},
      {"map_source", "data/sources", [](auto& text) { parse_map_source(text, "source.toml"); }},
      {"colour_regions", "", [](auto& text) { parse_colour_regions(text, "regions.toml"); }},
      {"piece", "", read_piece},
      {"synthesis_plan", "", read_synthesis_plan},
      {"cache_entry", "", read_cache_entry},
      {"cached_values", "", read_values},
      {"guidance", "", of_file("guidance.exr", [](auto& path) { read_guidance(path); })},
      {"class_mask", "", of_file("mask.png", [](auto& path) { read_class_mask(path); })},
      {"label_mask", "", of_file("mask.png", [](auto& path) { read_label_images({path}); })},
      {"painting_png", "", of_file("painting.png", read_painting_file)},
      {"painting_tif", "", of_file("painting.tif", read_painting_file)},
      {"painting_jpg", "", of_file("painting.jpg", read_painting_file)},
      {"painting_exr", "", of_file("painting.exr", read_painting_file)},
      {"painting_jxl", "", of_file("painting.jxl", read_painting_file)},
      {"exif", "",
       [](auto& text) {
         read_exif({text.begin(), text.end()});
       }},
      {"profile", "", of_file("press.icc", [](auto& path) { read_device_profile(path); })},
      {"gpx", "", of_file("way.gpx", read_vectors)},
      {"geojson", "", of_file("map.geojson", read_vectors)},
      {"osm", "", of_file("map.osm", read_vectors)},
      {"terrain_asc", "", of_file("terrain.asc", read_terrain)},
      {"terrain_tif", "", of_file("terrain.tif", read_terrain)},
  };
  return targets;
}

}  // namespace belvedere
