#pragma once

namespace belvedere {

// A rectangle of pixels, half open: x0 <= x < x1.
struct PixelRect {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  bool operator==(const PixelRect&) const = default;
};

inline PixelRect intersection(const PixelRect& a, const PixelRect& b) {
  return {a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0, a.x1 < b.x1 ? a.x1 : b.x1,
          a.y1 < b.y1 ? a.y1 : b.y1};
}

// A rectangle grown by `margin` on all sides.
inline PixelRect grown(const PixelRect& rect, int margin) {
  return {rect.x0 - margin, rect.y0 - margin, rect.x1 + margin, rect.y1 + margin};
}

inline PixelRect moved(const PixelRect& rect, int x, int y) {
  return {rect.x0 + x, rect.y0 + y, rect.x1 + x, rect.y1 + y};
}

}  // namespace belvedere
