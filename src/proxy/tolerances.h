// The numbers that tune a tick, with their units and reasons, in three groups:
//
//   accuracy      changes where the proxy comes to rest
//   convergence   changes the path to that point and the number of steps
//   cost          changes only the computing time
//
// "Per" in a name says what a length scales with: the proxy radius, the gap to the finger, the size of the scene. Not
// in this file: user settings (ProxySettings), capacities (kMaxContacts), mathematical constants, and how the
// compliance of a mesh is estimated between ticks (compliance_estimate.cpp, follow_deformation.cpp).
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

namespace hl {

// ---- Accuracy: where the proxy comes to rest ----

namespace accuracy {

inline constexpr double kEps = std::numeric_limits<double>::epsilon();

// Skin and reach: Tolerances, below.

/// Skin: too small to feel, and much larger than the rounding error of distances in the scene, which is a few kEps
/// times the size of the scene.
inline constexpr double kSkinPerRadius = 1e-10;
inline constexpr double kSkinPerExtent = 512 * kEps;
/// In skins beyond the nominal radius: the distance at which the proxy is held, and the distance within which a
/// primitive is a contact.
inline constexpr double kReachSkins = 2, kTouchingSkins = 3;
/// Tolerance for the violation of a plane: far below the skin, far above rounding.
inline constexpr double kFeasiblePerSkin = 0.25;
/// A shorter step is a rounding error.
inline constexpr double kRestPerExtent = 8 * kEps;

// The local minimum: tick.h, constraints.h.

/// The local minimum is reached when the solver's step is below this fraction of the gap. The gap is the vector from
/// the proxy to the finger, which determines the force.
inline constexpr double kRestPerGap = 1e-8;
/// Maximum length of a sweep, in sizes of the scene. Rounding of the impact time then stays below the skin.
inline constexpr double kSweepPerExtent = 100;
/// A step that increases the distance to the goal by more than this many times the depth of the proxy below its planes
/// is a rounding error.
inline constexpr double kMaxStrayPerDepth = 16;

// The solver: solver.h.

/// Sine of the angle below which two directions count as parallel; their intersection is not computed.
inline constexpr double kParallel = 1e-14;
/// A multiplier below minus this fraction of the distance to the goal is truly negative: the active set is not optimal.
inline constexpr double kNegative = 1e-6;
/// The solver meets its planes to this fraction of the tolerance, so that its result passes the caller's check.
inline constexpr double kStrictPerTolerance = 0.125;
/// Candidates at most this many tolerances apart are the same point.
inline constexpr double kSamePoint = 4;

// The rules of the surfaces: surface_rules.h, patch.h, friction.h.

/// rad. The paper's "usually less than 30 degrees": a shading normal at a larger angle from the true normal is limited
/// to this angle. Turning by beta can add up to 1/cos^2(beta) - 1 of the spring's energy, a third at 30 degrees.
inline constexpr double kShadingLimit_rad = 0.5235987755982988;
inline constexpr double kShadingLimitCos = 0.8660254037844386, kShadingLimitSin = 0.5;
/// rad. If the shading normals of neighbours differ by more, their edge is a crease: the model wants it to be seen and
/// felt.
inline constexpr double kCrease_rad = 0.01;
/// s. A proxy that has not slipped for this time is stuck; before that it counts as sliding. The encoder of a slow
/// finger does not change between two counts: 3 ms at 10 mm/s and 30 um.
inline constexpr double kStuck_s = 0.020;
/// A spring of a smaller part s of K is taken for this one where a force is divided by it.
inline constexpr double kMinStiffness = 1e-6;
/// N/m: the same of K, which may be 0.
inline constexpr double kMinSpring_N_m = 1e-6;
/// Part of the radius by which the goal of a proxy that a surface holds is below the surface at most (adhesion.h).
inline constexpr double kMaxLowered = 0.5;
/// Maximum number of iterations for the slip that balances the Stribeck curve.
inline constexpr int kSlipRounds = 60;
/// Maximum number of iterations for the rest point on textured friction. Each at least halves the interval.
inline constexpr int kRestRounds = 20;
/// Relative accuracy of the balance at the rest point, as a fraction of the pull.
inline constexpr double kBalanced = 1e-12;
/// Samples of a slip per texel crossed, and maximum number of samples. They ensure that no narrow line of friction is
/// missed.
inline constexpr double kSamplesPerTexel = 2, kMaxSamples = 4096;
/// Distance beyond the edge of a textured triangle, in proxy radii, at which its neighbour becomes the contact. The
/// closest point of the previous triangle is then farther away by 1/2 (1e-4)^2 = 5e-9 radii, 50 times the skin.
inline constexpr double kOverEdge = 1e-4;

// Goals that count only if they add no energy: goal_tick.h.

/// Far above the rounding of energies that are compared, far below what can be felt: a part of them, and J, what a
/// spring of 1000 N/m has at 1 nm.
inline constexpr double kEnergyRounding = 1e-12, kEnergyRounding_J = 1e-15;

// What moves: rigid_sweep.h, pushed_proxy.h, push_out.h.

/// rad. Maximum turn of an object per sweep. In the object's frame the proxy's path is approximated by a straight line.
/// For a turn of q the error is R q^2 / 8, with R the distance from the axis: at this turn R / 200.
inline constexpr double kMaxTurn_rad = 0.2;
/// Distance, as a fraction of the radius, at which a moving object counts as meeting the proxy. An object that rests on
/// the proxy and slides along it stays farther away.
inline constexpr double kMetAt = 0.9;
/// In radii: distance within which the proxy touches a deforming mesh that carries it.
inline constexpr double kTouchingDeforming = 1.1;
/// Number of times that the required clearance is halved in a pinch. The last is 1/256 of the radius.
inline constexpr int kPinchHalvings = 8;

}  // namespace accuracy

// ---- Convergence: the path to that point, and the number of steps ----

namespace convergence {

// The end of a tick: progress.h, work.h, walk.h.

/// Consecutive steps that come no nearer to the goal.
inline constexpr int kMaxIdle = 8;
/// Cost, in bounding volumes of about 5 ns each, of a look at a position including the step that follows; of a contact
/// found there; and of an exact test.
inline constexpr std::size_t kWorkPerLook = 40, kWorkPerContact = 8, kWorkPerPrimitive = 8;
/// After this many consecutive ticks that ran out of work, the limit doubles, up to 16 times. At a vertex of 300
/// triangles a second-order step does not succeed within the work of one tick: without this the proxy would never
/// arrive.
inline constexpr int kTicksPerDoubling = 8, kMaxDoublings = 4;
/// Counted at most of such ticks: more make no difference.
inline constexpr int kMostOutOfWork = kTicksPerDoubling * kMaxDoublings;

/// In reaches: the first leg of a long step. A finger at 1 m/s moves one to five reaches per tick.
inline constexpr double kFirstLegPerReach = 8;

// The convex steps: constraints.h, recent_cuts.h, solver.h.

/// Consecutive steps with cuts. If the finger is almost at an edge, each such step goes a little farther around the
/// edge and away from it. Then the proxy must come down to the surface, for Newton's step.
inline constexpr int kMaxCutsInARow = 3;
/// Minimum length of a step with cuts, as a fraction of the gap. After a shorter one the proxy should come down to the
/// surface.
inline constexpr double kMinCutPerGap = 1e-5;
/// Maximum length of a step with cuts and without contact, in lengths slid since the last contact. A longer one would
/// usually end at once at a new primitive.
inline constexpr double kMaxCutPerSlid = 2;
/// In reaches: distance up to which a primitive can still be a cut, 0.1% beyond the reach.
inline constexpr double kCutNear = 1.001;
/// Maximum number of planes together with cuts; with more there are no cuts.
inline constexpr std::size_t kMaxPlanesWithCuts = 16;
/// Maximum number of rounds of the solver. Each round increases the distance to the goal, so only rounding errors can
/// reach the limit.
inline constexpr std::size_t kMaxSolverRounds = 200;

// Second-order steps on trial: curvature_step.h, trial.h, back_off.h.

/// In reaches: maximum length of Newton's step, the tangent of 45 degrees on the obstacle.
inline constexpr double kLongestPerReach = 1.0;
/// Minimum change of the plain step by the curvature, relative to the plain step. A smaller change is not worth leaving
/// the surface.
inline constexpr double kWorthwhile = 1e-3;
/// Maximum length of a step along a sphere or cylinder, relative to the distance to its end. It goes a little beyond
/// the end so that the next look finds the next feature.
inline constexpr double kTurnedBeyond = 1.001;
/// Plain steps until a trial must have succeeded. The proxy may meet another surface first.
inline constexpr int kMaxDescents = 8;
/// Factor on the trial step after a success, and divisor after a failure.
inline constexpr double kBolder = 2, kLessBold = 4;
/// A trial step this many times as long as the plain step is never skipped.
inline constexpr double kMuchLonger = 8;
/// Maximum number of failures counted. After the n-th failure 2^n tries are skipped, so a method that never works costs
/// almost nothing.
inline constexpr int kMaxFailures = 10;

// The passes over the rules of the surfaces: surface_rules.h, anderson_mixing.h.

/// Maximum number of passes per sub-goal. Each leaves sin^2(beta) + depth / radius of the error of the one before.
inline constexpr int kInnerPasses = 12;
/// Sub-goals per tick under shading or friction. The rest is left to the next tick.
inline constexpr int kMaxProposals = 8;
/// With more contacts each pass is a step of the tick, with contacts gathered anew.
inline constexpr std::size_t kFewContacts = 8;
/// Maximum mixing coefficient. A larger one gives no better guess than the pass itself: the passes converge too slowly,
/// or there is a kink between them.
inline constexpr double kMaxMixing = 0.9;
/// Squared sine of the angle between the two differences, below which they are parallel to rounding.
inline constexpr double kParallelSquared = 1e-4;

// Where a proxy begins: start_search.h, clear_place.h.

/// Candidate positions per tick.
inline constexpr int kPlacesPerTick = 2;
/// Maximum number of pushes of a candidate out of what it overlaps: for the finger, which usually has just entered a
/// surface, and for any other candidate.
inline constexpr int kPushesOfFinger = 8, kPushesOfPlace = 2;
/// Number of primitives overlapping the finger whose far side is tried.
inline constexpr int kBeyond = 12;
/// Directions: the centres of kAcross x kAcross cells on each side of a cube, 96 in all, up to 0.4 rad apart.
inline constexpr int kAcross = 4;
/// Number of spheres of candidates. Their radii in reaches are 1, sqrt 2, 2, ... up to kFarthestStart.
inline constexpr int kSpheres = 14;
/// In reaches: maximum distance of a candidate from the finger, not counting the pushes.
inline constexpr double kFarthestStart = (1 << (kSpheres - 1) / 2) * (kSpheres % 2 == 0 ? M_SQRT2 : 1);
/// Radius of the sweep of a push, as a fraction of the clearance. Despite rounding, the centre then crosses no surface.
inline constexpr double kPushedPart = 0.5;

// What moves: pusher.h, small_step.h, push_out.h.

/// Maximum number of sweeps or small steps between two ticks.
inline constexpr int kMaxCarrySteps = 64;
/// Maximum deformation of a mesh between two ticks, in proxy radii, at which it cannot pass the proxy. Each small step
/// covers at least half a radius if nothing pinches the proxy, and half of that if friction carries it along.
inline constexpr int kMaxDeformRadii = kMaxCarrySteps / 4;
/// Fraction of the clearance by which objects may approach before the proxy is pushed out again.
inline constexpr double kCloseIn = 0.5;
/// Upper bound of arc over chord for a turn of at most kMaxTurn_rad, with a margin.
inline constexpr double kArcPerChord = 1.1;
/// In reaches: margin around the proxy's path within which objects are considered.
inline constexpr double kNearPerReach = 2;
/// Maximum number of pushes out of what has come too near. One is usually enough, but in a corner of rounded edges the
/// remaining overlap only halves with each push.
inline constexpr int kPushTries = 32;
/// The same for each reduced clearance in a pinch.
inline constexpr int kPinchedTries = 8;
/// In reaches: distance of the places on the way out of matter (leave_matter.h); larger where that would be too many.
inline constexpr double kSitePerReach = 0.5;
/// Places on the way out of matter, and how many of them may be looked at for what is near.
inline constexpr int kMaxSites = 512, kMaxClearances = 128;

}  // namespace convergence

// ---- Cost: only the computing time ----

namespace cost {

// The typical length of a step: walk.h.

/// In reaches, along a surface. On rough terrain most steps are shorter; a longer one costs one more look.
inline constexpr double kSlidePerReach = 0.5;
/// A proxy that has left a curved surface meets it again after some hundredths of the way that it slid. A proxy that
/// has not slid falls a fraction of its reach.
inline constexpr double kFallPerSlide = 0.02, kFallPerReach = 0.25;

// What is kept of a search for the next one: sweep_cache.h.

/// Primitives, of a sweep or a ball. A sweep over a million triangles, each a quarter of the proxy's radius wide, meets
/// three on average; a ball in a volume of cells as large contains fifty.
inline constexpr std::size_t kSweepRoom = 128;
/// Contacts that a sweep leaves out.
inline constexpr std::size_t kKnownRoom = 24;
/// Contacts whose closest points are kept: usually one or two.
inline constexpr std::size_t kMeasuredRoom = 4;

// One search for several ticks: lookahead_ball.h.

/// Minimum and maximum number of ticks for which a ball is made. Its search costs as much as two sweeps.
inline constexpr double kMinBallTicks = 3, kMaxBallTicks = 6;
/// Area of the smallest triangle in contact, divided by the area of the disc that the ball cuts out of its plane.
inline constexpr double kTrianglePerDisc = 0.5;
/// Maximum number of contacts for which a ball is made.
inline constexpr std::size_t kMaxBallContacts = 3;
/// Maximum number of primitives in a useful ball.
inline constexpr std::size_t kMaxInBall = 8;
/// The same three where a search makes the primitives of cells: a search of a volume costs as much as 50 tests of
/// primitives that are known. The disc is in squares of a cell.
inline constexpr double kMinBallTicksInCells = 2, kDiscPerCell = 8;
inline constexpr std::size_t kMaxInBallOfCells = 96;

}  // namespace cost

/// Tolerances for one scene, m. With coordinates up to `extent`, distances have a rounding error of a few eps * extent.
struct Tolerances {
  double skin;      ///< the width within which a primitive counts as a contact
  double reach;     ///< distance at which the proxy is held; above the nominal radius, so that rounding never enters it
  double swept;     ///< radius of the sweep: smaller by the rounding error, so that on a flat surface it stops at no
                    ///< neighbour
  double touching;  ///< a primitive up to this distance is a contact (a plane); all others are swept
  double feasible;  ///< allowed violation of a plane
  double rest;      ///< a shorter step is no step

  /// rad: maximum tilt of the plane of a neighbour within the skin, as an edge is rounded: skin = radius lean^2 / 2.
  double lean() const { return std::sqrt(2 * skin / (reach - accuracy::kReachSkins * skin)); }

  static Tolerances of(double radius, double extent) {
    using namespace accuracy;
    const double skin = kSkinPerRadius * radius + kSkinPerExtent * (extent + radius);
    const double rest = kRestPerExtent * (extent + radius);
    const double reach = radius + kReachSkins * skin;
    return {skin, reach, reach - rest, radius + kTouchingSkins * skin, kFeasiblePerSkin * skin, rest};
  }
};

}  // namespace hl
