#include "renderer/labels/text_measure.h"

#include <fontconfig/fontconfig.h>
#include <pango/pangocairo.h>

#include "base/error.h"

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
  pango_font_description_set_weight(font.get(), style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_style(font.get(), style.italic ? PANGO_STYLE_ITALIC : PANGO_STYLE_NORMAL);
  return font;
}

bool any_fonts() {
  FcPattern* everything = FcPatternCreate();
  FcObjectSet* nothing = FcObjectSetCreate();
  FcFontSet* fonts = FcFontList(nullptr, everything, nothing);
  const bool any = fonts != nullptr && fonts->nfont > 0;
  if (fonts != nullptr) FcFontSetDestroy(fonts);
  FcObjectSetDestroy(nothing);
  FcPatternDestroy(everything);
  return any;
}

}  // namespace

struct TextMeasure::State {
  Owned<PangoFontMap> fonts;
  Owned<PangoContext> context;
};

TextMeasure::TextMeasure() : state_(std::make_unique<State>()) {
  if (!any_fonts()) throw Error(ErrorKind::input, "the system's fonts", "there are none", "a package of fonts, fonts-ebgaramond for one");
  state_->fonts.reset(pango_cairo_font_map_new());
  state_->context.reset(pango_font_map_create_context(state_->fonts.get()));
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  pango_cairo_context_set_font_options(state_->context.get(), options);
  cairo_font_options_destroy(options);
  pango_context_set_round_glyph_positions(state_->context.get(), FALSE);
  // Which letters a font has must not hang on the language of the user's terminal.
  pango_context_set_language(state_->context.get(), pango_language_from_string("en"));
}

TextMeasure::~TextMeasure() = default;

TextRoom TextMeasure::measure(const std::string& text, const TextStyle& style) const {
  const Font font = font_of(style);
  const Owned<PangoLayout> layout(pango_layout_new(state_->context.get()));
  pango_layout_set_font_description(layout.get(), font.get());
  pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
  if (style.spacing > 0.0) {
    PangoAttrList* attributes = pango_attr_list_new();
    pango_attr_list_insert(attributes, pango_attr_letter_spacing_new(static_cast<int>(style.spacing * style.size_px * PANGO_SCALE)));
    pango_layout_set_attributes(layout.get(), attributes);
    pango_attr_list_unref(attributes);
  }
  pango_layout_set_text(layout.get(), text.data(), static_cast<int>(text.size()));
  PangoRectangle box;
  pango_layout_get_extents(layout.get(), nullptr, &box);
  const double up = pixels(pango_layout_get_baseline(layout.get()));
  return {pixels(box.width), up, pixels(box.height) - up};
}

std::string TextMeasure::family_of(const TextStyle& style) const {
  const Font font = font_of(style);
  const Owned<PangoFont> loaded(pango_context_load_font(state_->context.get(), font.get()));
  if (loaded == nullptr) return {};
  const Font found(pango_font_describe(loaded.get()), &pango_font_description_free);
  return pango_font_description_get_family(found.get());
}

}  // namespace belvedere
