#pragma once

#include <cstdint>
#include <string>

#include "base/grid.h"
// Reads and writes pictures of any format.
#include "base/files/output_file.h"
#include "renderer/image/exr/exr_reader.h"
#include "renderer/image/exr/exr_writer.h"
#include "renderer/image/image_file.h"
#include "renderer/image/oiio_file.h"
#include "renderer/image/tiff_file.h"

namespace belvedere {

// picture_formats.h has the table of formats. OpenEXR and TIFF are written without OpenImageIO,
// because it can write the parts of a file only one after the other, each whole, and because bytes
// of its TIFF files depend on the date, on the number of threads and on uninitialized memory.

// A file of any format of the table, identified by its first bytes whatever the name. Error(input)
// for anything else or a damaged header.
ImageInfo read_image_info(const std::string& path);
// A picture of any format of the table (OpenEXR: channels R G B or Y), as in the file: values 0…1
// for integer formats. Colours are not converted, and not multiplied by alpha; what is fully
// transparent is black, whatever colour the file hides there. A TIFF's largest page. Grey becomes
// RGB, palettes are looked up, alpha is dropped (`alpha` receives it if given; 1 where the file has
// none). Size checked before allocating: Error(limit). Error(input): missing, another format, CMYK,
// truncated.
Grid<glm::vec3> read_picture(const std::string& path, Grid<float>* alpha = nullptr);
// The same picture from top to bottom, a band of rows at a time: for PNG, TIFF and JPEG no more is
// in memory, others are unpacked whole.
void read_picture_rows(const std::string& path, const UsePictureRows& use);
// A grey image of 16 bits or fewer (PNG, TIFF) as numbers, unscaled: label masks, altitude guides.
// A palette PNG gives its indices. Error(input) for colour pictures and what read_picture refuses.
Grid<std::uint16_t> read_grey(const std::string& path);

}  // namespace belvedere
