#include "report/fonts.h"

#include <fontconfig/fontconfig.h>

#include <memory>

#include "core/visible_text.h"

namespace fathom {
namespace {

bool has_glyph(char32_t code) {
  if (code < 0x80) return true;
  const std::unique_ptr<FcCharSet, decltype(&FcCharSetDestroy)> characters(FcCharSetCreate(), FcCharSetDestroy);
  const std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)> pattern(FcPatternCreate(), FcPatternDestroy);
  const std::unique_ptr<FcObjectSet, decltype(&FcObjectSetDestroy)> nothing(FcObjectSetCreate(), FcObjectSetDestroy);
  FcCharSetAddChar(characters.get(), code);
  FcPatternAddCharSet(pattern.get(), FC_CHARSET, characters.get());
  const std::unique_ptr<FcFontSet, decltype(&FcFontSetDestroy)> fonts(FcFontList(nullptr, pattern.get(), nothing.get()),
                                                                      FcFontSetDestroy);
  return fonts && fonts->nfont > 0;
}

}  // namespace

std::string drawable_text(std::string_view text) { return on_one_line(text, has_glyph); }

}  // namespace fathom
