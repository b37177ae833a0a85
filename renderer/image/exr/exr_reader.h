#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/image/image_file.h"

namespace belvedere {

// Like read_image_info and read_picture of image_io.h, for OpenEXR.
ImageInfo read_exr_info(const std::string& path);
Grid<glm::vec3> read_exr_picture(const std::string& path, Grid<float>* alpha);
// One channel of any part of an OpenEXR file by name; half and float32 as float. Error(input) if
// absent, of the other kind or damaged, Error(limit) over memory_budget_bytes()
// (base/memory_limit.h).
Grid<float> read_channel(const std::string& path, const std::string& channel);
// Several at once, so that a part is unpacked only once; an absent one gives an empty grid.
std::vector<Grid<float>> read_channels(const std::string& path,
                                       const std::vector<std::string>& channels);
Grid<std::uint32_t> read_id_channel(const std::string& path, const std::string& channel);
// Every step-th pixel of every step-th row, the central one of each square, ids as numbers; an
// absent channel gives an empty grid. Memory holds a row of tiles.
std::vector<Grid<float>> read_sampled_channels(const std::string& path,
                                               const std::vector<std::string>& channels, int step);

// Numbers as the 16 bits of OpenEXR files, rounded to the nearest; finite numbers beyond ±65504 are
// clamped. `count` values each step apart.
void to_halves(const float* from, std::size_t step, std::size_t count, std::uint16_t* to);
// The exact inverse.
void from_halves(const std::uint16_t* from, std::size_t count, float* to, std::size_t step);

}  // namespace belvedere
