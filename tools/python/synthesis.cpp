#include <pybind11/stl.h>

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/synthesize.h"
#include "tools/python/arrays.h"
#include "tools/python/background.h"
#include "tools/python/module.h"

namespace py = pybind11;

namespace belvedere::python {
namespace {

using Numbers = ArrayOf<std::uint8_t>;
using GuideArrays = std::vector<std::pair<std::string, Numbers>>;

using PictureArrays = std::tuple<ArrayOf<Rgb8>, Numbers, GuideArrays>;  // picture, labels, guides

GuideStack stack_of(const Numbers& labels, const GuideArrays& guides) {
  GuideStack stack;
  stack.label = lent<std::uint8_t>(labels);
  for (const auto& [name, values] : guides)
    stack.guides.push_back({name, lent<std::uint8_t>(values)});
  return stack;
}

py::tuple synthesize_arrays(const std::vector<PictureArrays>& pictures,
                            const Numbers& target_labels, const GuideArrays& target_guides,
                            const py::dict& given, const py::tuple& run_request) {
  std::vector<Exemplar> exemplars;
  for (const auto& [picture, labels, guides] : pictures)
    exemplars.push_back({"picture " + std::to_string(exemplars.size()), lent<Rgb8>(picture),
                         stack_of(labels, guides)});
  const GuideStack target = stack_of(target_labels, target_guides);
  SynthesisParameters parameters;
  take(given, "weights", parameters.weights);
  take(given, "fallback", parameters.fallback);
  take(given, "seed", parameters.seed);
  take(given, "levels", parameters.levels);
  take(given, "reuse", parameters.reuse);
  take(given, "copy_cap", parameters.copy_cap);
  take(given, "neighbourhood", parameters.neighbourhood);
  take(given, "surroundings", parameters.surroundings);
  take(given, "surroundings_of", parameters.surroundings_of);
  auto [picture, matches] = in_background(run_request, [&](const Run& run) {
    MatchField found = synthesize(exemplars, target, parameters, run.progress);
    std::vector<const Grid<Rgb8>*> layers;
    for (const Exemplar& exemplar : exemplars) layers.push_back(&exemplar.picture);
    Grid<Rgb8> copied = replay(found, layers, Grid<Rgb8>());
    return std::pair(std::move(copied), std::move(found));
  });
  return py::make_tuple(array_of(std::move(picture)), array_of(std::move(matches)));
}

}  // namespace

void add_synthesis(py::module_& module) { module.def("synthesize", &synthesize_arrays); }

}  // namespace belvedere::python
