#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <string>

#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/choose_seed.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/learn_texture.h"
#include "texture/statistical/make_texture.h"
#include "tools/python/arrays.h"
#include "tools/python/background.h"
#include "tools/python/module.h"

namespace py = pybind11;

namespace belvedere::python {
namespace {

CliqueModel learn_array(const ArrayOf<Rgb8>& crop, const std::optional<ArrayOf<std::uint8_t>>& mask,
                        int types, int levels, const py::tuple& run_request) {
  LearnParameters parameters;
  parameters.types = types;
  parameters.levels = levels;
  return in_background(run_request, [&](const Run& run) {
    const Grid<Rgb8> picture = lent<Rgb8>(crop);
    Grid<std::uint8_t> states;
    if (mask) states = Grid<std::uint8_t>(lent<std::uint8_t>(*mask));
    for (std::uint8_t& state : states)
      if (state != 0) state = pixel_free;
    CliqueModel model = learn_texture(picture, states, parameters, run.progress).model;
    choose_seed(model, picture, states, parameters, run.progress);
    return model;
  });
}

py::array make_array(const CliqueModel& model, int width, int height, std::uint64_t seed,
                     const py::tuple& run_request) {
  TextureParameters parameters;
  parameters.seed = seed;
  return array_of(in_background(run_request, [&](const Run& run) {
    return make_texture(model, width, height, parameters, run.progress);
  }));
}

}  // namespace

void add_textures(py::module_& module) {
  py::class_<CliqueModel>(module, "TextureModel")
      .def_property_readonly("text", [](const CliqueModel& of) { return model_text(of); })
      .def("save",
           [](const CliqueModel& of, const py::object& path) { save_text(path, model_text(of)); })
      .def_property_readonly("types", [](const CliqueModel& of) { return of.cliques.size(); })
      .def_property_readonly("bytes", &model_bytes);
  module.def("read_model", [](const std::string& path) { return read_model(path); });
  module.def("learn_texture", &learn_array);
  module.def("make_texture", &make_array);
}

}  // namespace belvedere::python
