#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "terrain/deform/bend_curve.h"
#include "terrain/deform/handles.h"
#include "terrain/io/raster.h"

namespace belvedere {

// A summit that is exaggerated more, or less, than the ground around it.
struct SummitExaggeration {
  glm::dvec2 center{0.0};    // undeformed place, CRS
  double radius_m = 5000.0;  // where its effect ends, > 0
  double factor = 1.3;       // 0.3…5, at the centre; falls to 1 at the radius by the quintic smoothstep, so without a step or a kink
  double base_m = 0.0;       // altitude that keeps its height; from 200 m above it the factor holds in full, below nothing changes
};

// What happens to a point (x, y, altitude z), in this order; d is the horizontal distance from the viewer to its place after step 1:
//   1. handles move it in plan and raise it;
//   2. summits: z += (factor - 1) share(distance) · (z - base);
//   3. exaggeration: z = base + e(d) (z - base);
//   4. bend and earth curvature: z -= drop(d).
struct DeformParameters {
  double exaggeration = 1.0;  // 0.1…10, of all altitudes; where a background is given, up to foreground_to_m
  BendCurve bend;
  bool earth_curvature = false;                   // with refraction: z -= d² (1 - k) / (2 · 6371 km), not exaggerated
  double refraction = 0.13;                       // k, 0…0.5
  std::optional<double> background_exaggeration;  // 0.1…10, from background_from_m on; between the two smoothstep
  double foreground_to_m = 32000.0;
  double background_from_m = 90000.0;
  double exaggeration_base_m = 0.0;  // altitude that no exaggeration moves, -12000…9000
  std::vector<SummitExaggeration> summits;
  std::vector<DeformHandle> handles;
};

// A deformation made ready for one viewer. Immutable; every call is safe from any thread. A vertex, an eye's ground, a label and a search
// all ask the same functions, so they agree to the bit.
class Deformation {
 public:
  Deformation() : Deformation({}, {0.0, 0.0}) {}
  // viewer_xy: the eye in the DEM's CRS. Throws Error(usage) for a bend or handles that are none, as BendProfile and HandleField do.
  Deformation(const DeformParameters& parameters, glm::dvec2 viewer_xy);

  // x, y, altitude in; place in the deformed world out.
  glm::dvec3 point(glm::dvec3 point) const;
  // Steps 1 to 3 alone: before the ground is bent.
  glm::dvec3 unbent(glm::dvec3 point) const;
  // Steps 1 and 2 alone: the landscape rearranged, in its own metres.
  glm::dvec3 rearranged(glm::dvec3 point) const;
  // Drop of the ground at horizontal distance d ≥ 0, m (positive is down): bend and earth curvature.
  double drop_m(double distance_m) const;
  double exaggeration(double distance_m) const;
  // Derivatives (columns: by x, y, z) of the ground's shape as light sees it: rearranged and exaggerated, but tilted neither by the bend
  // nor by an exaggeration that changes with distance.
  glm::dmat3 shape_jacobian(glm::dvec3 point) const;
  // The undeformed place that handles bring to `moved`, where there is one; Newton's method, within a millimetre.
  std::optional<glm::dvec2> source_of(glm::dvec2 moved) const;
  // Whether more than one exaggeration for all of the ground and a bend is asked for.
  bool is_local() const;
  const HandleField& handles() const { return handles_; }
  const DeformParameters& parameters() const { return parameters_; }
  glm::dvec2 viewer_xy() const { return viewer_xy_; }

 private:
  double distance_m(glm::dvec3 point) const;
  double raised_by_summits_m(glm::dvec3 point) const;

  DeformParameters parameters_;
  glm::dvec2 viewer_xy_;
  BendProfile bend_;
  HandleField handles_;
};

// bend_drop_m and deform_point are Deformation::drop_m and ::point for a single use.
double bend_drop_m(const DeformParameters& parameters, double distance_m);
glm::dvec3 deform_point(glm::dvec3 point, glm::dvec2 viewer_xy, const DeformParameters& parameters);

// Vertices that moved in three dimensions; vertex (x, y) belongs to cell centre (x, y) of the DEM and so keeps its undeformed
// place. Positions are relative to `origin`, subtracted in double before they become float.
struct SurfaceWindow;
struct DeformedSurface {
  Grid<glm::vec3> vertices_m;
  glm::dvec3 origin;
  std::vector<SurfaceWindow> windows;  // of finer cells; each lies inside the one before, the first inside this surface
};

// A finer piece of a surface, in the place of cells of the one before it: post (x, y) of its part lies on post (x / 2, y / 2) there, where
// both are even. Posts along the part's edge that the coarser side does not have are not met: a facet there goes on to the next one that
// both have, so both sides share their edges to the bit and no ray slips between them.
struct SurfaceWindow {
  DeformedSurface surface;  // without windows; posts around the part are for derivatives alone
  PixelRect part;           // of its posts that is traced: an odd number of them either way, 5 or more
  PixelRect replaces;       // posts of the surface before it that are the part's corners; the cells between them are not traced
};

// Makes the posts along the part's edge those of the surface that it is laid into.
void join_window(SurfaceWindow& window, const DeformedSurface& coarser);

// Deformation::point of every vertex (which differs from it by the rounding to float alone). origin: usually the eye's place at altitude 0.
DeformedSurface deform(const Grid<float>& altitude_m, const GeoTransform& transform, glm::dvec3 origin, const Deformation& deformation);
DeformedSurface deform(const Grid<float>& altitude_m, const GeoTransform& transform, glm::dvec2 viewer_xy, glm::dvec3 origin,
                       const DeformParameters& parameters);

}  // namespace belvedere
