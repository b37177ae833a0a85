#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "terrain/deform/bend_curve.h"
#include "terrain/deform/displacement.h"
#include "terrain/deform/handles.h"
#include "terrain/io/raster.h"

namespace belvedere {

// A summit with more or less exaggeration than the ground around it.
struct SummitExaggeration {
  glm::dvec2 centre{0.0};    // undeformed position, CRS
  double radius_m = 5000.0;  // where its effect ends, > 0
  double factor = 1.3;  // 0.3…5, at the centre; falls to 1 at the radius by the quintic smoothstep,
                        // without a step or kink
  double base_m = 0.0;  // altitude that keeps its height; from 200 m above it the full factor
                        // applies, below it none
};

// A control point of the exaggeration by distance from the viewer.
struct ExaggerationPoint {
  double distance_m = 0.0;  // 0…1e8
  double factor = 1.0;      // of the exaggeration, 0.05…20
};

// Moves a point (x, y, altitude z) in this order; d is the horizontal distance from the viewer to
// its position after step 1:
//   1. handles move it in plan and raise it;
//   2. the field, at its undeformed position, turns it about the viewer by lateral / d, clockwise,
//      and raises it by upward / e(d);
//   3. summits: z += (factor - 1) share(distance) · (z - base);
//   4. exaggeration: z = base + e(d) (z - base);
//   5. bend and earth curvature: z -= drop(d).
struct DeformParameters {
  double exaggeration =
      1.0;  // 0.1…10, of all altitudes; if a background is given, up to foreground_to_m
  BendCurve bend;
  bool earth_curvature =
      false;                 // with refraction: z -= d² (1 - k) / (2 · 6371 km), not exaggerated
  double refraction = 0.13;  // k, 0…0.5
  std::optional<double>
      background_exaggeration;  // 0.1…10, from background_from_m on; between the two smoothstep
  double foreground_to_m = 32000.0;
  double background_from_m = 90000.0;
  double exaggeration_base_m = 0.0;  // altitude that the exaggeration does not move, -12000…9000
  std::vector<SummitExaggeration> summits;
  std::vector<DeformHandle> handles;
  // Factors on the exaggeration by distance, from near to far; a monotone curve joins them,
  // constant before the first and after the last. Not together with a background.
  std::vector<ExaggerationPoint> exaggeration_points;
  DisplacementParameters field;
};

// A deformation prepared for one viewer. Immutable and thread-safe. Vertices, the ground below the
// eye, labels and searches all use the same functions, so they agree to the bit.
class Deformation {
 public:
  Deformation() : Deformation({}, {0.0, 0.0}) {}
  // viewer_xy: the eye in the DEM's CRS. Throws Error(usage) for an invalid bend, handles or field,
  // as BendProfile, HandleField and DisplacementField do, and for exaggeration_points that do not
  // ascend.
  Deformation(const DeformParameters& parameters, glm::dvec2 viewer_xy);

  // From x, y, altitude to the position in the deformed world.
  glm::dvec3 point(glm::dvec3 point) const;
  // Steps 1 to 4 only: before bending.
  glm::dvec3 unbent(glm::dvec3 point) const;
  // Steps 1 to 3 only: the deformed landscape in its own metres.
  glm::dvec3 rearranged(glm::dvec3 point) const;
  // Drop of the ground at horizontal distance d ≥ 0, m (positive is down): bend and earth
  // curvature.
  double drop_m(double distance_m) const;
  double exaggeration(double distance_m) const;
  // Derivatives (columns: by x, y, z) of the ground's shape for lighting: moved and exaggerated,
  // but tilted neither by the bend nor by an exaggeration that changes with distance.
  glm::dmat3 shape_jacobian(glm::dvec3 point) const;
  // Whether steps 1 and 2 may move ground in plan, and where they move a position.
  bool moves_in_plan() const { return !handles_.is_identity() || !field_.is_identity(); }
  glm::dvec2 moved_in_plan(glm::dvec2 position) const;
  // The undeformed position that they move to `moved`, if there is one; Newton's method, within
  // a millimetre.
  std::optional<glm::dvec2> source_of(glm::dvec2 moved) const;
  // Whether there is more than one exaggeration for all of the ground and a bend.
  bool is_local() const;
  const HandleField& handles() const { return handles_; }
  const DisplacementField& field() const { return field_; }
  const DeformParameters& parameters() const { return parameters_; }
  glm::dvec2 viewer_xy() const { return viewer_xy_; }

 private:
  double distance_m(glm::dvec2 position) const;
  HandleField::Moved moved_by_handles(glm::dvec2 position) const;
  glm::dvec2 turned(glm::dvec2 position, double lateral_m) const;
  double raised_by_summits_m(glm::dvec3 point) const;

  DeformParameters parameters_;
  glm::dvec2 viewer_xy_;
  BendProfile bend_;
  HandleField handles_;
  MonotoneCurve exaggeration_curve_;
  DisplacementField field_;
};

// Vertices displaced in three dimensions; vertex (x, y) belongs to cell centre (x, y) of the DEM,
// which gives its undeformed position. Positions are relative to `origin`, subtracted in double
// before conversion to float.
struct SurfaceWindow;
struct DeformedSurface {
  Grid<glm::vec3> vertices_m;
  glm::dvec3 origin;
  std::vector<SurfaceWindow>
      windows;  // of finer cells; each lies inside the one before, the first inside this surface
};

// A refined part of a surface that replaces cells of the coarser one: post (x, y) of its part lies
// on post (x / 2, y / 2) there, if both are even. Along the part's edge, posts that the coarser
// side lacks are skipped: a facet there extends to the next post that both have, so both sides
// share their edges to the bit and no ray slips between them.
struct SurfaceWindow {
  DeformedSurface surface;  // without windows; posts around the part are only for derivatives
  PixelRect part;           // of its posts that are traced: odd counts, at least 5
  PixelRect replaces;  // posts of the coarser surface at the part's corners; the cells between them
                       // are not traced
};

// Sets the posts along the part's edge to those of the surface it replaces.
void join_window(SurfaceWindow& window, const DeformedSurface& coarser);

// Deformation::point of every vertex, rounded to float. origin: usually the eye's position at
// altitude 0.
DeformedSurface deform(const Grid<float>& altitude_m, const GeoTransform& transform,
                       glm::dvec3 origin, const Deformation& deformation);
DeformedSurface deform(const Grid<float>& altitude_m, const GeoTransform& transform,
                       glm::dvec2 viewer_xy, glm::dvec3 origin, const DeformParameters& parameters);

// Inverse of the deformation: the point (x, y, altitude) that it moves to `deformed`, if there is
// one; within a millimetre where handles and summits raise the ground, else exact up to rounding.
// Used to find the real air along a line of sight.
std::optional<glm::dvec3> undeform(const Deformation& deformation, glm::dvec3 deformed);

// A facet of the surface (see renderer/trace/tracer.h: the cell's north-western or south-eastern
// triangle) that handles or the field fold over in plan: its orientation is reversed or its posts
// are collinear. There the ground covers itself.
struct Fold {
  int column = 0;  // of the cell's north-western post
  int row = 0;
  bool south_east = false;
  glm::dvec2 position{0.0};  // undeformed centre of the facet, CRS
  glm::dvec2 moved{0.0};     // its position in the deformed world
};

// All of them, by rows. Without handles and field there are none, as all other steps move points
// only up and down.
std::vector<Fold> find_folds(const Grid<float>& altitude_m, const GeoTransform& transform,
                             const Deformation& deformation);

// Summary for messages, by the handle within whose radius they lie, the one whose centre is nearest
// in radii; all others are of the field, if there is one.
struct FoldSummary {
  std::optional<std::size_t> handle;  // index in DeformParameters::handles; none: of the field
  std::size_t facets = 0;
  glm::dvec2 centre{0.0};  // undeformed position of the fold nearest to the mean of them all
};
std::vector<FoldSummary> summarize_folds(const std::vector<Fold>& folds,
                                         const DeformParameters& deform);

}  // namespace belvedere
