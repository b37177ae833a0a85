#pragma once

namespace belvedere {

// How colours that a device does not have are brought into those that it has (ICC.1, annex D).
enum class RenderingIntent { perceptual, relative, saturation, absolute };

struct DeviceParameters {
  RenderingIntent intent = RenderingIntent::perceptual;
  bool black_point = true;  // the picture's black becomes the device's darkest, and all above it moves along (compensation)
};

}  // namespace belvedere
