#include "renderer/press/vector_page.h"

// The one file that uses librsvg, and with it cairo's PDF.
#include <cairo-pdf.h>
#include <librsvg/rsvg.h>

#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/text/missing_file.h"

namespace belvedere {
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
