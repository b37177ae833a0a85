#pragma once

#include "renderer/style/style.h"

namespace belvedere {

// The style with open ground under snow. Classes that the palette "winter" shows white take the
// style's snow, different from it as in that palette (OKLab), and the strokes of its snow; forest
// becomes darker or lighter as there. Sky, air, rock and water stay the painting's; twigs are those
// of the palette "winter".
Style winter_style(Style style);

}  // namespace belvedere
