#pragma once

#include <string>
#include <vector>

namespace belvedere {

// Difference of one channel between two pictures. Values as in the file; those of integer formats
// 0…1. Equal infinities and two nan count as equal, an infinity or nan against anything else as an
// infinite difference.
struct ChannelDifference {
  std::string name;
  bool is_id =
      false;  // ids are equal or not: their difference is 0 or 1, so mean is the differing share
  double mean = 0.0;  // of the absolute differences
  double max = 0.0;
  double rms = 0.0;
  double differing_share = 0.0;  // of the pixels, 0…1
};

struct PictureDifference {
  int width = 0;
  int height = 0;
  std::vector<ChannelDifference> channels;  // that both have
  std::vector<std::string> mismatches;      // reasons why they cannot be compared: another size,
                                            // channels that one of them lacks
};

// Thresholds; a picture within them counts as equal. Ids have no magnitude of difference, so max
// does not apply to them.
struct DifferenceLimits {
  double mean = 0.0;
  double max = 0.0;
};

// Compares PNG, TIFF, JPEG and OpenEXR files: two OpenEXR files channel by channel by name,
// anything else as R, G, B and alpha. Error(input) for files that cannot be read, Error(limit) over
// memory_budget_bytes().
PictureDifference compare_pictures(const std::string& a, const std::string& b);
// No mismatch and every channel within the limits.
bool is_same(const PictureDifference& difference, const DifferenceLimits& limits);

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

// Hashes a PNG, TIFF, JPEG or OpenEXR file, exact to the bit: 0 and -0 differ. Error(input) and
// Error(limit) as for reading them.
PictureHash hash_picture(const std::string& path);

}  // namespace belvedere
