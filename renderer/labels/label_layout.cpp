#include "renderer/labels/label_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "renderer/labels/drawing.h"

namespace belvedere {
namespace {

// A possible position of a name. Smaller costs come first.
struct Candidate {
  LabelBox text;
  const BentRoom* bent = nullptr;
  bool has_leader = false;
  glm::dvec2 leader_end{0.0};
  double cost = 0.0;
};

LabelBox grown(const LabelBox& box, double by) {
  return {box.left - by, box.top - by, box.right + by, box.bottom + by};
}

// Whether a text, for a curved name one of its letters, overlaps a box or is nearer to it than
// `by`.
bool lies_over(const Candidate& a, double by, const LabelBox& box) {
  if (!grown(a.text, by).overlaps(box)) return false;
  if (a.bent == nullptr) return true;
  return std::any_of(a.bent->letters.begin(), a.bent->letters.end(),
                     [&](const LabelBox& letter) { return grown(letter, by).overlaps(box); });
}

bool texts_overlap(const Candidate& a, const Candidate& b, double by) {
  if (!grown(a.text, by).overlaps(b.text)) return false;
  if (b.bent == nullptr) return lies_over(a, by, b.text);
  return std::any_of(b.bent->letters.begin(), b.bent->letters.end(),
                     [&](const LabelBox& letter) { return lies_over(a, by, letter); });
}

LabelBox mark_box(const LabelRequest& request) {
  const double r = .5 * request.mark_px;
  return {request.mark.x - r, request.mark.y - r, request.mark.x + r, request.mark.y + r};
}

// A leader as a box of no width: it may touch only its own mark and text.
LabelBox leader_box(const LabelRequest& request, glm::dvec2 end) {
  return {std::min(request.mark.x, end.x) - .5, std::min(request.mark.y, end.y),
          std::max(request.mark.x, end.x) + .5,
          std::max(request.mark.y - .5 * request.mark_px, end.y)};
}

double side_of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// A point on a line lies on its positive side, so that a bend is crossed once.
bool segments_cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  return (side_of(a, b, c) >= 0.0) != (side_of(a, b, d) >= 0.0) &&
         (side_of(c, d, a) >= 0.0) != (side_of(c, d, b) >= 0.0);
}

// Whether a segment has a point in a box: an end, or it crosses a diagonal.
bool enters(glm::dvec2 a, glm::dvec2 b, const LabelBox& box) {
  const auto has = [&](glm::dvec2 p) {
    return p.x > box.left && p.x < box.right && p.y > box.top && p.y < box.bottom;
  };
  return has(a) || has(b) || segments_cross(a, b, {box.left, box.top}, {box.right, box.bottom}) ||
         segments_cross(a, b, {box.left, box.bottom}, {box.right, box.top});
}

class Layout {
 public:
  Layout(const std::vector<LabelRequest>& requests, const std::vector<double>& skyline_px,
         const LabelLayoutParameters& parameters,
         const std::vector<std::vector<glm::dvec2>>& barriers)
      : requests_(requests),
        skyline_px_(skyline_px),
        p_(parameters),
        barriers_(barriers),
        chosen_(requests.size()) {
    for (const LabelRequest& request : requests_) candidates_.push_back(candidates_of(request));
  }

  std::vector<LabelSpot> run() {
    std::vector<std::size_t> order(requests_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return order_of(requests_[a]) < order_of(requests_[b]);
    });
    std::vector<LabelSpot> spots(requests_.size());
    for (const std::size_t i : order) {
      if (requests_[i].by_hand_px) {
        if (!candidates_[i].empty()) chosen_[i] = candidates_[i].front();
        continue;
      }
      spots[i].crowded = is_crowded(i);
      if (!spots[i].crowded && !place_free(i)) place_by_moving_one(i);
    }
    for (std::size_t i = 0; i < spots.size(); ++i)
      if (const std::optional<Candidate>& c = chosen_[i]) {
        spots[i] = {.placed = true,
                    .text = c->text,
                    .has_leader = c->has_leader,
                    .leader_end = c->leader_end};
        if (c->bent != nullptr) {
          spots[i].letters = c->bent->letters;
          spots[i].baseline = c->bent->baseline;
        }
      }
    return spots;
  }

 private:
  static double order_of(const LabelRequest& request) {
    return request.by_hand_px ? -1.0 : request.rank;
  }

  // All candidates of a request, best first.
  std::vector<Candidate> candidates_of(const LabelRequest& request) const {
    std::vector<Candidate> all;
    if (!request.bent.empty()) {
      add_bent(request, all);
      return all;
    }
    if (request.mark.x < 0.0 || request.mark.y < 0.0 || request.mark.x > p_.width_px ||
        request.mark.y > p_.height_px)
      return all;
    if (request.by_hand_px) {
      all.push_back(by_hand(request));
      return all;
    }
    switch (request.position) {
      case LabelPlace::above:
        request.on_skyline ? add_rows(request, all) : add_above(request, all);
        break;
      case LabelPlace::beside:
        request.area_px > 0.0 ? add_beside_area(request, all) : add_around(request, all);
        break;
      case LabelPlace::over:
        for (const double dy : {0.0, -.6, .6, -1.2, 1.2})
          for (const double dx : {0.0, -.35, .35})
            add(request, request.mark.x + dx * request.width_px,
                request.mark.y + (dy + .5) * request.height_px, std::abs(dy) + std::abs(dx), all);
        break;
      case LabelPlace::on:
        add_on(request, all);
        break;
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    return all;
  }

  void add_bent(const LabelRequest& request, std::vector<Candidate>& all) const {
    for (const BentRoom& bent : request.bent) {
      if (bent.letters.empty()) continue;
      LabelBox box = bent.letters.front();
      for (const LabelBox& letter : bent.letters)
        box = {std::min(box.left, letter.left), std::min(box.top, letter.top),
               std::max(box.right, letter.right), std::max(box.bottom, letter.bottom)};
      if (is_inside(box))
        all.push_back({.text = box, .bent = &bent, .cost = static_cast<double>(all.size())});
    }
  }

  bool is_inside(const LabelBox& box) const {
    return box.left >= p_.margin_px && box.top >= p_.margin_px &&
           box.right <= p_.width_px - p_.margin_px && box.bottom <= p_.height_px - p_.margin_px;
  }

  // The one position of a name placed by hand, moved into the picture where its size would put it
  // outside, with a leader to the nearest point of the text unless that is beside the mark.
  Candidate by_hand(const LabelRequest& request) const {
    const glm::dvec2 half(.5 * request.width_px, request.height_px);
    const glm::dvec2 low = glm::dvec2(p_.margin_px) + half;
    const glm::dvec2 high =
        glm::max(low, glm::dvec2(p_.width_px - p_.margin_px - half.x, p_.height_px - p_.margin_px));
    const glm::dvec2 foot =
        glm::clamp(request.mark + *request.by_hand_px, glm::dvec2(low.x, low.y), high);
    Candidate out{.text = {foot.x - half.x, foot.y - half.y, foot.x + half.x, foot.y}};
    // Inside the ends of the text, so that the line meets a letter.
    const double inset = std::min(.15 * request.width_px, request.height_px);
    out.leader_end = {std::clamp(request.mark.x, out.text.left + inset, out.text.right - inset),
                      std::clamp(request.mark.y, out.text.top, out.text.bottom)};
    out.has_leader = glm::length(out.leader_end - request.mark) >
                     .5 * request.mark_px + p_.gap_px + .5 * p_.row_px;
    return out;
  }

  // The text with the centre of its lower edge there; nothing where it would leave the picture.
  Candidate* add(const LabelRequest& request, double centre, double bottom, double cost,
                 std::vector<Candidate>& all) const {
    const LabelBox box{centre - .5 * request.width_px, bottom - request.height_px,
                       centre + .5 * request.width_px, bottom};
    if (!is_inside(box)) return nullptr;
    all.push_back({.text = box, .cost = cost});
    return &all.back();
  }

  // Centres of the text over a leader, as shares of its width from the leader. Both ends of a text
  // leave a little room, so that lines of neighbours pass beside it.
  static constexpr std::array<double, 7> shifts = {0.0, -.18, .18, -.34, .34, -.46, .46};

  double foot_of(const LabelRequest& request) const {
    return request.mark.y - .5 * request.mark_px - p_.gap_px;
  }

  void lead(const LabelRequest& request, double bottom, double cost,
            std::vector<Candidate>& all) const {
    for (const double shift : shifts)
      if (Candidate* c = add(request, request.mark.x + shift * request.width_px, bottom,
                             cost + 1.5 * std::abs(shift), all)) {
        c->has_leader = foot_of(request) - bottom > .5 * p_.row_px;
        c->leader_end = {request.mark.x, bottom};
      }
  }

  // Straight above the mark, or a little higher on a leader, which must not cross much ground; else
  // beside its tip.
  void add_above(const LabelRequest& request, std::vector<Candidate>& all) const {
    const double foot = foot_of(request);
    for (int row = 0; row * p_.row_px <= p_.ground_leader_px; ++row)
      lead(request, foot - row * p_.row_px, row, all);
    const double r = .5 * request.mark_px + p_.gap_px;
    const double w = .5 * request.width_px;
    const double last = std::floor(p_.ground_leader_px / p_.row_px) + 1.0;
    for (const double side : {1.0, -1.0})
      add(request, request.mark.x + side * (r + w), request.mark.y + .25 * request.height_px,
          last + (side > 0.0 ? 0.0 : .2), all);
  }

  // Rows count from the upper margin, so that the names of all summits share them. The lowest whose
  // text has only sky behind it comes first; rows in front of land are a last resort.
  void add_rows(const LabelRequest& request, std::vector<Candidate>& all) const {
    const double foot = foot_of(request);
    const double first = p_.margin_px + request.height_px;
    const int lowest = static_cast<int>(std::floor((foot - first) / p_.row_px));
    for (int row = lowest; row >= 0; --row) {
      const double bottom = first + row * p_.row_px;
      if (foot - bottom > p_.longest_leader_px) break;
      const std::size_t before = all.size();
      lead(request, bottom, lowest - row, all);
      for (std::size_t k = before; k < all.size(); ++k)
        if (skyline_over(all[k].text) < all[k].text.bottom + p_.clearance_px) all[k].cost += 20.0;
    }
    // Where the picture's edge leaves no row, as above any other summit.
    if (all.empty()) add_above(request, all);
  }

  double skyline_over(const LabelBox& box) const {
    double row = static_cast<double>(p_.height_px);
    const int from = std::max(0, static_cast<int>(std::floor(box.left)));
    const int to =
        std::min(static_cast<int>(skyline_px_.size()) - 1, static_cast<int>(std::ceil(box.right)));
    for (int x = from; x <= to; ++x) row = std::min(row, skyline_px_[static_cast<std::size_t>(x)]);
    return row;
  }

  // The eight positions around a mark as cartographers rank them (Imhof 1975): upper right first,
  // then right, upper left, left, below, above.
  void add_around(const LabelRequest& request, std::vector<Candidate>& all) const {
    const double r = .5 * request.mark_px + p_.gap_px;
    const double w = .5 * request.width_px;
    const double h = request.height_px;
    const glm::dvec2 m = request.mark;
    add(request, m.x + .7 * r + w, m.y - .3 * r, 0.0, all);
    add(request, m.x + r + w, m.y + .5 * h, .2, all);
    add(request, m.x - .7 * r - w, m.y - .3 * r, .4, all);
    add(request, m.x - r - w, m.y + .5 * h, .6, all);
    add(request, m.x + .7 * r + w, m.y + .3 * r + h, .8, all);
    add(request, m.x - .7 * r - w, m.y + .3 * r + h, 1.0, all);
    add(request, m.x, m.y - r, 1.2, all);
    add(request, m.x, m.y + r + h, 1.4, all);
    for (Candidate& candidate : all) candidate.cost += barrier_cost(request, candidate.text);
  }

  // Right or left of an area that is too narrow for the name.
  void add_beside_area(const LabelRequest& request, std::vector<Candidate>& all) const {
    const double aside = .5 * request.area_px + p_.gap_px + .5 * request.width_px;
    for (const double down : {0.0, -.8, .8, -1.6, 1.6})
      for (const double side : {1.0, -1.0})
        add(request, request.mark.x + side * aside,
            request.mark.y + (down + .5) * request.height_px,
            std::abs(down) + (side > 0.0 ? 0.0 : .2), all);
  }

  // At the centre of the line, then towards its ends.
  void add_on(const LabelRequest& request, std::vector<Candidate>& all) const {
    if (request.along.empty()) {
      add(request, request.mark.x, request.mark.y + .5 * request.height_px, 0.0, all);
      return;
    }
    const double length = length_of(request.along);
    for (const double share : {.5, .42, .58, .34, .66, .26, .74, .18, .82}) {
      const glm::dvec2 at = point_at(request.along, share * length);
      add(request, at.x, at.y + .5 * request.height_px, std::abs(share - .5), all);
    }
  }

  // A name of a place on the other bank would be read as another place: worse than any other
  // position. One across the water is half as bad.
  double barrier_cost(const LabelRequest& request, const LabelBox& box) const {
    const glm::dvec2 centre(.5 * (box.left + box.right), .5 * (box.top + box.bottom));
    int crossed = 0;
    bool touched = false;
    for (const std::vector<glm::dvec2>& line : barriers_)
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        crossed += segments_cross(request.mark, centre, line[i], line[i + 1]) ? 1 : 0;
        touched = touched || enters(line[i], line[i + 1], box);
      }
    return (crossed % 2 == 1 ? 4.0 : 0.0) + (touched ? 2.0 : 0.0);
  }

  static bool follows_line(const LabelRequest& request) {
    return !request.bent.empty() || request.position == LabelPlace::on;
  }

  bool is_crowded(std::size_t i) const {
    if (p_.crowd_radius_px <= 0.0 || follows_line(requests_[i])) return false;
    double around = 0.0;
    for (std::size_t j = 0; j < chosen_.size(); ++j)
      if (chosen_[j] && !follows_line(requests_[j]) &&
          glm::length(requests_[j].mark - requests_[i].mark) < p_.crowd_radius_px)
        around += 1.0;
    return around >= p_.crowd;
  }

  bool collide(std::size_t i, const Candidate& a, std::size_t j, const Candidate& b) const {
    const LabelBox mark_a = mark_box(requests_[i]);
    const LabelBox mark_b = mark_box(requests_[j]);
    if (texts_overlap(a, b, p_.clearance_px)) return true;
    if (requests_[j].mark_px > 0.0 && lies_over(a, 0.0, mark_b)) return true;
    if (requests_[i].mark_px > 0.0 && lies_over(b, 0.0, mark_a)) return true;
    const auto lies_on = [&](const LabelBox& leader, std::size_t other, const Candidate& theirs,
                             const LabelBox& mark) {
      return lies_over(theirs, .5 * p_.clearance_px, leader) ||
             (requests_[other].mark_px > 0.0 && leader.overlaps(mark)) ||
             (theirs.has_leader && grown(leader, p_.clearance_px)
                                       .overlaps(leader_box(requests_[other], theirs.leader_end)));
    };
    if (a.has_leader && lies_on(leader_box(requests_[i], a.leader_end), j, b, mark_b)) return true;
    return b.has_leader && lies_on(leader_box(requests_[j], b.leader_end), i, a, mark_a);
  }

  // Names that block a candidate: none, one, or more than one (requests_.size()).
  std::optional<std::size_t> in_the_way(std::size_t i, const Candidate& candidate) const {
    std::optional<std::size_t> found;
    for (std::size_t j = 0; j < chosen_.size(); ++j) {
      if (j == i || !chosen_[j] || !collide(i, candidate, j, *chosen_[j])) continue;
      if (found) return requests_.size();
      found = j;
    }
    return found;
  }

  bool place_free(std::size_t i) {
    for (const Candidate& candidate : candidates_[i])
      if (!in_the_way(i, candidate)) {
        chosen_[i] = candidate;
        return true;
      }
    return false;
  }

  // A single blocking name moves if it has another position.
  void place_by_moving_one(std::size_t i) {
    for (const Candidate& candidate : candidates_[i]) {
      const std::optional<std::size_t> j = in_the_way(i, candidate);
      if (!j || *j == requests_.size()) continue;
      for (const Candidate& other : candidates_[*j]) {
        if (collide(*j, other, i, candidate) || in_the_way(*j, other)) continue;
        chosen_[i] = candidate;
        chosen_[*j] = other;
        return;
      }
    }
  }

  const std::vector<LabelRequest>& requests_;
  const std::vector<double>& skyline_px_;
  const LabelLayoutParameters& p_;
  const std::vector<std::vector<glm::dvec2>>& barriers_;
  std::vector<std::vector<Candidate>> candidates_;
  std::vector<std::optional<Candidate>> chosen_;
};

}  // namespace

std::vector<LabelSpot> place_labels(const std::vector<LabelRequest>& requests,
                                    const std::vector<double>& skyline_px,
                                    const LabelLayoutParameters& parameters,
                                    const std::vector<std::vector<glm::dvec2>>& barriers) {
  return Layout(requests, skyline_px, parameters, barriers).run();
}

}  // namespace belvedere
