#include "terrain/layers/fit/minimize.h"

#include <lbfgs.h>

#include <algorithm>
#include <cstddef>
#include <memory>

#include "base/error.h"

namespace belvedere {
namespace {

struct Search {
  const ValueAndGradient& function;
  MinimizeResult result = {};
};

double evaluate(void* search, const double* x, double* gradient, int count, double /*step*/) {
  auto& [function, result] = *static_cast<Search*>(search);
  const double value =
      function({x, static_cast<std::size_t>(count)}, {gradient, static_cast<std::size_t>(count)});
  if (++result.evaluations == 1) result.value = value;
  return value;
}

int count_step(void* search, const double* /*x*/, const double* /*gradient*/, double value,
               double /*x_norm*/, double /*gradient_norm*/, double /*step*/, int /*count*/,
               int steps, int /*evaluations*/) {
  MinimizeResult& result = static_cast<Search*>(search)->result;
  result.value = value;
  result.steps = steps;
  return 0;
}

}  // namespace

MinimizeResult minimize(const std::vector<double>& start, const ValueAndGradient& function,
                        const MinimizeParameters& parameters) {
  const int count = static_cast<int>(start.size());
  // The library's vector instructions require its own allocation.
  const std::unique_ptr<double, void (*)(double*)> x(lbfgs_malloc(count), lbfgs_free);
  if (x == nullptr) throw Error(ErrorKind::limit, "minimize", "no memory");
  std::copy(start.begin(), start.end(), x.get());
  lbfgs_parameter_t how;
  lbfgs_parameter_init(&how);
  how.m = 10;
  how.epsilon = 0.0;  // no test of the gradient: only the gain per step decides
  how.past = 1;
  how.delta = parameters.tolerance;
  how.max_iterations = parameters.steps;
  Search search{function};
  // The return value is the reason for stopping. A failed line search leaves the previous point,
  // which is the minimum within numerical precision.
  lbfgs(count, x.get(), nullptr, evaluate, count_step, &search, &how);
  search.result.at.assign(x.get(), x.get() + count);
  return search.result;
}

}  // namespace belvedere
