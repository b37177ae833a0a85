#include "renderer/pipeline/scene_labels.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"
#include "renderer/labels/label_files.h"
#include "renderer/labels/sheet_painter.h"
#include "renderer/world/world.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

// A synthetic range of 14 × 14 mountains of all heights with 220 names, seen from the south. Names
// in scripts that run from right to left, that join their letters, that may be in no font of the
// machine; short ones and long ones.
constexpr int cells = 320;
constexpr double cell_m = 60.0;
constexpr GeoTransform frame{680000.0, 5260000.0, cell_m, cell_m};
constexpr glm::ivec2 size_px{2000, 1000};
constexpr std::array words = {"Spitze",
                              "Großer Ödkar östlich der Alm",
                              "Пик Победы",
                              "جبل الشيخ",
                              "הר חרמון",
                              "御嶽山",
                              "Kofel",
                              "Ακροκόρινθος",
                              "एवरेस्ट",
                              "Sass dla Crusc",
                              "قمة الجبل العالي جدا",
                              "Ai",
                              "Ťažký štít",
                              "Monte Rosa – Nordend (Westgrat)",
                              "Piz"};

double drawn(int what, int of) { return random_uniform(27, what, of); }

struct Peak {
  glm::dvec2 cell{0.0};
  double top_m = 0.0;
};

double height_of(const Peak& peak, glm::dvec2 cell) {
  return peak.top_m - 42.0 * glm::length(cell - peak.cell);
}

std::vector<Peak> make_peaks() {
  std::vector<Peak> peaks;
  for (const auto [i, j] : test::cells(14, 14)) {
    const int k = 14 * j + i;
    const glm::dvec2 jitter(drawn(k, 0) - .5, drawn(k, 1) - .5);
    peaks.push_back({glm::dvec2(17.0 + 22.0 * i, 17.0 + 22.0 * j) + 8.0 * jitter,
                     900.0 + 1000.0 * drawn(k, 2)});
  }
  return peaks;
}

constexpr const char* scene_text = R"(version = 1
[[terrain.sources]]
file = "range.tif"
[camera]
position = [689600, 5232000]
height_m = 6000
azimuth_deg = 0
pitch_deg = -17
field_of_view_deg = 50
[deform]
exaggeration = 1.4
[deform.bend]
radius_m = 60000
crest_m = 12000
[sun]
azimuth_deg = 315
altitude_deg = 30
[generalize]
foreground_to_m = 15000
background_from_m = 30000
[sampling]
pixel_samples = 1
shadow_rays = 2
sky_directions = 0
[output]
width = 2000
height = 1000
sheet_width_mm = 900
)";

// Made once: a range, its names as files, its sheet, and the picture's own buffers, which contain
// no names.
class ManyNames : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new test::Folder("range");
    write_files();
    loaded_ = new LoadedScene(parse_scene(scene_text, "range.toml", folder_->path(), {}));
    job_ = {
        .points = {*folder_ / "names.csv"}, .shapes = {*folder_ / "valleys.geojson"}, .tracks = {}};
    bare_ = new BareView(make_bare_view(*loaded_, silent_progress()));
    sheet_ = new LabelSheet(make_label_sheet(*loaded_, job_, *bare_, silent_progress()));
    world_ = new World(make_world(*loaded_, silent_progress()));
    traced_ = new GuidanceBuffers(trace_guidance(
        world_->terrain, *world_->surface, world_->tracer, *world_->camera,
        {.sampling = loaded_->scene.sampling}, {0, 0, size_px.x, size_px.y}, silent_progress()));
  }
  static void TearDownTestSuite() {
    delete traced_;
    delete world_;
    delete sheet_;
    delete bare_;
    delete loaded_;
    delete folder_;
  }

  static void write_files() {
    const std::vector<Peak> peaks = make_peaks();
    Raster<float> raster{Grid<float>(cells, cells), frame, normalize_crs("EPSG:32632")};
    for (const auto [x, y] : test::cells(cells, cells)) {
      double z = 500.0 + .5 * x + .3 * y;
      for (const Peak& peak : peaks) z = std::max(z, height_of(peak, {x, y}));
      raster.cells(x, y) = static_cast<float>(z);
    }
    write_raster(*folder_ / "range.tif", raster);

    std::string names = "name,kind,rank,east,north\n";
    for (std::size_t k = 0; k < peaks.size() + 24; ++k) {
      const int i = static_cast<int>(k);
      const std::string name = fmt::format("{} {}", words[k % words.size()], k);
      glm::dvec2 cell(320.0 * drawn(i, 3), 320.0 * drawn(i, 4));
      const char* kind = k % 3 == 0 ? "town" : k % 3 == 1 ? "hut" : "lake";
      if (k < peaks.size()) {
        // Positions of summits in the file are up to 130 m off; a mountain within the flank of
        // another does not count.
        const bool stands = raster.cells(static_cast<int>(std::lround(peaks[k].cell.x)),
                                         static_cast<int>(std::lround(peaks[k].cell.y))) <
                            static_cast<float>(peaks[k].top_m + 1.0);
        kind = stands ? "summit" : "pass";
        cell = peaks[k].cell + 3.0 * glm::dvec2(drawn(i, 3) - .5, drawn(i, 4) - .5);
      }
      const glm::dvec2 position = frame.to_crs(cell.x, cell.y);
      names += fmt::format("{},{},{},{:.1f},{:.1f}\n", name, kind,
                           1 + static_cast<int>(8.0 * drawn(i, 5)), position.x, position.y);
    }
    folder_->write("names.csv", names);

    std::string valleys;
    for (int v = 0; v < 6; ++v) {
      std::vector<glm::dvec2> row;
      for (int s = 0; s <= 12; ++s) row.push_back(frame.to_crs(60.0 + 17.0 * s, 70.0 + 44.0 * v));
      PointTransform("EPSG:32632", "EPSG:4326").apply(row);
      std::string positions;
      for (const glm::dvec2 p : row)
        positions += fmt::format("{}[{:.6f},{:.6f}]", positions.empty() ? "" : ",", p.x, p.y);
      valleys += fmt::format(
          R"({}{{"type":"Feature","properties":{{"name":"{}tal","kind":"valley","rank":2}},"geometry":{{"type":"LineString","coordinates":[{}]}}}})",
          valleys.empty() ? "" : ",", words[static_cast<std::size_t>(v)], positions);
    }
    folder_->write("valleys.geojson",
                   R"({"type":"FeatureCollection","features":[)" + valleys + "]}");
  }

  // Height of the drawn ground of a pixel above the bent datum below it, exaggerated.
  static double drawn_height_m(int x, int y) {
    const Ray ray = world_->camera->ray({x + .5, y + .5});
    const glm::dvec3 point = glm::dvec3(ray.origin) + static_cast<double>(traced_->depth_m(x, y)) *
                                                          glm::dvec3(ray.direction);
    return point.z - world_->deformation.point({position_of(x, y), 0.0}).z;
  }
  static glm::dvec2 position_of(int x, int y) {
    return glm::dvec2(traced_->position_m(x, y)) + glm::dvec2(traced_->origin_m);
  }

  inline static test::Folder* folder_ = nullptr;
  inline static LoadedScene* loaded_ = nullptr;
  inline static LabelJob job_;
  inline static BareView* bare_ = nullptr;
  inline static LabelSheet* sheet_ = nullptr;
  inline static World* world_ = nullptr;
  inline static GuidanceBuffers* traced_ = nullptr;
};

TEST_F(ManyNames, EachIsPlacedOrSaidWhyNot) {
  std::size_t placed = 0, seen = 0, hidden = 0;
  for (const Label& label : sheet_->labels) {
    seen += label.mark.state == MarkState::seen ? 1U : 0U;
    hidden += label.mark.state == MarkState::hidden ? 1U : 0U;
    placed += label.spot.placed ? 1U : 0U;
    EXPECT_TRUE(!label.spot.placed || label.mark.state == MarkState::seen) << label.text;
  }
  EXPECT_EQ(sheet_->labels.size(), 226U);
  EXPECT_GT(placed, 45U) << "as many as the style allows on a picture of this size";
  EXPECT_GT(seen, placed) << "there is a crowd";
  EXPECT_GT(hidden, 20U);
}

TEST_F(ManyNames, NoBoxLiesOverAnother) {
  std::vector<std::pair<std::size_t, LabelBox>> boxes;
  for (std::size_t i = 0; i < sheet_->labels.size(); ++i) {
    const Label& label = sheet_->labels[i];
    if (!label.spot.placed) continue;
    if (label.spot.letters.empty())
      boxes.emplace_back(i, label.spot.text);
    else
      for (const LabelBox& letter : label.spot.letters) boxes.emplace_back(i, letter);
    const double r =
        label.spot.baseline.empty() ? .5 * sheet_->kind_of(label).mark_mm * sheet_->px_per_mm : 0.0;
    const glm::dvec2 m = label.mark.pixel;
    if (r > 0.0 && sheet_->kind_of(label).mark != LabelMarkShape::none)
      boxes.emplace_back(i, LabelBox{m.x - r, m.y - r, m.x + r, m.y + r});
    if (label.spot.has_leader)
      boxes.emplace_back(i, LabelBox{m.x - .1, label.spot.leader_end.y, m.x + .1, m.y - r});
  }
  std::size_t overlaps = 0;
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const bool marks = boxes[a].second.right - boxes[a].second.left < 12.0 &&
                         boxes[b].second.right - boxes[b].second.left < 12.0;
      if (boxes[a].first == boxes[b].first || marks || !boxes[a].second.overlaps(boxes[b].second))
        continue;
      ++overlaps;
      ADD_FAILURE() << sheet_->labels[boxes[a].first].text << " and "
                    << sheet_->labels[boxes[b].first].text;
    }
  EXPECT_EQ(overlaps, 0U);
}

// Boxes belong to the layout. The letters' own paint, name by name, is independent of them.
TEST_F(ManyNames, NoPaintOfTwoNamesSharesAPixel) {
  constexpr int around = 24;
  Grid<int> owner(size_px.x, size_px.y, -1);
  std::size_t painted = 0;
  for (std::size_t i = 0; i < sheet_->labels.size(); ++i) {
    const Label& label = sheet_->labels[i];
    if (!label.spot.placed) continue;
    LabelSheet alone = *sheet_;
    alone.labels = {label};
    Drawing drawing = label_drawing(alone);
    for (DrawnShape& shape : drawing.shapes)
      if (DrawnText* text = std::get_if<DrawnText>(&shape)) text->halo.clear();
    const double foot = std::max(label.spot.text.bottom, label.mark.pixel.y);
    const PixelRect rect = intersection(
        {0, 0, size_px.x, size_px.y},
        {static_cast<int>(label.spot.text.left) - around,
         static_cast<int>(label.spot.text.top) - around,
         static_cast<int>(label.spot.text.right) + around, static_cast<int>(foot) + around});
    Grid<glm::vec3> paper(rect.width(), rect.height(), glm::vec3(1.F, 0.F, 1.F));
    const Grid<glm::vec3> clean = paper;
    SheetPainter(drawing).paint(paper, {rect.x0, rect.y0});
    for (const auto [x, y] : test::cells(paper)) {
      if (glm::length(paper(x, y) - clean(x, y)) < .3F) continue;
      ++painted;
      int& who = owner(rect.x0 + x, rect.y0 + y);
      ASSERT_TRUE(who < 0 || who == static_cast<int>(i))
          << label.text << " and " << sheet_->labels[static_cast<std::size_t>(who)].text;
      who = static_cast<int>(i);
    }
  }
  EXPECT_GT(painted, 20000U);
}

// The picture's own buffers give the position of a summit: of all pixels that show ground within
// 300 m of the file's position those with the highest drawn ground, within the resolution of
// pixels: a pixel's centre may be half its width of ground below the very top. Or the mark is above
// that position on the edge behind which the summit falls out of sight: two pixels higher other
// ground is shown.
TEST_F(ManyNames, MarksOfSummitsStandWithinTwoPixelsOfTheDrawnSummit) {
  constexpr double reach_m = 300.0;
  constexpr double steepest = 1.0;  // mountains of 42 m a cell of 60 m, exaggerated by 1.4
  std::size_t summits = 0;
  for (const Label& label : sheet_->labels) {
    if (label.mark.state != MarkState::seen || sheet_->kind_of(label).climb_m <= 0.0) continue;
    struct Shown {
      glm::dvec2 pixel;
      double height_m, footprint_m;
    };
    std::vector<Shown> shown;
    double highest_m = -std::numeric_limits<double>::infinity();
    double where_m = 0.0;  // of the highest, from the file's place
    const glm::ivec2 about(label.mark.pixel);
    for (const auto [x, y] :
         test::cells({std::max(0, about.x - 120), std::max(0, about.y - 120),
                      std::min(size_px.x, about.x + 120), std::min(size_px.y, about.y + 120)})) {
      const double away_m = glm::length(position_of(x, y) - label.point.position);
      if (std::isinf(traced_->depth_m(x, y)) || away_m > reach_m) continue;
      shown.push_back({{x + .5, y + .5},
                       drawn_height_m(x, y),
                       static_cast<double>(traced_->footprint_m(x, y))});
      if (shown.back().height_m <= highest_m) continue;
      highest_m = shown.back().height_m;
      where_m = away_m;
    }
    // Where ground still rises at the end of the search radius, generalization left no summit
    // there.
    if (where_m > reach_m - 1.5 * cell_m) continue;
    double off_px = std::numeric_limits<double>::infinity();
    for (const Shown& s : shown)
      if (s.height_m >= highest_m - .5 * steepest * s.footprint_m)
        off_px = std::min(off_px, glm::length(label.mark.pixel - s.pixel));
    ++summits;
    const glm::ivec2 over(label.mark.pixel - glm::dvec2(0.0, 2.0));
    const auto at_top =
        std::max_element(shown.begin(), shown.end(),
                         [](const Shown& a, const Shown& b) { return a.height_m < b.height_m; });
    const bool on_edge = at_top != shown.end() && label.mark.pixel.y < at_top->pixel.y &&
                         (over.y < 0 || std::isinf(traced_->depth_m(over.x, over.y)) ||
                          traced_->depth_m(over.x, over.y) > label.mark.distance_m + reach_m);
    if (on_edge) continue;
    EXPECT_LE(off_px, 2.0) << label.text << " marked at " << label.mark.pixel.x << ','
                           << label.mark.pixel.y;
  }
  EXPECT_GT(summits, 60U);
}

// Visible marks have the depth of the picture, hidden ones are behind something nearer.
TEST_F(ManyNames, SeenAndHiddenAgreeWithTheTracedDepth) {
  std::size_t seen = 0, hidden = 0;
  for (const Label& label : sheet_->labels) {
    const LabelMark& mark = label.mark;
    if (label.mark.state != MarkState::seen && label.mark.state != MarkState::hidden) continue;
    if (!label.spot.baseline.empty() || label.point.where.find("valleys") != std::string::npos)
      continue;
    double nearest = std::numeric_limits<double>::infinity();  // of the ground around in the
                                                               // picture to the mark's own
    double farthest_m = 0.0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto depth_m = static_cast<double>(
            traced_->depth_m.clamped(static_cast<int>(std::floor(mark.pixel.x)) + dx,
                                     static_cast<int>(std::floor(mark.pixel.y)) + dy));
        nearest = std::min(nearest, std::abs(depth_m - mark.distance_m));
        farthest_m = std::max(farthest_m, depth_m);
      }
    if (mark.state == MarkState::seen) {
      ++seen;
      EXPECT_LT(nearest, .005 * mark.distance_m) << label.text;
    } else {
      ++hidden;
      EXPECT_FALSE(label.spot.placed) << label.text;
      const auto in_front_m = static_cast<double>(traced_->depth_m.clamped(
          static_cast<int>(std::floor(mark.pixel.x)), static_cast<int>(std::floor(mark.pixel.y))));
      EXPECT_LT(in_front_m, mark.distance_m - .5) << label.text;
    }
  }
  EXPECT_GT(seen, 100U);
  EXPECT_GT(hidden, 20U);
}

TEST(LabelJob, FilesThatAreOffAreLeftOut) {
  const LoadedScene off = parse_scene(
      "version = 1\n[labels]\nin_picture = true\n"
      "[[labels.points]]\nfile = \"none.csv\"\nenabled = false\n"
      "[[labels.tracks]]\nfile = \"none.gpx\"\nenabled = false\n",
      "mine.toml", ".", {});
  EXPECT_TRUE(label_job(off, silent_progress()).empty());
  EXPECT_FALSE(off.scene.labels.any());
}

TEST_F(ManyNames, OneIsMovedAnotherHiddenByHand) {
  const auto placed = std::find_if(sheet_->labels.begin(), sheet_->labels.end(),
                                   [](const Label& label) { return label.spot.placed; });
  ASSERT_NE(placed, sheet_->labels.end());
  const std::string moved = placed->point.name;
  const std::string hidden = std::next(placed)->point.name;
  LabelJob job = job_;
  job.by_hand.resize(3);
  job.by_hand[0].name = moved;
  job.by_hand[0].dx_mm = 12.0;
  job.by_hand[0].dy_mm = -20.0;
  job.by_hand[0].rank = 2.0;
  job.by_hand[0].kind = "hut";
  job.by_hand[1].name = hidden;
  job.by_hand[1].hidden = true;
  job.by_hand[2].name = "Nowhere";
  test::Notes notes;
  const LabelSheet sheet = make_label_sheet(*loaded_, job, *bare_, notes);
  const auto named = [&](const std::string& name) {
    return std::find_if(sheet.labels.begin(), sheet.labels.end(),
                        [&](const Label& label) { return label.point.name == name; });
  };
  EXPECT_EQ(named(hidden), sheet.labels.end());
  const Label& label = *named(moved);
  EXPECT_EQ(sheet.kind_of(label).name, "hut");
  EXPECT_EQ(label.point.rank, 2.0);
  ASSERT_TRUE(label.spot.placed);
  EXPECT_NEAR(.5 * (label.spot.text.left + label.spot.text.right) - label.mark.pixel.x,
              12.0 * sheet.px_per_mm, 1e-6);
  EXPECT_NEAR(label.spot.text.bottom - label.mark.pixel.y, -20.0 * sheet.px_per_mm, 1e-6);
  EXPECT_THAT(notes.text(), testing::HasSubstr("Nowhere"));
  job.by_hand[0].kind = "spaceship";
  EXPECT_THAT(
      test::error_of([&] { make_label_sheet(*loaded_, job, *bare_, silent_progress()); }).what(),
      testing::AllOf(testing::HasSubstr("labels.by_hand.0.kind"), testing::HasSubstr("summit")));
}

TEST_F(ManyNames, TheSameBytesForOneThreadAndTwo) {
  const auto files = [&](int threads) {
    const ThreadLimit limit(threads);
    const LabelSheet sheet = make_label_sheet(*loaded_, job_, *bare_, silent_progress());
    return std::array{labels_svg(sheet, ""), labels_csv(sheet),
                      labels_geojson(sheet, bare_->dem->crs)};
  };
  const auto one = files(1);
  EXPECT_EQ(one, files(2));
  EXPECT_EQ(one[1], labels_csv(*sheet_));
}

}  // namespace
}  // namespace belvedere
