#pragma once

#include <string>
#include <vector>

namespace belvedere {

// The content of a picture, as numbers to keep and compare: the same pixels give the same hashes,
// whatever the header contains, however the file is packed, and in every format that keeps the
// values exactly.
struct ChannelHash {
  std::string channel;
  std::string hash;  // hash_bytes of its values, row by row: floats (of integer formats 0…1) and
                     // ids as 32 bits, little-endian
};
struct PictureHash {
  std::vector<ChannelHash>
      channels;       // OpenEXR: alphabetically; else R, G, B, and A where not all is opaque
  std::string whole;  // of size, names and hashes of all channels
};

// Of a PNG, TIFF, JPEG or OpenEXR file. Exact to the bit: 0 and -0 are two. Error(input) and
// Error(limit) as for reading them.
PictureHash hash_picture(const std::string& path);

}  // namespace belvedere
