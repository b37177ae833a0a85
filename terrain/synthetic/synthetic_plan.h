#pragma once

#include <cstdint>

namespace belvedere::synthetic {

// The plan of a landscape: where mountains rise and where the main valleys run. Places in metres from the padded map's
// north-west corner, x east, y south; `unit_m` shrinks it for maps smaller than a mountain range.
class Plan {
 public:
  Plan(double height_m, double unit_m, std::uint64_t seed);

  int valleys() const { return valleys_; }
  bool flows_east(int valley) const;
  // The middle line of a main valley, y at x.
  double valley_y(int valley, double x) const;
  // How fast the ground rises, 0…about 1.5.
  float uplift(double x, double y) const;
  // Softness of the rock, about 0.4…2.
  float softness(double x, double y) const;

  std::uint64_t seed() const { return seed_; }
  double unit_m() const { return unit_m_; }

 private:
  double height_m_;
  double unit_m_;
  std::uint64_t seed_;
  int valleys_ = 1;
};

}  // namespace belvedere::synthetic
