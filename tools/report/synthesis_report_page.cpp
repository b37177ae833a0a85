#include "tools/report/synthesis_report_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "base/text/text_encoding.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int map_px = 600;  // longest side of a map
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr int crop_times = 4;  // magnification of the worst windows

Grid<glm::vec3> grey_picture(const Grid<std::uint8_t>& values) {
  Grid<glm::vec3> out(values.width(), values.height());
  std::transform(values.begin(), values.end(), out.begin(),
                 [](std::uint8_t v) { return glm::vec3(static_cast<float>(v) / 255.F); });
  return out;
}

// Only of guides that both sides have.
const Grid<std::uint8_t>& guide_values(const GuideStack& stack, const std::string& name) {
  const Grid<std::uint8_t>* values = stack.find(name);
  if (values == nullptr) throw Error(ErrorKind::bug, "report", "guide \"" + name + "\" is missing");
  return *values;
}

// A texel's position as a colour: red from left to right, green from top to bottom, blue by the
// number of the painting.
glm::vec3 place_colour(std::size_t exemplar, std::size_t count, int x, int y, int width,
                       int height) {
  const auto share = [](double a, double b) { return static_cast<float>(a / std::max(1.0, b)); };
  return {share(x, width - 1), share(y, height - 1),
          count < 2 ? 0.5F : share(static_cast<double>(exemplar), static_cast<double>(count - 1))};
}

Grid<glm::vec3> field_picture(const MatchField& matches, const std::vector<Exemplar>& exemplars) {
  Grid<glm::vec3> out(matches.width(), matches.height(), glm::vec3(0.F));
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Match& m = matches[i];
    if (m.exemplar == Match::none) continue;
    const Grid<Rgb8>& picture = exemplars[m.exemplar].picture;
    out[i] =
        place_colour(m.exemplar, exemplars.size(), m.x, m.y, picture.width(), picture.height());
  }
  return out;
}

// A frame with a letter, in a map `factor` times smaller than the picture.
void mark(Grid<glm::vec3>& map, const Place& position, int factor) {
  const glm::vec3 yellow(1.F, 0.9F, 0.1F);
  const PixelRect r{position.window.x0 / factor, position.window.y0 / factor,
                    position.window.x1 / factor, position.window.y1 / factor};
  const auto dot = [&](int x, int y, glm::vec3 colour) {
    if (map.contains(x, y)) map(x, y) = colour;
  };
  for (int x = r.x0; x <= r.x1; ++x) {
    dot(x, r.y0, yellow);
    dot(x, r.y1, yellow);
  }
  for (int y = r.y0; y <= r.y1; ++y) {
    dot(r.x0, y, yellow);
    dot(r.x1, y, yellow);
  }
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 9; ++x) dot(r.x0 + 1 + x, r.y0 + 1 + y, glm::vec3(0.F));
  draw_text(map, r.x0 + 3, r.y0 + 2, position.letter, yellow, 1);
}

void add_overview(Report& page, const SynthesisReportInput& in, const Grid<glm::vec3>& picture,
                  const SynthesisFindings& found) {
  page.section(
      "overview", "The picture and its input",
      "On the left the classes asked for, then the picture; the frames mark the windows shown at "
      "the end. Below the paintings with their classes; excluded texels are near black.");
  page.picture("target_classes", reduced_picture(label_picture(in.target.label), map_px),
               "classes of the target");
  Grid<glm::vec3> small = reduced_picture(picture, map_px);
  const int factor =
      std::max(1, (std::max(picture.width(), picture.height()) + map_px - 1) / map_px);
  for (const Place& position : found.positions) mark(small, position, factor);
  page.picture("picture", small, "the picture");
  for (std::size_t e = 0; e < in.exemplars.size(); ++e) {
    const Exemplar& exemplar = in.exemplars[e];
    page.next_row();
    page.picture(fmt::format("painting_{}_classes", e + 1),
                 reduced_picture(label_picture(exemplar.guides.label), map_px),
                 "classes of the painting");
    page.picture(fmt::format("painting_{}", e + 1),
                 reduced_picture(to_picture(exemplar.picture), map_px), exemplar.name);
  }
}

void add_seams(Report& page, const SeamsOfKinds& seams) {
  page.section("seams", "Seams between paintings",
               "Neighbours that were not side by side in a painting, and how much their colours "
               "differ. Visibility is that step relative to the steps of neighbours of the same "
               "classes in the paintings themselves: at 1 a seam steps like the painting, above it "
               "shows. Silhouettes do not count.");
  ReportTable table({{"seams", "seams"},
                     {"pairs", "pairs"},
                     {"step", "step, levels", ".1f"},
                     {"visibility", "visibility", ".2f"}});
  const auto row = [&table](const char* name, const SeamVisibility& of) {
    table.row(name, of.pairs, of.pairs == 0 ? unknown : of.step,
              of.compared == 0 ? unknown : of.visibility);
  };
  row("from one painting to another", seams.between);
  row("inside a painting", seams.within);
  page.table(table);
}

void add_figures(Report& page, const SynthesisReportInput& in, const SynthesisFindings& found) {
  page.section("figures", "Figures",
               "Measured figures with their good range; red is outside it. No figure is sufficient "
               "alone, and none replaces looking: blur improves some of them.");
  ReportTable figures({{"key", "", "hidden"},
                       {"figure", "figure"},
                       {"value", "this picture", ".3g"},
                       {"wanted", "wanted"}});
  for (const QualityFigure& figure : key_figures(found.quality))
    figures.row(figure.key, figure.name, evaluated(figure.value, figure.good()),
                range(figure.min, figure.max));
  page.table(figures);
  if (found.quality.exemplars > 1) add_seams(page, found.quality.seams);

  page.section(
      "classes", "Class by class",
      fmt::format(
          "Relative to the painting: sharpness and stroke length are ratios, clique and colour "
          "distance grow from 0. The floor is the difference of the painting from itself at the "
          "target's altitudes and borders, the next figure the additional difference of the "
          "synthesis. A texel serves up to {} pixels before strokes visibly repeat.",
          pixels_per_texel));
  page.table(class_table(found.quality, found.available, in.class_name));
}

void add_field(Report& page, const SynthesisReportInput& in) {
  page.section("field", "Where texels come from",
               "Every position of the painting has a colour (right: red grows to the right, green "
               "downwards, blue distinguishes paintings); on the left each pixel has the colour of "
               "its texel's position. Patches of one colour are pieces copied together.");
  page.picture("field", reduced_picture(field_picture(in.matches, in.exemplars), map_px),
               "the picture, by the positions of its texels");
  for (std::size_t e = 0; e < in.exemplars.size(); ++e) {
    const int width = in.exemplars[e].picture.width();
    const int height = in.exemplars[e].picture.height();
    Grid<glm::vec3> key(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        key(x, y) = place_colour(e, in.exemplars.size(), x, y, width, height);
    page.picture(fmt::format("field_key_{}", e + 1), reduced_picture(key, 200),
                 in.exemplars[e].name);
  }
}

void add_reuse(Report& page, const SynthesisReportInput& in, const SynthesisFindings& found) {
  const float full = static_cast<float>(std::max(4, found.quality.max_used));
  page.section("reuse", "How often texels are used",
               fmt::format("Black is never, white {:.0f} times. On the left the picture by the "
                           "number of uses of each pixel's texel, on the right the paintings: "
                           "black parts were not used, bright ones are in high demand.",
                           static_cast<double>(full)));
  page.picture("reuse", reduced_picture(heat_picture(found.use_counts, full), map_px),
               "the picture");
  for (std::size_t e = 0; e < found.uses.size(); ++e) {
    Grid<float> counts(found.uses[e].width(), found.uses[e].height());
    std::transform(found.uses[e].begin(), found.uses[e].end(), counts.begin(),
                   [](std::uint32_t n) { return static_cast<float>(n); });
    page.picture(fmt::format("reuse_painting_{}", e + 1),
                 reduced_picture(heat_picture(counts, full), map_px), in.exemplars[e].name);
  }
}

void add_costs(Report& page, const SynthesisReportInput& in, const SynthesisFindings& found) {
  page.section("costs", "Cost of seams and guides",
               "Seams: how badly the texels around each pixel fit together. Guides: weight times "
               "the squared difference between the requested and the found value. A guide with a "
               "small share could have more weight; one that outweighs seams tears strokes apart. "
               "White is the 99th percentile of each map.");
  double total = found.seam_mean;
  for (const GuideFindings& guide : found.guides) total += guide.cost_mean;
  const auto share = [total](double cost) { return total > 0.0 ? cost / total : unknown; };
  ReportTable table({{"name", "term"},
                     {"weight", "weight", ".3g"},
                     {"error_mean", "deviation, mean", ".2f"},
                     {"error_95", "deviation, 95 %", ".0f"},
                     {"cost_mean", "cost, mean", ".0f"},
                     {"share", "share", ".0%"}});
  table.row("seams", unknown, unknown, unknown, found.seam_mean, share(found.seam_mean));
  for (const GuideFindings& guide : found.guides)
    table.row(guide.name, guide.weight, guide.error_mean, guide.error_95, guide.cost_mean,
              share(guide.cost_mean));
  page.table(table);
  const auto map = [&](const std::string& file, const Grid<float>& cost,
                       const std::string& caption) {
    page.picture(file, reduced_picture(heat_picture(cost, percentile(cost, 0.99)), map_px),
                 caption);
  };
  map("cost_seams", found.seams, "seams");
  for (std::size_t g = 0; g < found.guides.size(); ++g) {
    if (g % 2 == 1) page.next_row();
    map(fmt::format("cost_guide_{}", g + 1), guide_cost_map(in, found.guides[g].name),
        found.guides[g].name);
  }
}

void add_worst_places(Report& page, const SynthesisReportInput& in, const Grid<glm::vec3>& picture,
                      const SynthesisFindings& found) {
  page.section("worst", "The worst windows",
               fmt::format("Each {0} × {0} pixels, {1} times as large, and beside it where most of "
                           "it was copied from.",
                           worst_place_side, crop_times));
  const float seam_full = percentile(found.seams, 0.99);
  const float use_full = static_cast<float>(std::max(4, found.quality.max_used));
  ReportTable table({{"letter", "place"},
                     {"why", "why"},
                     {"x", "x"},
                     {"y", "y"},
                     {"painting", "copied from"},
                     {"source_x", "x"},
                     {"source_y", "y"},
                     {"pixels_from_source", "pixels of it"}});
  for (const Place& position : found.positions)
    table.row(position.letter, position.why, position.window.x0, position.window.y0,
              in.exemplars[position.exemplar].name, position.source.x0, position.source.y0,
              position.piece);
  page.table(table);
  for (const Place& position : found.positions) {
    page.next_row();
    const auto show = [&](const char* what, const Grid<glm::vec3>& crop,
                          const std::string& caption) {
      page.picture(fmt::format("place_{}_{}", position.letter, what), enlarged(crop, crop_times),
                   caption);
    };
    show("picture", cut(picture, position.window),
         fmt::format("{}: {}, at {}, {}", position.letter, position.why, position.window.x0,
                     position.window.y0));
    const Exemplar& exemplar = in.exemplars[position.exemplar];
    show("source", to_picture(cut(exemplar.picture, position.source)),
         fmt::format("{} of its pixels: {} at {}, {}", position.piece, exemplar.name,
                     position.source.x0, position.source.y0));
    show("field", field_picture(cut(in.matches, position.window), in.exemplars),
         "positions of its texels");
    if (!position.guide.empty()) {
      std::vector<const Grid<std::uint8_t>*> offered;
      for (const Exemplar& from : in.exemplars)
        offered.push_back(&guide_values(from.guides, position.guide));
      const Grid<std::uint8_t> asked =
          cut(guide_values(in.target, position.guide), position.window);
      show("asked", grey_picture(asked), position.guide + " asked for");
      show("found",
           grey_picture(replay(cut(in.matches, position.window), offered, Grid<std::uint8_t>())),
           position.guide + " found");
    } else if (position.why == "seams") {
      show("cost", heat_picture(cut(found.seams, position.window), seam_full), "seams");
    } else {
      show("uses", heat_picture(cut(found.use_counts, position.window), use_full),
           "uses of its texels");
    }
  }
}

}  // namespace

void write_synthesis_report(const std::string& folder, const SynthesisReportInput& in,
                            Progress& progress) {
  const SynthesisFindings found = look_at_synthesis(in, progress);
  progress.begin("writing the report", 0.0);
  std::vector<const Grid<Rgb8>*> layers;
  for (const Exemplar& exemplar : in.exemplars) layers.push_back(&exemplar.picture);
  const Grid<glm::vec3> picture = to_picture(replay(in.matches, layers, Grid<Rgb8>()));
  Report page(folder);
  add_overview(page, in, picture, found);
  add_figures(page, in, found);
  add_costs(page, in, found);
  add_field(page, in);
  add_reuse(page, in, found);
  add_worst_places(page, in, picture, found);
  page.write({.title = "Synthesis of " + in.title,
              .lead = fmt::format("{} × {} pixels from {} painting{}.", in.matches.width(),
                                  in.matches.height(), in.exemplars.size(),
                                  in.exemplars.size() == 1 ? "" : "s"),
              .command = in.command});
}

}  // namespace belvedere::tools
