#pragma once

namespace belvedere {

// srgb_decoded for pictures: encoded sRGB to scene-linear as the nearest float or its neighbour,
// from a table in a sixth of the time of a power. Between knots 1/1024 apart it is the cubic with
// the curve's values and slopes there (error below 1e-12; a float near .003, where the power
// begins, is 2e-10 wide). Values outside 0…1 use the power itself.
float srgb_decoded_fast(float encoded);

}  // namespace belvedere
