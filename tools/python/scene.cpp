#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/text/embedded.h"
#include "renderer/image/image_file.h"
#include "renderer/live/live_view.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/edit/scene_edit.h"
#include "renderer/world/scene_dem.h"
#include "tools/cli/new/new_options.h"
#include "tools/python/arrays.h"
#include "tools/python/background.h"
#include "tools/python/module.h"

namespace py = pybind11;

namespace belvedere::python {
namespace {

// A scene as text, which is the truth, and what it means.
class SceneText {
 public:
  // data: further folders with files.
  SceneText(std::string text, std::string name, std::string folder, std::vector<std::string> data)
      : text_(std::move(text)), name_(std::move(name)), folder_(std::move(folder)) {
    options_.data_folders = std::move(data);
    loaded_ = parse_scene(text_, name_, folder_, options_);
  }

  const std::string& text() const { return text_; }
  const LoadedScene& loaded() const { return loaded_; }
  SceneText copy() const { return {text_, name_, folder_, options_.data_folders}; }

  // Keys and values as TOML; all or none. The messages are those of --set.
  void set(const std::vector<std::pair<std::string, std::string>>& values) {
    SceneFileOptions options = options_;
    std::vector<SceneEdit> edits;
    for (const auto& [key, value] : values) {
      options.settings.push_back(key + "=" + value);
      edits.push_back({key, value});
    }
    LoadedScene loaded = parse_scene(text_, name_, folder_, options);
    text_ = edit_scene_text(text_, name_, edits);
    loaded_ = std::move(loaded);
  }
  void remove(const std::string& key) {
    std::string text = edit_scene_text(text_, name_, std::vector<SceneEdit>{{key, std::nullopt}});
    loaded_ = parse_scene(text, name_, folder_, options_);
    text_ = std::move(text);
  }

  // The finished picture; what several pictures share is kept.
  Grid<Rgb8> draw(const LoadedScene& scene, int width_px, const Run& run) {
    const std::lock_guard lock(drawing_->mutex);
    Rung last = rungs().back();
    last.max_width_px = width_px;
    last.names = false;
    const Grid<glm::vec3> colour =
        drawing_->live.paint(at_width(scene, width_px), last, run).colour;
    Grid<Rgb8> out(colour.width(), colour.height());
    image_io::quantize_rows(colour, 0, colour.height(), colour.width(),
                            reinterpret_cast<std::uint8_t*>(out.data()));
    return out;
  }

 private:
  struct Drawing {
    std::mutex mutex;
    LiveView live;
  };

  std::string text_;
  std::string name_;
  std::string folder_;
  SceneFileOptions options_;
  LoadedScene loaded_;
  std::shared_ptr<Drawing> drawing_ = std::make_shared<Drawing>();
};

py::array draw(SceneText& scene, int width_px, const py::tuple& run_request) {
  const LoadedScene loaded = scene.loaded();
  return array_of(in_background(run_request,
                                [&](const Run& run) { return scene.draw(loaded, width_px, run); }));
}

// Returns the names of the files.
std::vector<std::string> render_scene(const SceneText& scene, const std::string& out, bool draft,
                                      const std::optional<std::array<int, 4>>& part, bool match,
                                      const std::vector<std::string>& layers,
                                      const std::string& channels, bool resume, bool force,
                                      const py::tuple& run_request) {
  SheetRequest request;
  request.matches = match;
  request.layers = layers;
  request.resume = resume;
  request.replace = force;
  if (!channels.empty()) request.channels = read_guidance_choice(channels);
  if (part) {
    const auto [x, y, width, height] = *part;
    request.part = PixelRect{x, y, x + width, y + height};
  }
  LoadedScene loaded = scene.loaded();
  if (draft) loaded = make_draft_scene(std::move(loaded));
  return in_background(run_request, [&](const Run& run) {
    render(loaded, out, run, request);
    return result_names(loaded.scene, request);
  });
}

// As `belvedere new`; returns the text.
std::string new_scene(const std::vector<std::string>& dems, const py::dict& given,
                      const py::tuple& run_request) {
  tools::NewOptions options;
  options.dems = dems;
  take(given, "out", options.out);
  take(given, "data", options.common.files.data_folders);
  take(given, "towards", options.towards);
  take(given, "from", options.from);
  take(given, "include", options.include);
  take(given, "format", options.format);
  take(given, "style", options.style);
  take(given, "plain", options.plain);
  take(given, "land_cover", options.cover.file);
  take(given, "legend", options.cover.legend);
  take(given, "crs", options.crs);
  take(given, "title", options.title);
  return in_background(run_request, [&](const Run& run) {
    return tools::new_scene_text(options, run.cache, run.progress);
  });
}

}  // namespace

void add_scene(py::module_& module) {
  py::class_<SceneText>(module, "SceneText")
      .def(py::init<std::string, std::string, std::string, std::vector<std::string>>())
      .def_property_readonly("text", &SceneText::text)
      .def_property_readonly("name", [](const SceneText& of) { return of.loaded().name; })
      .def("copy", &SceneText::copy)
      .def("set", &SceneText::set)
      .def("remove", &SceneText::remove)
      .def("values", [](const SceneText& of) { return scene_values(of.loaded().scene); })
      .def("draw", &draw)
      .def("render", &render_scene)
      .def("guidance", [](const SceneText& of, int width_px,
                          const std::vector<std::string>& channels, const py::tuple& run_request) {
        return guidance_of(at_width(of.loaded(), width_px), channels, run_request);
      });
  module.def("demo_text", [] { return std::string(embedded_file("scenes/demo/demo.toml")); });
  module.def("check_toml", [](const std::string& path) { read_config(path); });
  module.def("nearest_word_hint", &nearest_word_hint);
  module.def("new_scene", &new_scene);
}

}  // namespace belvedere::python
