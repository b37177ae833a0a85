#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "renderer/scene/scene_file.h"

namespace belvedere::python {

// What each file of this folder adds to the module _belvedere: functions with all of their
// arguments, for the package tools/python/belvedere, which has names, defaults and documentation.
void add_guidance(pybind11::module_& module);
void add_scene(pybind11::module_& module);
void add_style(pybind11::module_& module);
void add_synthesis(pybind11::module_& module);
void add_terrain(pybind11::module_& module);
void add_textures(pybind11::module_& module);

// `path`: a string or os.PathLike.
void save_text(const pybind11::object& path, const std::string& text);
// One of the options that the package passes in a dict.
template <class T>
void take(const pybind11::dict& given, const char* name, T& to) {
  to = given[name].cast<T>();
}
// Channels of a scene, by the first of their names in files: arrays, origin of positions, and the
// view.
pybind11::object guidance_of(const LoadedScene& scene, const std::vector<std::string>& channels,
                             const pybind11::tuple& run_request);

}  // namespace belvedere::python
