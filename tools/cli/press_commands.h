#pragma once

#include <string>

#include "renderer/image/icc/device_colour.h"

namespace belvedere::tools {

class CommandOptions;

// Options shared by commands for printers.
struct PressOptions {
  std::string profile;
  std::string intent = "relative";
  bool no_black_point = false;
  DeviceParameters device() const { return {rendering_intent(intent), !no_black_point}; }
};
// --profile, and with `conversion` also --intent and --no-black-point.
void add_press_options(CommandOptions& command, PressOptions& options, bool conversion);

}  // namespace belvedere::tools
