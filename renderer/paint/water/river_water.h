#pragma once

#include "renderer/paint/ground_hues.h"
#include "renderer/paint/water_look.h"

namespace belvedere {

// Water that flows: dark teal pools in its middle, and between them riffles that break in light
// dashes. `around` is the share of water nearby, `streak` noise of deviation 1, `river` 0 a lake …
// 1 a river.
WaterLook with_current(WaterLook look, float around, float streak, const Patches& patches,
                       float river);

}  // namespace belvedere
