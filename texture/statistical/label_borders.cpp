#include "texture/statistical/label_borders.h"

namespace belvedere {

Grid<std::uint8_t> widened(const Grid<std::uint8_t>& mask, int px) {
  const auto along = [px](const Grid<std::uint8_t>& from, bool rows) {
    Grid<std::uint8_t> to(from.width(), from.height());
    const int length = rows ? from.width() : from.height();
    for (int line = 0; line < (rows ? from.height() : from.width()); ++line) {
      const auto at = [&](int i) { return rows ? from.index(i, line) : from.index(line, i); };
      int last = -px - 1;  // marked pixel before
      for (int i = 0; i < length; ++i) {
        if (from[at(i)] != 0) last = i;
        if (i - last <= px) to[at(i)] = 1;
      }
      int next = length + px;
      for (int i = length - 1; i >= 0; --i) {
        if (from[at(i)] != 0) next = i;
        if (next - i <= px) to[at(i)] = 1;
      }
    }
    return to;
  };
  return along(along(mask, true), false);
}

Grid<std::uint8_t> near_borders(const Grid<std::uint8_t>& labels, int px) {
  Grid<std::uint8_t> border(labels.width(), labels.height());
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const std::uint8_t own = labels(x, y);
      const auto other = [&](int u, int v) {
        const std::uint8_t label = labels.clamped(u, v);
        return label != own && label != no_label;
      };
      const bool is = own != no_label &&
                      (other(x - 1, y) || other(x + 1, y) || other(x, y - 1) || other(x, y + 1));
      border(x, y) = is ? 1 : 0;
    }
  return px <= 1 ? border : widened(border, px - 1);
}

}  // namespace belvedere
