#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/compose/massifs.h"
#include "renderer/compose/view_measures.h"

namespace belvedere {

// What a view is judged against besides its measures.
struct ScoreContext {
  double lone = 0.0;     // of the massifs
  double plateau = 0.0;  // of the ground
  int main = 0;          // anchor that the picture is about; -1: none
  std::vector<Anchor> anchors;
};

// 0 below a, rising to 1 from b to c, falling to 0 at d.
struct Plateau {
  double a = 0.0, b = 0.0, c = 1.0, d = 1.0;
};
double plateau(double x, const Plateau& p);

// How a term's measure counts: by where it lies on its plateau; by how far it lies outside of b…c; or it is told alone.
enum class TermKind : int { plateau, excess, told };
enum class TermUnit : int { share, number, degrees, pixels };

// A row of the one table of what makes a view good.
struct ScoreTerm {
  std::string_view name;
  double weight = 1.0;  // of a full plateau; or what one unit outside costs
  TermKind kind = TermKind::plateau;
  Plateau good;
  TermUnit unit = TermUnit::share;
  double value = 0.0;
  std::string_view meaning;  // what is measured
  std::string_view too_low;  // what to say, and to do, where it is less than good; empty: cannot be too little
  std::string_view too_high;

  double points() const;
  // What to say of it; empty where it is good, or nearly.
  std::string_view advice() const;
  // The most it can give.
  double most() const { return kind == TermKind::plateau ? weight : 0.0; }
};

// The table, filled in for a view.
std::vector<ScoreTerm> score_terms(const ViewMeasures& measures, const ScoreContext& context);
double total(const std::vector<ScoreTerm>& terms);
// The measures that make one of two views of a region better, in words: the two that gain most points.
std::string describe_gains(const std::vector<ScoreTerm>& before, const std::vector<ScoreTerm>& after);
// Of the anchors inside of the picture that which makes the most of it as its subject; the first where none is inside.
int leading_anchor(const ViewMeasures& measures, ScoreContext context);
// Figure of merit: the total over the most that a picture of the region can have, 0…10.
double merit(const std::vector<ScoreTerm>& terms, const ScoreContext& context);

}  // namespace belvedere
