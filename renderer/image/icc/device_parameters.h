#pragma once

namespace belvedere {

// How colours outside the gamut of a device are mapped into it (ICC.1, annex D).
enum class RenderingIntent { perceptual, relative, saturation, absolute };

struct DeviceParameters {
  RenderingIntent intent = RenderingIntent::perceptual;
  bool black_point = true;  // maps the picture's black to the device's darkest colour, and shifts
                            // all above it (compensation)
};

}  // namespace belvedere
