#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace belvedere {

// A rectangle in millimetres from the lower left corner of a page, as in PDF.
struct MmBox {
  double left = 0.0;
  double bottom = 0.0;
  double width = 0.0;
  double height = 0.0;
};

struct PageParameters {
  double bleed_mm = 0.0;  // 0…50, the edge of the picture that is cut away: the trimmed sheet is
                          // smaller by twice this
  bool marks = false;     // crop marks at the corners of the trimmed sheet
  std::optional<glm::dvec2> paper_mm =
      {};  // tiles over pages of this size; absent: one page for all
  double margin_mm =
      10.0;  // around each tile, 0…100: the printer's unprintable border, and room for marks
  double overlap_mm = 10.0;  // of tiles that are glued, 0…100
};

struct PrintPage {
  glm::dvec2 size_mm{0.0};  // of the page
  MmBox picture;            // position of the whole picture, parts of it beyond the page
  MmBox shown;              // printed part of it, with bleed
  MmBox trim;               // the part that remains after trimming
};

// Pages that the picture is printed on: one, or tiles row by row from the upper left, all of the
// same size. Error(usage) for bleed together with tiles, for tiles without room, and for pages over
// 5080 mm, the limit of PDF.
std::vector<PrintPage> plan_pages(glm::dvec2 picture_mm, const PageParameters& parameters);

// Lines of crop marks: from and to. They begin 2 mm outside the bleed and are 5 mm long, where the
// page has room.
struct MarkLine {
  glm::dvec2 from_mm;
  glm::dvec2 to_mm;
};
std::vector<MarkLine> crop_marks(const PrintPage& page);

constexpr double points_per_mm = 72.0 / 25.4;

// An SVG file as one page of PDF of that size, its drawing stretched over it: text and lines stay
// vectors, fonts are embedded. Error(input) where it is missing or not SVG.
std::string svg_as_pdf(const std::string& path, glm::dvec2 size_mm);

}  // namespace belvedere
