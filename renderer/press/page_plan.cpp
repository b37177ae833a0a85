#include "renderer/press/page_plan.h"

#include <cairo-pdf.h>
#include <fmt/core.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/text/missing_file.h"

// The one file that uses librsvg, and with it cairo's PDF.

namespace belvedere {
namespace {

constexpr double max_mm = 5080.0;  // 14400 units of 1/72 inch (ISO 32000-1, annex C)
constexpr double mark_gap_mm = 2.0;
constexpr double mark_mm = 5.0;

MmBox shrunk(MmBox box, double by) {
  return {box.left + by, box.bottom + by, box.width - 2.0 * by, box.height - 2.0 * by};
}

void require_size(glm::dvec2 page_mm) {
  if (std::max(page_mm.x, page_mm.y) > max_mm)
    throw Error(
        ErrorKind::usage, "page", fmt::format("{:.0f} × {:.0f} mm", page_mm.x, page_mm.y),
        fmt::format("sides of up to {:.0f} mm; --paper splits larger sheets into pages", max_mm));
}

PrintPage single_page(glm::dvec2 picture_mm, const PageParameters& parameters) {
  const double around = parameters.marks ? mark_gap_mm + mark_mm + 1.0 : 0.0;
  PrintPage page;
  page.size_mm = picture_mm + 2.0 * around;
  require_size(page.size_mm);
  page.picture = {around, around, picture_mm.x, picture_mm.y};
  page.shown = page.picture;
  page.trim = shrunk(page.picture, parameters.bleed_mm);
  if (page.trim.width <= 0.0 || page.trim.height <= 0.0)
    throw Error(ErrorKind::usage, "bleed", fmt::format("{:g} mm", parameters.bleed_mm),
                "less than half of the sheet");
  return page;
}

// Tiles along one side.
int tiles_along(double picture_mm, double area_mm, double overlap_mm) {
  constexpr double nothing_mm = 1e-6;
  return picture_mm <= area_mm + nothing_mm
             ? 1
             : static_cast<int>(
                   std::ceil((picture_mm - overlap_mm - nothing_mm) / (area_mm - overlap_mm)));
}

}  // namespace

std::vector<PrintPage> plan_pages(glm::dvec2 picture_mm, const PageParameters& parameters) {
  if (!parameters.paper_mm) return {single_page(picture_mm, parameters)};
  if (parameters.bleed_mm > 0.0)
    throw Error(ErrorKind::usage, "bleed", "together with tiles",
                "one of the two: tiles are glued, not cut");
  const glm::dvec2 paper = *parameters.paper_mm;
  require_size(paper);
  const glm::dvec2 area = paper - 2.0 * parameters.margin_mm;
  if (std::min(area.x, area.y) <= parameters.overlap_mm + 1.0)
    throw Error(ErrorKind::usage, "paper",
                fmt::format("{:g} × {:g} mm leaves no room", paper.x, paper.y),
                fmt::format("more than margins of {:g} mm and {:g} mm of overlap",
                            parameters.margin_mm, parameters.overlap_mm));
  const int across = tiles_along(picture_mm.x, area.x, parameters.overlap_mm);
  const int down = tiles_along(picture_mm.y, area.y, parameters.overlap_mm);
  std::vector<PrintPage> pages;
  for (int row = 0; row < down; ++row)
    for (int column = 0; column < across; ++column) {
      const double left =
          column *
          (area.x -
           parameters.overlap_mm);  // of the tile in the picture, from its upper left corner
      const double top = row * (area.y - parameters.overlap_mm);
      const double width = std::min(area.x, picture_mm.x - left);
      const double height = std::min(area.y, picture_mm.y - top);
      PrintPage page;
      page.size_mm = paper;
      page.shown = {parameters.margin_mm, paper.y - parameters.margin_mm - height, width, height};
      page.trim = page.shown;
      page.picture = {page.shown.left - left, page.shown.bottom + height + top - picture_mm.y,
                      picture_mm.x, picture_mm.y};
      pages.push_back(page);
    }
  return pages;
}

std::vector<MarkLine> crop_marks(const PrintPage& page) {
  std::vector<MarkLine> lines;
  const double left = page.shown.left - mark_gap_mm;
  const double right = page.shown.left + page.shown.width + mark_gap_mm;
  const double bottom = page.shown.bottom - mark_gap_mm;
  const double top = page.shown.bottom + page.shown.height + mark_gap_mm;
  for (const double y : {page.trim.bottom, page.trim.bottom + page.trim.height}) {
    lines.push_back({{std::max(0.0, left - mark_mm), y}, {left, y}});
    lines.push_back({{right, y}, {std::min(page.size_mm.x, right + mark_mm), y}});
  }
  for (const double x : {page.trim.left, page.trim.left + page.trim.width}) {
    lines.push_back({{x, std::max(0.0, bottom - mark_mm)}, {x, bottom}});
    lines.push_back({{x, top}, {x, std::min(page.size_mm.y, top + mark_mm)}});
  }
  std::erase_if(lines, [](const MarkLine& line) {
    return line.to_mm.x <= line.from_mm.x && line.to_mm.y <= line.from_mm.y;
  });
  return lines;
}

namespace {

cairo_status_t append(void* to, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

[[noreturn]] void refuse(const std::string& path, GError* error) {
  const std::string reason = error != nullptr ? error->message : "for unknown reasons";
  if (error != nullptr) g_error_free(error);
  throw Error(ErrorKind::input, path, "cannot be read as SVG: " + reason,
              "an .svg file, as belvedere labels writes it");
}

}  // namespace

std::string svg_as_pdf(const std::string& path, glm::dvec2 size_mm) {
  require_file(path, "an .svg file, as belvedere labels writes it");
  GError* error = nullptr;
  const std::unique_ptr<RsvgHandle, void (*)(gpointer)> drawing(
      rsvg_handle_new_from_file(path.c_str(), &error), g_object_unref);
  if (drawing == nullptr) refuse(path, error);
  const glm::dvec2 size = size_mm * points_per_mm;
  std::string pdf;
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_pdf_surface_create_for_stream(append, &pdf, size.x, size.y), cairo_surface_destroy);
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> page(cairo_create(surface.get()),
                                                          cairo_destroy);
  const RsvgRectangle all = {0.0, 0.0, size.x, size.y};
  if (rsvg_handle_render_document(drawing.get(), page.get(), &all, &error) == 0)
    refuse(path, error);
  cairo_show_page(page.get());
  cairo_surface_finish(surface.get());
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw Error(ErrorKind::input, path,
                std::string("cannot be drawn: ") +
                    cairo_status_to_string(cairo_surface_status(surface.get())));
  return pdf;
}

}  // namespace belvedere
