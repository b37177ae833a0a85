#include "renderer/pipeline/sheet_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/stages/picture_layers.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/shared_cache.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/learn_texture.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Synthesis in two levels of tiles, over the border between two of them; with trees, rivers and
// reflections.
constexpr const char* wide_scene = R"(
version = 1
[terrain.synthetic]
width = 200
height = 160
cell_m = 90
seed = 3
[camera]
position = [9000, -6000]
height_m = 7000
pitch_deg = -24
[sampling]
pixel_samples = 4
shadow_rays = 2
sky_directions = 4
[[exemplar]]
width = 240
height = 180
[synthesis]
plan_mpx = 0.02
[output]
width = 1100
height = 130
sheet_width_mm = 550
formats = ["tif", "exr", "png"]
)";

// The whole sheet, made once.
class SheetJob : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    all_ = std::make_unique<test::Folder>();
    render(scene(), whole(), shared());
  }
  static void TearDownTestSuite() { all_.reset(); }
  static LoadedScene scene(const std::vector<std::string>& settings = {}) {
    return parse_scene(wide_scene, "wide.toml", ".", {.data_folders = {}, .settings = settings});
  }
  static belvedere::Run shared(int threads = 0) {
    return {.threads = threads, .cache = test::shared_cache()};
  }
  static std::string whole() { return all_->path(); }
  static void expect_same_files(const std::string& a, const std::string& b) {
    for (const char* file : {"panorama.tif", "panorama.png", "panorama.exr", "guidance.exr"}) {
      const std::string left = test::read_bytes(a + "/" + file);
      EXPECT_FALSE(left.empty()) << file;
      EXPECT_TRUE(left == test::read_bytes(b + "/" + file)) << file;
    }
    EXPECT_FALSE(fs::exists(work_folder_of(b)) && fs::exists(work_folder_of(a)));
  }
  static inline std::unique_ptr<test::Folder> all_;
  test::Folder folder_;
};

TEST_F(SheetJob, APartIsThePixelsOfTheWholeInEveryFile) {
  const GuidanceBuffers guidance = read_guidance(whole() + "/guidance.exr");
  int number = 0;
  // A pixel, across the border of pieces and tiles, corners, edges.
  for (const PixelRect part : {PixelRect{1023, 64, 1024, 65},
                               {990, 40, 1060, 110},
                               {0, 0, 37, 29},
                               {1040, 100, 1100, 130}}) {
    const std::string out = folder_ / std::to_string(number++);
    render(scene(), out, shared(), {.part = part});
    for (const char* file : {"/panorama.tif", "/panorama.png", "/panorama.exr"})
      EXPECT_TRUE(read_picture(out + file) == part_of(read_picture(whole() + file), part))
          << file << " " << number;
    const GuidanceBuffers cut = read_guidance(out + "/guidance.exr");
    for (const GuidanceChannel& channel : guidance_channels())
      std::visit(
          [&](auto member) {
            if ((guidance.*member).empty()) return;
            EXPECT_TRUE(cut.*member == part_of(guidance.*member, part)) << channel.names[0];
          },
          channel.member);
  }
}

// A layer of an archive, unpacked by Python.
struct UnpackedLayer {
  Grid<glm::vec3> colour;
  Grid<float> opacity;
};
std::map<std::string, UnpackedLayer> unpack(const std::string& out) {
  EXPECT_EQ(std::system(("cd " + out + " && python3 -m zipfile -e panorama.ora layers").c_str()),
            0);
  std::map<std::string, UnpackedLayer> layers;
  for (const PictureLayer& layer : picture_layers()) {
    if (layer.of != LayerOf::all) continue;
    UnpackedLayer& one = layers[layer.name];
    one.colour = read_picture(out + "/layers/data/" + layer.name + ".png", &one.opacity);
  }
  return layers;
}

// The composite of the layers is the panorama, they change none of its bytes, and are the same for
// any part, pieces and threads.
TEST_F(SheetJob, LayersMakeThePanorama) {
  const std::string all = folder_ / "all";
  render(scene(), all, shared(), {.layers = {"ora", "psd", "exr"}});
  expect_same_files(whole(), all);
  EXPECT_TRUE(fs::exists(all + "/panorama.psd"));
  EXPECT_TRUE(fs::exists(all + "/panorama_layers.exr"));
  const std::map<std::string, UnpackedLayer> layers = unpack(all);
  const Grid<glm::vec3> panorama = read_picture(all + "/panorama.tif");
  Grid<glm::vec3> flat(panorama.width(), panorama.height(), glm::vec3(0.0F));
  double edges = 0.0;
  for (const PictureLayer& layer : picture_layers()) {
    if (layer.mask || layer.of != LayerOf::all) continue;
    const UnpackedLayer& one = layers.at(layer.name);
    for (std::size_t i = 0; i < flat.size(); ++i)
      flat[i] += one.opacity[i] * (one.colour[i] - flat[i]);
    if (layer.name == "edges")
      for (const float opacity : one.opacity) edges += opacity;
  }
  for (std::size_t i = 0; i < flat.size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(flat[i][c], panorama[i][c], 6.0 / 65535.0) << i;
  EXPECT_LT(edges, 0.1 * static_cast<double>(flat.size()))
      << "layers of strokes say nearly all of it";

  const PixelRect part{990, 40, 1060, 110};
  const std::string cut = folder_ / "cut";
  const ThreadLimit limit(1);
  render(scene(), cut, shared(), {.layers = {"ora"}, .part = part, .piece_px = 64, .block_px = 64});
  for (const auto& [name, layer] : unpack(cut)) {
    EXPECT_TRUE(layer.colour == part_of(layers.at(name).colour, part)) << name;
    EXPECT_TRUE(layer.opacity == part_of(layers.at(name).opacity, part)) << name;
  }
}

TEST_F(SheetJob, PartsOfAPlanMakeTheSameLayers) {
  const SheetRequest request{.channels = GuidanceChoice{std::vector<std::string>{}},
                             .layers = {"ora", "exr"}};
  render(scene(), folder_ / "one", shared(), request);
  plan_sheet(scene(), folder_ / "many", shared(), request);
  for (const int part : {2, 1}) make_part(scene(), folder_ / "many", part, 2, shared(), request);
  EXPECT_THAT(test::usage_error([&] { make_part(scene(), folder_ / "many", 1, 2, shared()); }),
              HasSubstr("results differ"));
  join_parts(scene(), folder_ / "many", 2, folder_ / "many", shared(), request);
  for (const char* file : {"panorama.tif", "panorama.ora", "panorama_layers.exr"})
    EXPECT_TRUE(test::read_bytes(folder_ / "one/" + file) ==
                test::read_bytes(folder_ / "many/" + file))
        << file;
}

TEST_F(SheetJob, LayersAreOfTheProgramsOwnColours) {
  EXPECT_THAT(
      test::usage_error([&] { render(scene(), folder_.path(), shared(), {.layers = {"xcf"}}); }),
      HasSubstr("ora, psd, exr"));
  folder_.write("show.ocio", "no matter what");
  const LoadedScene other =
      parse_scene(wide_scene, "wide.toml", folder_.path(),
                  {.data_folders = {}, .settings = {"output.ocio_config=show.ocio"}});
  EXPECT_THAT(
      test::usage_error([&] { render(other, folder_.path(), shared(), {.layers = {"ora"}}); }),
      HasSubstr("ocio_config"));
}

// Ground from a texture model: one lattice of tiles, whatever part of the sheet is requested.
TEST_F(SheetJob, GroundFromAModelIsTheSameInPartsAndPieces) {
  LearnParameters few;
  few.types = 16;
  test::write_bytes(folder_ / "m.model",
                    model_text(learn_texture(test::meadow_crop(64, 64), {}, few).model));
  const std::vector<std::string> settings = {
      "exemplar.1={ model = \"m.model\", serves = [\"pasture\", \"alpine_grass\", \"forest\"], "
      "prefer = \"model\" }"};
  const LoadedScene modelled = parse_scene(wide_scene, "wide.toml", folder_.path(),
                                           {.data_folders = {}, .settings = settings});
  const std::string all = folder_ / "all";
  const PixelRect wide{440, 0, 720, 130};
  render(modelled, all, shared(), {.part = wide});
  const Grid<glm::vec3> picture = read_picture(all + "/panorama.tif");
  EXPECT_NE(picture, part_of(read_picture(whole() + "/panorama.tif"), wide));
  const PixelRect part{490, 20, 560, 110};
  render(modelled, folder_ / "part", shared(), {.part = part});
  EXPECT_EQ(read_picture(folder_ / "part/panorama.tif"), part_of(picture, {50, 20, 120, 110}));
  render(modelled, folder_ / "small", shared(1), {.part = wide, .piece_px = 100, .block_px = 96});
  expect_same_files(all, folder_ / "small");
}

// Only what was requested is made and written, and it equals the same part of the whole file.
TEST_F(SheetJob, GuidanceHoldsTheChannelsThatWereAskedFor) {
  const PixelRect part{990, 40, 1060, 110};
  const GuidanceBuffers all = read_guidance(whole() + "/guidance.exr");
  render(scene(), folder_ / "two", shared(), {.channels = {{"Z", "landcover.id"}}, .part = part});
  const GuidanceBuffers two = read_guidance(folder_ / "two/guidance.exr");
  EXPECT_EQ(two.depth_m, part_of(all.depth_m, part));
  EXPECT_EQ(two.land_cover, part_of(all.land_cover, part));
  EXPECT_TRUE(two.normal.empty() && two.altitude_m.empty());
  render(scene(), folder_ / "classes", shared(),
         {.panorama = false, .channels = {{"landcover.id"}}, .part = part});
  EXPECT_EQ(read_guidance(folder_ / "classes/guidance.exr").land_cover, two.land_cover)
      << "without distances beside them";
  render(scene(), folder_ / "none", shared(),
         {.channels = std::vector<std::string>(), .part = part});
  EXPECT_FALSE(fs::exists(folder_ / "none/guidance.exr"));
  EXPECT_EQ(test::read_bytes(folder_ / "none/panorama.tif"),
            test::read_bytes(folder_ / "two/panorama.tif"));
  EXPECT_THAT(test::message_of(ErrorKind::usage,
                               [&] {
                                 render(
                                     scene(), folder_ / "none", shared(),
                                     {.panorama = false, .channels = std::vector<std::string>()});
                               }),
              HasSubstr("--channels"));
}

// Passes for compositing programs are the values of the other guidance, with the finished painting.
TEST_F(SheetJob, PassesForBlenderAreTheSameInPartsAndPieces) {
  const PixelRect part{990, 40, 1060, 110};
  const GuidanceChoice blender = {{"blender"}};
  render(scene(), folder_ / "part", shared(), {.channels = blender, .part = part});
  const std::string file = folder_ / "part/guidance.exr";
  const GuidanceBuffers all = read_guidance(whole() + "/guidance.exr");
  const Grid<float> depth_m = read_channel(file, "ViewLayer.Depth.Z");
  for (const auto [x, y] : test::cells(depth_m))
    ASSERT_EQ(depth_m(x, y), std::min(all.depth_m(part.x0 + x, part.y0 + y), 1e10F));
  EXPECT_EQ(read_channel(file, "ViewLayer.AO.R"), part_of(all.sky_view, part));
  EXPECT_EQ(read_channel(file, "ViewLayer.Combined.G"),
            part_of(read_channel(whole() + "/panorama.exr", "G"), part));
  EXPECT_EQ(test::read_bytes(folder_ / "part/panorama.tif").empty(), false);

  render(scene(), folder_ / "pieces", shared(1),
         {.channels = blender, .part = part, .piece_px = 64, .block_px = 64});
  expect_same_files(folder_ / "part", folder_ / "pieces");
  const SheetRequest request{.channels = blender, .part = part, .piece_px = 64};
  plan_sheet(scene(), folder_ / "many", shared(), request);
  for (const int one : {2, 1}) make_part(scene(), folder_ / "many", one, 2, shared(), request);
  join_parts(scene(), folder_ / "many", 2, folder_ / "many", shared(), request);
  EXPECT_EQ(test::read_bytes(folder_ / "many/guidance.exr"), test::read_bytes(file));

  render(scene(), folder_ / "alone", shared(),
         {.panorama = false, .channels = blender, .part = part});
  EXPECT_EQ(read_channel(folder_ / "alone/guidance.exr", "ViewLayer.Combined.G"),
            part_of(read_channel(whole() + "/guidance.exr", "base.G"), part))
      << "without a painting, the picture below it";
}

// The texels that pixels were copied from, as in the sheet's stages, whatever the part and the
// pieces.
TEST_F(SheetJob, MatchesAreThoseThePictureWasCopiedBy) {
  const PixelRect part{980, 30, 1080, 130};
  const PixelRect corner{1020, 60, 1060, 110};
  render(scene(), folder_ / "part", shared(), {.matches = true, .part = part});
  render(scene(), folder_ / "corner", shared(1),
         {.matches = true, .part = corner, .piece_px = 64, .block_px = 96});
  EXPECT_EQ(test::read_bytes(folder_ / "part/panorama.tif").empty(), false);
  const GuidanceBuffers guidance = read_guidance(folder_ / "part/guidance.exr");
  const auto ids = [&](const char* folder, const char* channel) {
    return read_id_channel(folder_ / (std::string(folder) + "/match.exr"), channel);
  };
  const Grid<std::uint32_t> exemplar = ids("part", "exemplar");
  const Grid<std::uint32_t> x = ids("part", "x");
  const Grid<std::uint32_t> y = ids("part", "y");
  const PixelRect within{corner.x0 - part.x0, corner.y0 - part.y0, corner.x1 - part.x0,
                         corner.y1 - part.y0};
  EXPECT_EQ(ids("corner", "exemplar"), part_of(exemplar, within));
  EXPECT_EQ(ids("corner", "x"), part_of(x, within));
  EXPECT_EQ(ids("corner", "y"), part_of(y, within));
  int copied = 0;
  for (std::size_t i = 0; i < exemplar.size(); ++i)
    if (guidance.is_sky(i)) {
      EXPECT_EQ(exemplar[i], Match::none) << i;
    } else if (exemplar[i] != Match::none) {
      ++copied;
      ASSERT_EQ(exemplar[i], 0U);
      ASSERT_LT(x[i], 240U);
      ASSERT_LT(y[i], 180U);
    }
  EXPECT_GT(copied, 2000);
  EXPECT_THAT(read_image_info(folder_ / "part/match.exr").notes.at("belvedere:matched_pictures"),
              testing::StartsWith("240 180 "));
  EXPECT_THAT(test::usage_error([&] {
                render(scene({"synthesis.enabled=false"}), folder_ / "no", shared(),
                       {.matches = true});
              }),
              HasSubstr("--match"));
}

TEST_F(SheetJob, APartOutsideOfTheSheetIsRefused) {
  for (const PixelRect part : {PixelRect{0, 0, 0, 5}, {1090, 0, 1101, 5}, {-1, 0, 5, 5}})
    EXPECT_THAT(
        test::usage_error([&] { render(scene(), folder_.path(), shared(), {.part = part}); }),
        HasSubstr("1100 × 130"));
}

TEST_F(SheetJob, PiecesAndTilesOfStagesChangeNoByte) {
  render(scene(), folder_ / "small", shared(1), {.piece_px = 200, .block_px = 96});
  expect_same_files(whole(), folder_ / "small");
}

// Stops after this many steps, like an interruption.
struct Stopping : Progress {
  explicit Stopping(int steps) : left(steps) {}
  void advance(double) override {
    if (--left < 0) throw Error(ErrorKind::interrupted, "", "stopped");
  }
  int left;
};

TEST_F(SheetJob, ARunThatWasStoppedGoesOnToTheSameBytes) {
  const SheetRequest request{.resume = true, .piece_px = 200};
  int stops = 0;
  for (int steps = 400;; steps += 700) {
    Stopping progress(steps);
    try {
      render(scene(), folder_.path(), {.progress = progress, .cache = test::shared_cache()},
             request);
      break;
    } catch (const Error& error) {
      ASSERT_EQ(error.kind(), ErrorKind::interrupted) << error.what();
      ++stops;
    }
  }
  EXPECT_GT(stops, 2);
  expect_same_files(whole(), folder_.path());
}

TEST_F(SheetJob, PartsInAnyOrderJoinToTheSameBytes) {
  plan_sheet(scene(), folder_.path(), shared());
  for (const int part : {3, 1, 3}) make_part(scene(), folder_.path(), part, 3, shared());
  // Missing pieces are named; a damaged piece counts as missing, and is made again.
  const auto expect_missing = [&](const std::string& which) {
    const std::string message = test::input_error(
        [&] { join_parts(scene(), folder_.path(), 3, folder_.path(), shared()); });
    EXPECT_THAT(message, HasSubstr(which));
    EXPECT_THAT(message, HasSubstr(" of 3 is missing or incomplete"));
    EXPECT_THAT(message, HasSubstr("missing"));
  };
  expect_missing("part 2");
  make_part(scene(), folder_.path(), 2, 3, shared());
  int damaged = 0;
  for (const auto& entry : fs::directory_iterator(work_folder_of(folder_.path()))) {
    if (!entry.path().filename().string().starts_with("panorama")) continue;
    std::string bytes = test::read_bytes(entry.path());
    bytes[bytes.size() / 2] ^= 1;
    test::write_bytes(entry.path(), bytes);
    ++damaged;
    break;
  }
  ASSERT_EQ(damaged, 1);
  expect_missing("part ");
  for (const int part : {1, 2, 3}) make_part(scene(), folder_.path(), part, 3, shared());
  join_parts(scene(), folder_.path(), 3, folder_.path(), shared());
  expect_same_files(whole(), folder_.path());
  EXPECT_THAT(
      test::usage_error([&] { make_part(scene({"seed=9"}), folder_.path(), 1, 3, shared()); }),
      HasSubstr("scene differs"));
  test::usage_error([&] { make_part(scene(), folder_.path(), 4, 3, shared()); });
}

}  // namespace
}  // namespace belvedere
