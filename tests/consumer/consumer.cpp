// From an elevation model to guidance buffers by the library alone: consumer FOLDER writes hill.asc
// and guidance.exr there.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/progress.h"
#include "renderer/image/guidance_io.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/guidance.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/generalize/generalize.h"
#include "terrain/io/dem.h"

namespace {

constexpr int side = 120;
constexpr double cell_m = 30.0;

// A hill with furrows on a plain of 500 m.
void write_hill(const std::string& path) {
  std::ofstream out(path);
  out << "ncols " << side << "\nnrows " << side
      << "\nxllcorner 600000\nyllcorner 5200000\ncellsize " << cell_m << "\n";
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      out << 500.0 + std::fmax(0.0, 800.0 - 18.0 * std::hypot(x - 60, y - 60)) +
                 8.0 * std::sin(0.9 * x)
          << (x + 1 < side ? ' ' : '\n');
  }
}

void trace_hill(const std::string& folder) {
  using namespace belvedere;
  Progress progress;
  RasterSource source;
  source.path = folder + "/hill.asc";
  source.crs = "EPSG:32632";
  const auto dem = std::make_shared<const Dem>(
      read_dem({.sources = {source}, .crs = {}, .cell_m = 0.0, .extent = {}}, progress));

  GeneralizeParameters bands;
  bands.foreground = bands.background = {1.F, 1.F, 0.5F, 0.F};
  Grid<float> generalized_m = generalize(
      dem->altitude_m, {dem->transform.cell_x, dem->transform.cell_y}, {}, bands, progress);

  const glm::dvec2 viewer(601800.0, 5196000.0);  // south of it
  const DeformedSurface surface = deform(generalized_m, dem->transform, viewer, {viewer, 0.0}, {});
  const Tracer tracer(surface);
  CameraParameters view;
  view.width = 96;
  view.height = 64;
  view.eye = {viewer, 2500.0};
  LandCover meadow;
  meadow.classes.transform = dem->transform;
  meadow.classes.cells =
      Grid<LandCoverClass>(dem->width(), dem->height(), LandCoverClass::alpine_grass);
  const TerrainModel terrain = make_terrain_model(
      dem, std::move(generalized_m), std::make_shared<const LandCover>(std::move(meadow)), 1.0);
  const GuidanceBuffers guidance = trace_guidance(terrain, surface, tracer, *make_camera(view), {},
                                                  {0, 0, view.width, view.height}, progress);
  if (guidance.is_sky(guidance.depth_m.index(48, 32)))
    throw Error(ErrorKind::bug, "consumer", "no hill in the middle of the picture");
  write_guidance(folder + "/guidance.exr", guidance, {{"made_by", "consumer"}});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    write_hill(std::string(argv[1]) + "/hill.asc");
    trace_hill(argv[1]);
  } catch (const belvedere::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  }
  return 0;
}
