#include "cli/study/letters.hpp"

#include <fontconfig/fontconfig.h>
#include <map>
#include <memory>

namespace taut::cli {
namespace {

bool some_font_has(FcChar32 letter) {
  const std::unique_ptr<FcCharSet, decltype(&FcCharSetDestroy)> letters(FcCharSetCreate(), FcCharSetDestroy);
  const std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)> pattern(FcPatternCreate(), FcPatternDestroy);
  const std::unique_ptr<FcObjectSet, decltype(&FcObjectSetDestroy)> nothing(FcObjectSetCreate(),
                                                                            FcObjectSetDestroy);
  FcCharSetAddChar(letters.get(), letter);
  FcPatternAddCharSet(pattern.get(), FC_CHARSET, letters.get());
  const std::unique_ptr<FcFontSet, decltype(&FcFontSetDestroy)> fonts(
      FcFontList(nullptr, pattern.get(), nothing.get()), FcFontSetDestroy);
  return fonts && fonts->nfont > 0;
}

}  // namespace

std::string with_letters_of_fonts(std::string_view text) {
  constexpr FcChar32 first_beyond_ascii = 0x80;
  std::map<FcChar32, bool> known;
  std::string drawable;
  while (!text.empty()) {
    FcChar32 letter = 0;
    const int bytes =
        FcUtf8ToUcs4(reinterpret_cast<const FcChar8*>(text.data()), &letter, static_cast<int>(text.size()));
    const std::string_view one = text.substr(0, bytes > 0 ? static_cast<std::size_t>(bytes) : 1);
    text.remove_prefix(one.size());
    if (bytes > 0 && letter >= first_beyond_ascii) {
      const auto [found, fresh] = known.try_emplace(letter, true);
      if (fresh) found->second = some_font_has(letter);
      drawable += found->second ? one : "□";
    } else {
      drawable += one;
    }
  }
  return drawable;
}

}  // namespace taut::cli
