#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Grids of the DEM's size that cannot be derived from the ground; null: unknown.
struct LayerClimate {
  const Grid<float>* temperature_c = nullptr;  // annual mean
  const Grid<float>* rain_mm = nullptr;        // annual sum
  const Grid<float>* radiation =
      nullptr;  // annual potential direct, MJ/m²; any unit that fitting and applying share
  const Grid<float>* sky_view = nullptr;  // 0…1
  const Grid<float>* treeline_m = nullptr;
  const Grid<float>* lake = nullptr;  // 1 on lakes, else 0
  const Grid<float>* sea = nullptr;   // 1 at sea, else 0
};

// A DEM prepared for inputs: quantities with a long reach (means over kilometres, catchments) are
// kept at a coarser resolution that depends only on the whole DEM, so that any rectangle gets the
// bits of the whole. Keeps pointers to the DEM and the grids, which must outlive it.
struct LayerGround {
  // A grid of blocks of `factor` × `factor` cells over the whole DEM, interpolated by cubic
  // B-spline; empty if no input needs it.
  struct Coarse {
    int factor = 1;
    Grid<float> values;
  };
  const Dem* dem = nullptr;
  LayerClimate climate;
  std::vector<std::string> names;  // of the inputs, in the order of layer_inputs()
  std::vector<Coarse> coarse;      // one for each input
};
// Error(usage) with the input that is unknown or missing from the climate. `whole`: of a window,
// the larger terrain that contains it; means that reach beyond the window's halo are taken over it,
// and catchments include the inflow.
LayerGround make_layer_ground(const Dem& dem, const LayerClimate& climate,
                              const std::vector<std::string>& names, const Dem* whole = nullptr);

// The inputs at the cells of a rectangle inside the DEM, a grid of its size each. Thread-safe.
std::vector<Grid<float>> layer_inputs(const LayerGround& ground, const PixelRect& cells);
// The same over the whole DEM, by tiles.
std::vector<Grid<float>> layer_inputs(const LayerGround& ground);

// The range over which samples are spread: the percentiles .1 and 99.9 of the values where `use` is
// not 0 (null: everywhere), widened if all are equal, so that low < high. Error(input) if no cell
// is used.
LayerInput layer_input_range(const std::string& name, const Grid<float>& values,
                             const Grid<std::uint8_t>* use = nullptr);

// Reads files of layers of any kind: class rules (class_rules.h) and surface layers (layers_file.h)
// share a syntax. This reader reads the common parts and rejects everything unknown with its
// position.
struct LayersReader {
  const std::string& where;  // the file, for messages

  // Error(usage) at file:line:column.
  [[noreturn]] void fail(ConfigPosition position, const std::string& found,
                         const std::string& allowed) const;
  // `what` is the kind of word expected.
  [[noreturn]] void fail_unknown(ConfigPosition position, const std::string& what,
                                 const std::string& word,
                                 const std::vector<std::string>& known) const;

  double number_or(const ConfigTable& table, std::string_view key, double otherwise) const;
  std::string text_or(const ConfigTable& table, std::string_view key,
                      const std::string& otherwise) const;
  std::string expression(const ConfigValue& value) const;  // not empty
};

// A class of the ground by its name, except the sky.
LandCoverClass as_ground_class(const ConfigValue& value, const std::string& where);

// The common parts of these files.
struct LayersDocument {
  std::string name;
  std::vector<std::pair<std::string, double>>
      parameters;  // named numbers for expressions; a scene may set them
  std::vector<std::pair<std::string, std::string>>
      terms;  // named sub-expressions, evaluated in order
  std::vector<ConfigPosition> term_places;
};

// Version, name, parameters and terms; the table may also have `own_keys`. Names must be unique,
// valid in expressions, and different from variables, classes and the words of expressions.
LayersDocument read_layers_document(const LayersReader& reader, const ConfigValue& document,
                                    const std::vector<std::string>& own_keys);

// The list of layers in the document.
const ConfigArray& layers_of(const LayersReader& reader, const ConfigValue& document);

}  // namespace belvedere
