#include "tools/python/module.h"

#include <dlfcn.h>

#include <exception>
#include <new>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/files/program_file.h"
#include "base/memory/zeroed_memory.h"
#include "renderer/image/provenance.h"

namespace py = pybind11;

namespace belvedere::python {

void save_text(const py::object& path, const std::string& text) {
  write_text_file(py::module_::import("os").attr("fspath")(path).cast<std::string>(), text);
}

namespace {

void raise_in_python(const Error& error) {
  const py::object type = py::module_::import("belvedere._error").attr("Error");
  const py::object made = type(error.where(), error.found(), error.allowed(), error.exit_status());
  PyErr_SetObject(type.ptr(), made.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& error) {
    raise_in_python(error);
  } catch (const std::bad_alloc&) {
    raise_in_python({ErrorKind::limit, "memory", "not enough", "a smaller picture or array"});
  }
}

void name_program_file() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&name_program_file), &info) != 0 && info.dli_fname != nullptr)
    program_file() = info.dli_fname;
}

}  // namespace
}  // namespace belvedere::python

PYBIND11_MODULE(_belvedere, module) {
  using namespace belvedere;
  python::name_program_file();
  reuse_freed_memory();
  py::register_exception_translator(&python::translate);
  module.attr("version") = program_version();
  module.def("save_text", &python::save_text);
  python::add_guidance(module);
  python::add_scene(module);
  python::add_style(module);
  python::add_synthesis(module);
  python::add_terrain(module);
  python::add_textures(module);
}
