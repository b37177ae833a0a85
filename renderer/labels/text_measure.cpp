#include "renderer/labels/text_measure.h"

#include <fontconfig/fontconfig.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "base/files/program_file.h"

namespace belvedere {
namespace {

template <class T>
struct Unref {
  void operator()(T* object) const { g_object_unref(object); }
};
template <class T>
using Owned = std::unique_ptr<T, Unref<T>>;
using Font = std::unique_ptr<PangoFontDescription, void (*)(PangoFontDescription*)>;

// Pango counts in 1024ths of a unit; a unit is a pixel here.
double pixels(int units) { return static_cast<double>(units) / PANGO_SCALE; }

Font font_of(const TextStyle& style) {
  Font font(pango_font_description_new(), &pango_font_description_free);
  pango_font_description_set_family(font.get(), style.family.c_str());
  pango_font_description_set_absolute_size(font.get(), style.size_px * PANGO_SCALE);
  pango_font_description_set_weight(font.get(), static_cast<PangoWeight>(style.weight));
  pango_font_description_set_style(font.get(),
                                   style.italic ? PANGO_STYLE_ITALIC : PANGO_STYLE_NORMAL);
  return font;
}

// Fonts of an installed program, or beside a module, once per process: they need not be known to
// the system.
void add_own_fonts() {
  static const bool added = [] {
    std::error_code missing;
    const std::filesystem::path bin =
        std::filesystem::canonical(program_file(), missing).parent_path();
    bool any = false;
    for (const std::filesystem::path& folder :
         {bin.parent_path() / "share/belvedere/fonts", bin / "fonts"})
      any =
          (std::filesystem::is_directory(folder, missing) &&
           FcConfigAppFontAddDir(nullptr, reinterpret_cast<const FcChar8*>(folder.c_str())) != 0) ||
          any;
    return any;
  }();
  static_cast<void>(added);
}

// Whether there are fonts of that family; empty: any at all.
bool any_fonts(const std::string& family) {
  add_own_fonts();
  FcPattern* wanted = FcPatternCreate();
  if (!family.empty())
    FcPatternAddString(wanted, FC_FAMILY, reinterpret_cast<const FcChar8*>(family.c_str()));
  FcObjectSet* nothing = FcObjectSetCreate();
  FcFontSet* fonts = FcFontList(nullptr, wanted, nothing);
  const bool any = fonts != nullptr && fonts->nfont > 0;
  if (fonts != nullptr) FcFontSetDestroy(fonts);
  FcObjectSetDestroy(nothing);
  FcPatternDestroy(wanted);
  return any;
}

}  // namespace

struct TextMeasure::State {
  Owned<PangoFontMap> fonts;
  Owned<PangoContext> context;
};

TextMeasure::TextMeasure() : state_(std::make_unique<State>()) {
  if (!any_fonts({}))
    throw Error(ErrorKind::input, "the system's fonts", "none is installed",
                "a package of fonts, such as fonts-ebgaramond");
  state_->fonts.reset(pango_cairo_font_map_new());
  state_->context.reset(pango_font_map_create_context(state_->fonts.get()));
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  pango_cairo_context_set_font_options(state_->context.get(), options);
  cairo_font_options_destroy(options);
  pango_context_set_round_glyph_positions(state_->context.get(), FALSE);
  // The set of letters of a font must not depend on the language of the user's terminal.
  pango_context_set_language(state_->context.get(), pango_language_from_string("en"));
}

TextMeasure::~TextMeasure() = default;

namespace {

Owned<PangoLayout> lay_out(PangoContext* context, const std::string& text, const TextStyle& style) {
  const Font font = font_of(style);
  Owned<PangoLayout> layout(pango_layout_new(context));
  pango_layout_set_font_description(layout.get(), font.get());
  pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
  PangoAttrList* attributes = pango_attr_list_new();
  // Figures of equal height: altitudes are read, not part of a sentence.
  pango_attr_list_insert(attributes, pango_attr_font_features_new("lnum=1"));
  if (style.spacing > 0.0)
    pango_attr_list_insert(attributes, pango_attr_letter_spacing_new(static_cast<int>(
                                           style.spacing * style.size_px * PANGO_SCALE)));
  pango_layout_set_attributes(layout.get(), attributes);
  pango_attr_list_unref(attributes);
  pango_layout_set_text(layout.get(), text.data(), static_cast<int>(text.size()));
  return layout;
}

// The outline of `count` glyphs of a run from glyph `from` on, relative to the first one's left end
// on the baseline.
Outline outline_of(cairo_t* cairo, PangoGlyphItem* run, int from, int count) {
  PangoGlyphString some = *run->glyphs;
  some.glyphs += from;
  some.log_clusters += from;
  some.num_glyphs = count;
  cairo_new_path(cairo);
  cairo_move_to(cairo, 0.0, 0.0);
  pango_cairo_glyph_string_path(cairo, run->item->analysis.font, &some);
  cairo_path_t* path = cairo_copy_path(cairo);
  Outline outline;
  for (int i = 0; i < path->num_data; i += path->data[i].header.length) {
    const cairo_path_data_t* data = path->data + i;
    const auto p = [&](int k) { return glm::dvec2(data[k].point.x, data[k].point.y); };
    switch (data->header.type) {
      case CAIRO_PATH_MOVE_TO:
        outline.push_back({OutlineStep::move, {p(1)}});
        break;
      case CAIRO_PATH_LINE_TO:
        outline.push_back({OutlineStep::line, {p(1)}});
        break;
      case CAIRO_PATH_CURVE_TO:
        outline.push_back({OutlineStep::curve, {p(1), p(2), p(3)}});
        break;
      case CAIRO_PATH_CLOSE_PATH:
        outline.push_back({OutlineStep::close, {}});
        break;
    }
  }
  cairo_path_destroy(path);
  // Moves without a following segment would paint dots in stroked outlines.
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (outline[i].kind != OutlineStep::move ||
        (i + 1 < outline.size() && outline[i + 1].kind != OutlineStep::move))
      kept.push_back(outline[i]);
  return kept;
}

}  // namespace

TextRoom TextMeasure::measure(const std::string& text, const TextStyle& style) const {
  const Owned<PangoLayout> layout = lay_out(state_->context.get(), text, style);
  PangoRectangle box;
  pango_layout_get_extents(layout.get(), nullptr, &box);
  const double up = pixels(pango_layout_get_baseline(layout.get()));
  return {pixels(box.width), up, pixels(box.height) - up};
}

std::vector<TextLetter> TextMeasure::letters(const std::string& text,
                                             const TextStyle& style) const {
  const Owned<PangoLayout> layout = lay_out(state_->context.get(), text, style);
  // Paths are collected on a surface of one pixel that nothing is painted on.
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_t* cairo = cairo_create(surface);
  cairo_set_tolerance(cairo, 0.01);
  std::vector<TextLetter> letters;
  const PangoLayoutLine* line = pango_layout_get_line_readonly(layout.get(), 0);
  // Runs are in visual order from left to right, and so are the glyphs in them; glyphs of one
  // cluster belong to the same letters of the text.
  for (const GSList* at = line->runs; at != nullptr; at = at->next) {
    auto* run = static_cast<PangoGlyphItem*>(at->data);
    const PangoGlyphString& glyphs = *run->glyphs;
    // Start of the letters of a cluster in the run's text; they end where those of the next cluster
    // begin, on either side.
    std::vector<int> begins(glyphs.log_clusters, glyphs.log_clusters + glyphs.num_glyphs);
    begins.push_back(run->item->length);
    std::sort(begins.begin(), begins.end());
    for (int i = 0; i < glyphs.num_glyphs;) {
      int end = i + 1;
      while (end < glyphs.num_glyphs && glyphs.log_clusters[end] == glyphs.log_clusters[i]) ++end;
      TextLetter letter;
      for (int k = i; k < end; ++k) letter.width_px += pixels(glyphs.glyphs[k].geometry.width);
      letter.outline = outline_of(cairo, run, i, end - i);
      const int from = glyphs.log_clusters[i];
      const int to = *std::upper_bound(begins.begin(), begins.end(), from);
      letter.text = text.substr(static_cast<std::size_t>(run->item->offset + from),
                                static_cast<std::size_t>(to - from));
      letters.push_back(std::move(letter));
      i = end;
    }
  }
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return letters;
}

bool TextMeasure::has_family(const std::string& families) {
  std::istringstream list(families);
  for (std::string family; std::getline(list >> std::ws, family, ',');)
    if (family == "serif" || family == "sans-serif" || family == "sans" || family == "monospace" ||
        any_fonts(family))
      return true;
  return false;
}

std::string capitals(const std::string& text) {
  std::string out;
  for (const char* at = text.c_str(); *at != '\0'; at = g_utf8_next_char(at)) {
    const gunichar letter = g_utf8_get_char(at);
    std::array<char, 6> bytes{};
    if (letter == 0xDF)
      out += "SS";
    else
      out.append(bytes.data(), static_cast<std::size_t>(
                                   g_unichar_to_utf8(g_unichar_toupper(letter), bytes.data())));
  }
  return out;
}

}  // namespace belvedere
