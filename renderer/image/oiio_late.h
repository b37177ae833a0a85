#pragma once

namespace belvedere {

// Loads OpenImageIO if this program is not linked with it, once: to be called before anything of
// it. Throws Error(limit) where it is not installed.
void load_oiio();

}  // namespace belvedere
