#include "terrain/cover/map_cover.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "base/error.h"

namespace belvedere {
namespace {

constexpr double min_box_m = 20.0;
constexpr double max_boxes = 4e6;
// Reference point within a box, at coordinates that no edge of real data passes through exactly.
constexpr double sample_offset = 0.51234567891;

// Parity of the number of edges crossed by a path from `own` vertically and then horizontally to
// `place`. Ends count half open, so that a path through a vertex crosses the outline once.
bool crosses(const glm::dvec2& from, const glm::dvec2& to, glm::dvec2 own, glm::dvec2 position) {
  bool odd = false;
  if ((from.x <= own.x) != (to.x <= own.x)) {
    const double y = from.y + (own.x - from.x) * ((to.y - from.y) / (to.x - from.x));
    odd = (y <= own.y) != (y <= position.y);
  }
  if ((from.y <= position.y) != (to.y <= position.y)) {
    const double x = from.x + (position.y - from.y) * ((to.x - from.x) / (to.y - from.y));
    odd = odd != ((x <= own.x) != (x <= position.x));
  }
  return odd;
}

// Whether a position lies within a straight piece of river; a piece without width covers nothing.
bool covers(const glm::dvec2& from, const glm::dvec2& to, float half_from, float half_to,
            glm::dvec2 position) {
  const glm::dvec2 along = to - from;
  const glm::dvec2 off = position - from;
  const double length2 = std::max(glm::dot(along, along), 1e-12);
  const double t = std::clamp(glm::dot(off, along) / length2, 0.0, 1.0);
  const double half = (1.0 - t) * static_cast<double>(half_from) + t * static_cast<double>(half_to);
  const glm::dvec2 away = off - t * along;
  return glm::dot(away, away) < half * half;
}

double side_of_boxes(glm::dvec2 size, std::size_t pieces) {
  const double area = size.x * size.y;
  const double wanted = std::sqrt(area / std::max<double>(1.0, static_cast<double>(pieces)));
  return std::max({min_box_m, wanted, std::sqrt(area / max_boxes)});
}

}  // namespace

// Inserts shapes into boxes, one after the other from the lowest up.
struct MapCover::Filler {
  struct Placed {
    std::uint32_t box;
    Piece piece;
  };
  MapCover& to;
  std::vector<Placed> placed = {};
  std::vector<std::vector<double>> crossings = {};  // of one area, by row: crossings of its outline
                                                    // with the line through the reference points
  std::vector<std::uint32_t> touched_by =
      {};  // of a box: the last shape with an edge in it, and one

  int column(double x) const {
    return static_cast<int>(
        std::floor(std::clamp((x - to.low_.x) / to.box_m_, -1.0, to.columns_ + 1.0)));
  }
  int row(double y) const {
    return static_cast<int>(
        std::floor(std::clamp((y - to.low_.y) / to.box_m_, -1.0, to.rows_ + 1.0)));
  }
  std::uint32_t box(int x, int y) const {
    return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(to.columns_) +
           static_cast<std::uint32_t>(x);
  }

  void put(int x, int y, std::uint32_t shape, std::uint32_t edge) {
    const std::uint32_t at = box(x, y);
    placed.push_back({at, {shape, edge}});
    touched_by[at] = shape + 1;
  }

  void add_edge(glm::dvec2 from, glm::dvec2 to_position, std::uint32_t shape) {
    const glm::dvec2 low = glm::min(from, to_position);
    const glm::dvec2 high = glm::max(from, to_position);
    const int y0 = std::max(0, row(low.y));
    const int y1 = std::min(to.rows_ - 1, row(high.y));
    std::uint32_t edge = own_position;
    for (int y = y0; y <= y1; ++y) {
      const double own_y = to.position_of(0, y).y;
      if ((from.y <= own_y) != (to_position.y <= own_y))
        crossings[static_cast<std::size_t>(y)].push_back(
            from.x + (own_y - from.y) * ((to_position.x - from.x) / (to_position.y - from.y)));
      // The part of the edge in this row, slightly extended for rounding.
      double x0 = low.x;
      double x1 = high.x;
      if (high.y > low.y) {
        const double slope = (to_position.x - from.x) / (to_position.y - from.y);
        const double margin = 1e-6 * to.box_m_;
        const double bottom = std::max(low.y, to.low_.y + y * to.box_m_ - margin);
        const double top = std::min(high.y, to.low_.y + (y + 1) * to.box_m_ + margin);
        const double a = from.x + (bottom - from.y) * slope;
        const double b = from.x + (top - from.y) * slope;
        x0 = std::max(low.x, std::min(a, b) - margin);
        x1 = std::min(high.x, std::max(a, b) + margin);
      }
      for (int x = std::max(0, column(x0)); x <= std::min(to.columns_ - 1, column(x1)); ++x) {
        if (edge == own_position) {
          edge = static_cast<std::uint32_t>(to.edges_.size());
          to.edges_.push_back({from, to_position, 0.F, 0.F});
        }
        put(x, y, shape, edge);
      }
    }
  }

  void add(const CoverArea& area) {
    const auto shape = static_cast<std::uint32_t>(to.shapes_.size());
    to.shapes_.push_back({area.painted_as, area.still, false});
    double bottom = 0.0;
    double top = -1.0;
    for (const auto& ring : area.rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 from = ring[i];
        bottom = top < bottom ? from.y : std::min(bottom, from.y);
        top = top < bottom ? from.y : std::max(top, from.y);
        add_edge(from, ring[(i + 1) % ring.size()], shape);
      }
    // Between two crossings in a row, boxes without an edge lie entirely in the area.
    for (int y = std::max(0, row(bottom)); y <= std::min(to.rows_ - 1, row(top)); ++y) {
      std::vector<double>& at = crossings[static_cast<std::size_t>(y)];
      std::sort(at.begin(), at.end());
      for (std::size_t k = 0; k + 1 < at.size(); k += 2)
        for (int x = std::max(0, column(at[k])); x <= std::min(to.columns_ - 1, column(at[k + 1]));
             ++x) {
          const double own_x = to.position_of(x, y).x;
          if (own_x < at[k] || own_x >= at[k + 1]) continue;
          if (touched_by[box(x, y)] == shape + 1)
            placed.push_back({box(x, y), {shape, own_position}});
          else
            to.full_[box(x, y)] = static_cast<std::int32_t>(shape);
        }
      at.clear();
    }
  }

  void add(const CoverRiver& centreline) {
    const auto shape = static_cast<std::uint32_t>(to.shapes_.size());
    to.shapes_.push_back({centreline.painted_as, false, true});
    for (std::size_t i = 0; i + 1 < centreline.positions.size(); ++i) {
      const Edge edge = {centreline.positions[i], centreline.positions[i + 1],
                         centreline.half_width_m[i], centreline.half_width_m[i + 1]};
      const double reach = std::max(edge.half_from, edge.half_to);
      const glm::dvec2 low = glm::min(edge.from, edge.to) - reach;
      const glm::dvec2 high = glm::max(edge.from, edge.to) + reach;
      bool kept = false;
      for (int y = std::max(0, row(low.y)); y <= std::min(to.rows_ - 1, row(high.y)); ++y)
        for (int x = std::max(0, column(low.x)); x <= std::min(to.columns_ - 1, column(high.x));
             ++x) {
          if (!kept) to.edges_.push_back(edge);
          kept = true;
          put(x, y, shape, static_cast<std::uint32_t>(to.edges_.size() - 1));
        }
    }
  }

  // Pieces by box; those under an area that covers the whole box are never visited.
  void finish() {
    const auto is_seen = [&](const Placed& p) {
      return to.full_[p.box] < static_cast<std::int32_t>(p.piece.shape);
    };
    to.first_.assign(to.full_.size() + 1, 0);
    for (const Placed& p : placed)
      if (is_seen(p)) ++to.first_[p.box + 1];
    std::partial_sum(to.first_.begin(), to.first_.end(), to.first_.begin());
    to.pieces_.resize(to.first_.back());
    std::vector<std::uint32_t> next(to.first_.begin(), to.first_.end() - 1);
    for (const Placed& p : placed)
      if (is_seen(p)) to.pieces_[next[p.box]++] = p.piece;
  }
};

MapCover::MapCover(const std::vector<CoverArea>& areas, std::vector<CoverRiver> centrelines,
                   glm::dvec2 low, glm::dvec2 high)
    : centrelines_(std::move(centrelines)), low_(low), high_(high) {
  if (!(high.x > low.x && high.y > low.y))
    throw Error(ErrorKind::bug, "the cover of a map", "the ground has no extent");
  struct Ranked {
    double rank;
    const CoverArea* area;
    const CoverRiver* centreline;
  };
  std::vector<Ranked> order;
  std::size_t pieces = 1;
  for (const CoverArea& area : areas) {
    order.push_back({area.rank, &area, nullptr});
    for (const auto& ring : area.rings) pieces += ring.size();
  }
  for (const CoverRiver& centreline : centrelines_) {
    if (centreline.half_width_m.size() != centreline.positions.size())
      throw Error(ErrorKind::bug, "the cover of a map", "a river lacks a width for each position");
    order.push_back({centreline.rank, nullptr, &centreline});
    pieces += centreline.positions.size();
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const Ranked& a, const Ranked& b) { return a.rank < b.rank; });

  box_m_ = side_of_boxes(high - low, pieces);
  columns_ = static_cast<int>(std::ceil((high.x - low.x) / box_m_));
  rows_ = static_cast<int>(std::ceil((high.y - low.y) / box_m_));
  full_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), none);
  Filler filler{*this};
  filler.crossings.resize(static_cast<std::size_t>(rows_));
  filler.touched_by.assign(full_.size(), 0);
  for (const Ranked& one : order) {
    if (one.area != nullptr)
      filler.add(*one.area);
    else
      filler.add(*one.centreline);
  }
  filler.finish();
}

glm::dvec2 MapCover::position_of(int column, int row) const {
  return low_ + box_m_ * glm::dvec2(column + sample_offset, row + sample_offset);
}

std::int32_t MapCover::find(glm::dvec2 position, bool areas_alone) const {
  const double x = (position.x - low_.x) / box_m_;
  const double y = (position.y - low_.y) / box_m_;
  if (!(x >= 0.0 && y >= 0.0 && position.x < high_.x && position.y < high_.y)) return none;
  const int column = std::min(static_cast<int>(x), columns_ - 1);
  const int row = std::min(static_cast<int>(y), rows_ - 1);
  const std::size_t box = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column);
  const glm::dvec2 own = position_of(column, row);
  // From the topmost shape down.
  for (std::uint32_t i = first_[box + 1]; i > first_[box];) {
    const std::uint32_t shape = pieces_[i - 1].shape;
    const bool is_river_line = shapes_[shape].is_river_line;
    bool inside = false;
    if (is_river_line && areas_alone) {
      while (i > first_[box] && pieces_[i - 1].shape == shape) --i;
      continue;
    }
    for (; i > first_[box] && pieces_[i - 1].shape == shape; --i) {
      const std::uint32_t number = pieces_[i - 1].edge;
      if (number == own_position) {
        inside = !inside;
        continue;
      }
      const Edge& edge = edges_[number];
      if (is_river_line)
        inside = inside || covers(edge.from, edge.to, edge.half_from, edge.half_to, position);
      else
        inside = inside != crosses(edge.from, edge.to, own, position);
    }
    if (inside) return static_cast<std::int32_t>(shape);
  }
  return full_[box];
}

LandCoverClass MapCover::at(glm::dvec2 position) const {
  const std::int32_t shape = find(position);
  return shape == none ? LandCoverClass::sky : shapes_[static_cast<std::size_t>(shape)].painted_as;
}

bool MapCover::is_still(glm::dvec2 position) const {
  const std::int32_t shape = find(position, true);
  return shape != none && shapes_[static_cast<std::size_t>(shape)].still;
}

std::size_t MapCover::bytes() const {
  std::size_t of_rivers = 0;
  for (const CoverRiver& centreline : centrelines_)
    of_rivers += centreline.positions.capacity() * sizeof(glm::dvec2) +
                 centreline.half_width_m.capacity() * sizeof(float);
  return of_rivers + shapes_.capacity() * sizeof(Shape) + edges_.capacity() * sizeof(Edge) +
         full_.capacity() * sizeof(std::int32_t) + first_.capacity() * sizeof(std::uint32_t) +
         pieces_.capacity() * sizeof(Piece);
}

}  // namespace belvedere
