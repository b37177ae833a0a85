#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "renderer/image/icc/painting_file.h"
#include "renderer/image/label_image.h"
#include "renderer/style/style_file.h"
#include "tools/cli/studio/painting_work.h"
#include "tools/python/arrays.h"
#include "tools/python/background.h"
#include "tools/python/module.h"

namespace py = pybind11;

namespace belvedere::python {
namespace {

// Painting (encoded sRGB, 0…1) and classes as arrays, else by their files; classes with neither are
// inferred.
Style fit_style_of(const std::optional<ArrayOf<glm::vec3>>& painting, const std::string& file,
                   const std::optional<ArrayOf<std::uint8_t>>& classes,
                   const std::string& classes_file, const std::string& name,
                   const std::string& origin, const std::string& licence,
                   const py::tuple& run_request) {
  StyleFitParameters parameters;
  parameters.name = name;
  parameters.origin = origin;
  parameters.licence = licence;
  return in_background(run_request, [&](const Run& run) {
    run.progress.begin("reading", 0.0);
    Grid<float> alpha;
    const Grid<glm::vec3> picture =
        painting ? lent<glm::vec3>(*painting) : read_painting(file, run.progress, &alpha);
    Grid<std::uint8_t> mask;
    if (classes) mask = Grid<std::uint8_t>(lent<std::uint8_t>(*classes));
    if (!classes_file.empty()) mask = read_class_mask(classes_file, {far_air_label});
    return tools::fit_painting(picture, alpha, mask, file, parameters, run.progress);
  });
}

}  // namespace

void add_style(py::module_& module) {
  py::class_<Style>(module, "Style")
      .def_property_readonly("text", &style_text)
      .def("save", [](const Style& of, const py::object& path) { save_text(path, style_text(of)); })
      .def_readonly("name", &Style::name)
      .def_readonly("notes", &Style::notes);
  module.def("read_style", &read_style);
  module.def("fit_style", &fit_style_of);
}

}  // namespace belvedere::python
