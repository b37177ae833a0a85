#pragma once

namespace belvedere {

// u_d of equation 5 as a function of the distance from the viewer: exactly 1 up to foreground_to,
// 1/2 halfway, exactly 0 from background_from on. Between the two it falls along a line whose kinks
// are rounded by parabolas over an eighth of the span inside each end. It is therefore 8/7 as steep
// as a line from end to end, the least for a function without kinks that keeps both ends and turns
// within an eighth. Any unit; background_from must exceed foreground_to.
double foreground_share(double distance, double foreground_to, double background_from);

}  // namespace belvedere
