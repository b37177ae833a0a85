#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/guidance_buffers.h"
#include "renderer/image/guidance_io.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/pipeline/sheet_work.h"
#include "renderer/sheet/piece_file.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/world/world.h"
#include "terrain/io/crs.h"
#include "tools/python/arrays.h"
#include "tools/python/background.h"
#include "tools/python/module.h"

namespace py = pybind11;

namespace belvedere::python {
namespace {

// The view of a picture whose ground has no finer windows.
using SeenGround = std::shared_ptr<BareView>;

// Arrays by the first name of each channel, origin of positions, and the view, if it is known.
py::tuple arrays_of(GuidanceBuffers buffers, SeenGround seen) {
  py::dict arrays;
  for (const GuidanceChannel& channel : guidance_channels())
    std::visit(
        [&](auto member) {
          if (!(buffers.*member).empty())
            arrays[py::str(std::string(channel.names[0]))] = array_of(std::move(buffers.*member));
        },
        channel.member);
  const glm::dvec3 origin = buffers.origin_m;
  return py::make_tuple(arrays, py::make_tuple(origin.x, origin.y, origin.z), std::move(seen));
}

// (n, 2)
using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<glm::dvec2> points_of(const Points& points) {
  std::vector<glm::dvec2> out(static_cast<std::size_t>(points.shape(0)));
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = {points.data()[2 * i], points.data()[2 * i + 1]};
  return out;
}

py::array rows_of(const std::vector<glm::dvec3>& rows) {
  return py::array_t<double>({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}},
                             reinterpret_cast<const double*>(rows.data()));
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// From positions in a CRS (empty: the scene's) to x, y, px, and whether it is seen: (n, 3).
py::array to_pixels(const SeenGround& seen, const Points& points, const std::string& crs) {
  std::vector<glm::dvec2> positions = points_of(points);
  std::vector<glm::dvec3> out(positions.size(), {nan, nan, 0.0});
  {
    const py::gil_scoped_release free;
    if (!crs.empty()) PointTransform(normalize_crs(crs), seen->dem->crs).apply(positions);
    const GeoMap map = seen->geo_map();
    for (std::size_t i = 0; i < out.size(); ++i)
      if (std::isfinite(positions[i].x) && std::isfinite(positions[i].y))
        if (const auto at = map.to_image(positions[i]))
          out[i] = {at->pixel, at->visible ? 1.0 : 0.0};
  }
  return rows_of(out);
}

// From pixels to positions in a CRS (empty: the scene's) and altitudes, m: (n, 3).
py::array to_ground(const SeenGround& seen, const Points& points, const std::string& crs) {
  const std::vector<glm::dvec2> pixels = points_of(points);
  std::vector<glm::dvec3> out(pixels.size(), glm::dvec3(nan));
  {
    const py::gil_scoped_release free;
    const GeoMap map = seen->geo_map();
    // Of ground alone: the operation between two datums is chosen for the mean of all.
    std::vector<glm::dvec2> positions;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (const auto at = map.to_geo(pixels[i])) {
        positions.push_back(at->position);
        out[i].z = at->altitude_m;
      }
    if (!crs.empty()) PointTransform(seen->dem->crs, normalize_crs(crs)).apply(positions);
    std::size_t next = 0;
    for (glm::dvec3& row : out)
      if (!std::isnan(row.z)) row = {positions[next++], row.z};
  }
  return rows_of(out);
}

// names in files, unit, meaning, components of the sky, ids?, of paintings only?
py::list channel_rows() {
  py::list rows;
  for (const GuidanceChannel& channel : guidance_channels()) {
    std::vector<std::string> names;
    std::vector<float> sky;
    for (std::size_t k = 0; k < channel.components(); ++k) {
      names.emplace_back(channel.names[k]);
      sky.push_back(channel.sky[static_cast<int>(k)]);
    }
    rows.append(py::make_tuple(names, std::string(channel.unit), std::string(channel.meaning), sky,
                               channel.type == ChannelStorage::uint32,
                               channel.maker == ChannelMaker::strokes));
  }
  return rows;
}

}  // namespace

py::object guidance_of(const LoadedScene& scene, const std::vector<std::string>& channels,
                       const py::tuple& run_request) {
  std::vector<GuidanceMember> members;
  for (const GuidanceChannel& channel : guidance_channels())
    if (std::find(channels.begin(), channels.end(), channel.names[0]) != channels.end())
      members.push_back(channel.member);
  auto [buffers, seen] = in_background(run_request, [&](const Run& run) {
    require_inputs(scene);
    const SheetRequest request{.panorama = false};
    SheetWork work(scene, request, {}, run, run);
    std::pair<GuidanceBuffers, SeenGround> out;
    out.first = work.ground.guidance->read(region_of(scene.scene, request),
                                           with_channels(members, work.world.surface->origin));
    keep_chosen(out.first, channels);  // its stage fills the base picture in any case
    if (work.world.terrain.windows.empty())
      out.second = std::make_shared<BareView>(bare_view_of(work.world));
    return out;
  });
  return arrays_of(std::move(buffers), std::move(seen));
}

void add_guidance(py::module_& module) {
  py::class_<BareView, std::shared_ptr<BareView>>(module, "SeenGround")
      .def_property_readonly("crs", [](const BareView& of) { return of.dem->crs; })
      .def("to_pixels", &to_pixels)
      .def("to_ground", &to_ground);
  module.def("channel_rows", &channel_rows);
  module.def("read_guidance", [](const std::string& path, const py::tuple& run_request) {
    return arrays_of(in_background(run_request, [&](const Run&) { return read_guidance(path); }),
                     nullptr);
  });
}

}  // namespace belvedere::python
