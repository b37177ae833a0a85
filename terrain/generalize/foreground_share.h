#pragma once

namespace belvedere {

// u_d of equation 5 as a function of the distance from the viewer: 1 near, 0 far. Between the two
// it falls linearly, so that generalization changes from one cell to the next by no more than with
// a linear share. A share that is 1 at foreground_to_m, 0 at background_from_m and nowhere steeper
// can only be that line (mean value theorem), which has a kink at either end. The kinks are rounded
// by parabolas over an eighth of the span on both sides of each end, so the share starts to fall
// that much earlier and ends that much later. Any unit; background_from must exceed foreground_to.
double foreground_share(double distance, double foreground_to, double background_from);

}  // namespace belvedere
