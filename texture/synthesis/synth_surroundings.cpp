#include "texture/synthesis/synth_surroundings.h"

#include <atomic>
#include <string>
#include <unordered_map>

#include "base/parallel.h"

namespace belvedere::synth {

namespace {

// Calls f(index, window, total) for every pixel of a band of rows, with the counts of its
// neighbourhood by class and their sum. Counts by column slide down, counts of the window slide
// along the row: the cost per pixel is 2 columns times the number of classes.
constexpr int band = 64;
template <class F>
void for_each_neighbourhood(const Plane& plane, int part_number, int b, int radius,
                            std::size_t kinds, F&& f) {
  const Plane::Part& part = plane.parts[static_cast<std::size_t>(part_number)];
  const int height = part.height;
  const int width = part.width;
  std::vector<std::uint16_t> columns(static_cast<std::size_t>(width) * kinds, 0);
  const auto add_row = [&](int y, int sign) {
    if (y < 0 || y >= height) return;
    const std::uint32_t row = plane.index(part_number, 0, y);
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
      const std::uint32_t c = class_of(plane.words[row + x]);
      if (c != no_class)
        columns[x * kinds + c] = static_cast<std::uint16_t>(columns[x * kinds + c] + sign);
    }
  };
  for (int y = b * band - radius; y < b * band + radius; ++y) add_row(y, 1);
  std::vector<std::int32_t> window(kinds);
  for (int y = b * band; y < std::min(height, (b + 1) * band); ++y) {
    add_row(y + radius, 1);
    std::fill(window.begin(), window.end(), 0);
    std::int32_t total = 0;
    const auto add_column = [&](int x, int sign) {
      if (x < 0 || x >= width) return;
      for (std::size_t c = 0; c < kinds; ++c) {
        const std::int32_t count = sign * columns[static_cast<std::size_t>(x) * kinds + c];
        window[c] += count;
        total += count;
      }
    };
    for (int x = -radius; x < radius; ++x) add_column(x, 1);
    for (int x = 0; x < width; ++x) {
      add_column(x + radius, 1);
      f(plane.index(part_number, x, y), window, total);
      add_column(x - radius, -1);
    }
    add_row(y - radius, -1);
  }
}

int bands_of(const Plane::Part& part) { return (part.height + band - 1) / band; }

}  // namespace

std::vector<Surroundings> make_surroundings(const Plane& plane, int radius, int classes) {
  std::vector<Surroundings> out(plane.words.size());
  const std::size_t kinds = static_cast<std::size_t>(classes);
  for (int p = 0; p < static_cast<int>(plane.parts.size()); ++p) {
    parallel_rows(bands_of(plane.parts[static_cast<std::size_t>(p)]), [&](int b) {
      for_each_neighbourhood(
          plane, p, b, radius, kinds,
          [&](std::uint32_t at, const std::vector<std::int32_t>& window, std::int32_t total) {
            const std::uint32_t own = class_of(plane.words[at]);
            if (own == no_class || window[own] >= total) return;
            std::uint32_t commonest = own == 0 ? 1U : 0U;
            for (std::uint32_t c = 0; c < kinds; ++c) {
              if (c != own && window[c] > window[commonest]) commonest = c;
            }
            out[at] = {static_cast<std::uint8_t>(255 * (total - window[own]) / total),
                       static_cast<std::uint8_t>(commonest)};
          });
    });
  }
  return out;
}

ClassShares::ClassShares(const Plane& plane, int radius, int classes) : classes_(classes) {
  numbers_.resize(plane.words.size());
  for (int step = 1; !number_kinds(plane, radius, step); step *= 2) {
  }
}

// Each band numbers its kinds; then they are merged in the order of bands, so that the numbers do
// not depend on threads.
bool ClassShares::number_kinds(const Plane& plane, int radius, int step) {
  constexpr std::size_t max = 65535;
  const std::size_t classes = static_cast<std::size_t>(classes_);
  using Numbers = std::unordered_map<std::string, std::size_t>;
  std::vector<std::pair<int, int>> bands;
  for (int p = 0; p < static_cast<int>(plane.parts.size()); ++p)
    for (int b = 0; b < bands_of(plane.parts[static_cast<std::size_t>(p)]); ++b)
      bands.emplace_back(p, b);
  std::vector<std::vector<std::string>> met(bands.size());
  std::atomic<bool> fits = true;
  const auto numbered = [](std::size_t number) {
    return Surroundings{static_cast<std::uint8_t>(number & 255U),
                        static_cast<std::uint8_t>(number >> 8)};
  };
  parallel_rows(static_cast<int>(bands.size()), [&](int i) {
    std::vector<std::string>& kinds = met[static_cast<std::size_t>(i)];
    Numbers numbers;
    std::string key(classes, 0);
    const auto& [p, b] = bands[static_cast<std::size_t>(i)];
    for_each_neighbourhood(
        plane, p, b, radius, classes,
        [&](std::uint32_t at, const std::vector<std::int32_t>& window, std::int32_t total) {
          if (class_of(plane.words[at]) == no_class || kinds.size() > max) return;
          for (std::size_t c = 0; c < classes; ++c) {
            const std::int32_t share = (2 * steps * window[c] / step + total) / (2 * total) * step;
            key[c] = static_cast<char>(static_cast<std::uint8_t>(share * 255 / steps));
          }
          const auto [found, is_new] = numbers.try_emplace(key, kinds.size());
          if (is_new) kinds.push_back(key);
          numbers_[at] = numbered(found->second);
        });
    if (kinds.size() > max) fits = false;
  });
  if (!fits) return false;
  Numbers joined;
  shares_.clear();
  std::vector<std::vector<Surroundings>> to(bands.size());
  for (std::size_t i = 0; i < bands.size(); ++i) {
    for (const std::string& kind : met[i]) {
      const auto [found, is_new] = joined.try_emplace(kind, joined.size());
      if (is_new) shares_.insert(shares_.end(), kind.begin(), kind.end());
      to[i].push_back(numbered(found->second));
    }
    if (joined.size() > max) return false;
  }
  parallel_rows(static_cast<int>(bands.size()), [&](int i) {
    const auto& [p, b] = bands[static_cast<std::size_t>(i)];
    const Plane::Part& part = plane.parts[static_cast<std::size_t>(p)];
    for (int y = b * band; y < std::min(part.height, (b + 1) * band); ++y) {
      for (int x = 0; x < part.width; ++x) {
        const std::uint32_t at = plane.index(p, x, y);
        Surroundings& number = numbers_[at];
        if (class_of(plane.words[at]) == no_class)
          number = {};
        else
          number =
              to[static_cast<std::size_t>(i)][number.others + std::size_t{256} * number.commonest];
      }
    }
  });
  if (shares_.empty()) shares_.assign(classes, 0);
  shares_.resize(std::max(shares_.size(), classes));
  return true;
}

std::int64_t shares_cost(const std::uint8_t* requested, const std::uint8_t* offered,
                         const SurroundingsPrice& price, int classes) {
  if (requested == offered) return 0;
  const std::size_t count = static_cast<std::size_t>(classes);
  std::int64_t sum = 0;
  std::int32_t squares = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t off = requested[k] - offered[k];
    squares += off * off;
  }
  sum = std::int64_t{16} * squares;
  for (std::size_t k = 0; !price.all_dissimilar() && k < count; ++k) {
    for (std::size_t l = 0; l < k; ++l)
      sum += std::int64_t{2} * (16 - price.pairs()[k * count + l]) * (requested[k] - offered[k]) *
             (requested[l] - offered[l]);
  }
  return std::max<std::int64_t>(0, sum) * price.weight_q8() >> 12;
}

}  // namespace belvedere::synth
