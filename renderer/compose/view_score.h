#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/compose/massifs.h"
#include "renderer/compose/view_measures.h"

namespace belvedere {

// Reference values of the evaluation of a view.
struct ScoreContext {
  double lone = 0.0;     // of the massifs
  double plateau = 0.0;  // of the ground
  int main = 0;          // anchor that is the subject; -1: none
  std::vector<Anchor> anchors;
};

// 0 below a, rising to 1 from b to c, falling to 0 at d.
struct Plateau {
  double a = 0.0, b = 0.0, c = 1.0, d = 1.0;
};
double plateau(double x, const Plateau& p);

// How a term's measure counts: by its position on the plateau; by its distance outside b…c; or it
// is only reported.
enum class TermKind : int { plateau, excess, told };
enum class TermUnit : int { share, number, degrees, pixels };

// A row of the table that evaluates views.
struct ScoreTerm {
  std::string_view name;
  double weight = 1.0;  // of a full plateau; or the cost of one unit outside
  TermKind kind = TermKind::plateau;
  Plateau good;
  TermUnit unit = TermUnit::share;
  double value = 0.0;
  std::string_view meaning;  // what is measured; printed after the value
  std::string_view too_low;  // message, with what to do, where it is too small; empty: never
  std::string_view too_high;

  double points() const;
  // The applicable message; empty where the value is good, or nearly.
  std::string_view advice() const;
  // The maximum of points().
  double max() const { return kind == TermKind::plateau ? weight : 0.0; }
};

// The measure in a readable unit: "18 %", "12°".
std::string measure_text(const ScoreTerm& term);

// The table, filled in for a view.
std::vector<ScoreTerm> score_terms(const ViewMeasures& measures, const ScoreContext& context);
double total(const std::vector<ScoreTerm>& terms);
// The measures in which the second of two views of a region is better, in words: the two that gain
// most points.
std::string describe_gains(const std::vector<ScoreTerm>& before,
                           const std::vector<ScoreTerm>& after);
// The anchor inside the picture that gives the highest score as its subject; the first where none
// is inside.
int leading_anchor(const ViewMeasures& measures, ScoreContext context);
// Figure of merit: the total relative to the maximum of a picture of the region, 0…10.
double merit(const std::vector<ScoreTerm>& terms, const ScoreContext& context);

}  // namespace belvedere
