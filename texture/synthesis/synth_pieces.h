#pragma once

#include <cstdint>
#include <vector>

#include "texture/synthesis/synth_plane.h"

namespace belvedere::synth {

// Pieces: 4-connected pixels that copy from the exemplar with the same offset. Large pieces are
// visible as verbatim copies.
class Pieces {
 public:
  explicit Pieces(const Plane& target)
      : parent_(target.words.size(), 0), size_(target.words.size(), 0) {}

  // Finds the pieces of a match field (by target index). The same for any number of threads: the id
  // of a piece is its first pixel. fixed: by target index, nowhere for a free pixel; null: all are
  // free.
  void find(const Plane& target, const Plane& exemplars, const std::vector<std::uint32_t>& match,
            const std::uint32_t* fixed = nullptr);
  // Pixels of the piece that contains a pixel, at most 65535. In a piece with fixed pixels the free
  // ones count twice: as many may be added independently beyond the fixed ones, and the piece must
  // stay within the cap with both.
  const std::vector<std::uint16_t>& size() const { return size_; }
  std::uint32_t first_pixel(std::uint32_t pixel) const;
  std::uint32_t largest() const { return largest_; }

 private:
  std::uint32_t root(std::uint32_t pixel);
  void unite(std::uint32_t a, std::uint32_t b);

  std::vector<std::int32_t> parent_;  // a root holds minus its size
  std::vector<std::uint16_t> size_;
  std::vector<std::uint32_t>
      fixed_count_;  // of the piece, at its first pixel; empty: nothing is fixed
  std::uint32_t largest_ = 0;
};

// Irregular cells that divide large pieces: the Voronoi cells of one jittered point in each square
// of 14 pixels.
inline constexpr int cell_side = 14;
struct Cell {
  int x = 0;  // of the square that contains the cell's point
  int y = 0;
  int odd = 0;  // colour of the square on a checkerboard, 0 or 1
};
Cell cell_around(int x, int y, std::uint64_t key);

}  // namespace belvedere::synth
