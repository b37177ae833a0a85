#pragma once

namespace belvedere {

// u_d of equation 5 by the distance from the viewer: 1 near, 0 far, between the two falling as straight as a line, so that the terrain is
// generalized by no more from one cell to the next than a linear share would. A share that reaches 1 at foreground_to_m and 0 at
// background_from_m and is nowhere steeper can only be that line (mean value theorem), which has a crease at either end. The creases are
// rounded by parabolas over an eighth of the span on both sides of each end, so that the share begins to fall that much sooner and ends
// that much later. Any unit; background_from above foreground_to.
double foreground_share(double distance, double foreground_to, double background_from);

}  // namespace belvedere
