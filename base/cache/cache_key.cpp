#include "base/cache/cache_key.h"

#include <fmt/core.h>

namespace belvedere {

void CacheKeyText::put(double number) { text_ += fmt::format("{:a}", number); }

// With its length, so that one text cannot be read as two values.
void CacheKeyText::put(std::string_view text) {
  text_ += fmt::format("{}\"{}\"", text.size(), text);
}

void CacheKeyText::put_grid(int width, int height, std::string_view cells) {
  text_ += fmt::format("{}x{} {}", width, height, hash_bytes(cells));
}

}  // namespace belvedere
