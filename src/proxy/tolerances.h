// Every number that tunes a tick, with its unit and its reason. Three groups say what a change of one may do:
//
//   accuracy      changes where the proxy comes to rest
//   convergence   decides by which way, and after how many steps, it gets there
//   cost          decides nothing but time
//
// "Per" names what a length scales with: the proxy radius, the gap to the finger, the size of the scene. Elsewhere are
// what the user sets (ProxySettings), rooms that are only room (kMaxContacts), and factors of mathematics.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

namespace hl {

// ---- Accuracy: what changes where the proxy comes to rest ----

namespace accuracy {

inline constexpr double kEps = std::numeric_limits<double>::epsilon();

// Skin and reach: Tolerances, below.

/// Skin: a part of the radius that no finger feels, and far more than the rounding of distances in the scene, which is
/// some units of kEps times its size.
inline constexpr double kSkinPerRadius = 1e-10;
inline constexpr double kSkinPerExtent = 512 * kEps;
/// Skins beyond the nominal radius at which the proxy is held, and within which a primitive is a contact.
inline constexpr double kReachSkins = 2, kTouchingSkins = 3;
/// By which a plane may be violated: far below the skin, far above rounding.
inline constexpr double kFeasiblePerSkin = 0.25;
/// A step shorter than this is of rounding.
inline constexpr double kRestPerExtent = 8 * kEps;

// The local minimum: tick.h, constraints.h.

/// It is reached when the step that the solver still wants is below this part of the gap: the way from the proxy to
/// the finger, which is what is felt.
inline constexpr double kRestPerGap = 1e-8;
/// A sweep is cut to this many times the size of the scene: the impact time's rounding then stays below the skin.
inline constexpr double kSweepPerExtent = 100;
/// A step that leads away from the goal by so many times the depth of the proxy below its planes is one of rounding.
inline constexpr double kMaxStrayPerDepth = 16;

// The solver: solver.h.

/// Directions whose sine is below this are the same direction to rounding: their crossing is not computed.
inline constexpr double kParallel = 1e-14;
/// Multipliers below minus this part of the distance to the goal are truly negative: such a set is not optimal.
inline constexpr double kNegative = 1e-6;
/// Part of the tolerance to which the solver itself meets its planes, so that its result passes.
inline constexpr double kStrictPerTolerance = 0.125;
/// Candidates no farther apart than so many of these are one point.
inline constexpr double kSamePoint = 4;

// The rules of the surfaces: surface_rules.h, patch.h, friction.h.

/// rad. The paper's "usually less than 30 degrees": a shaded normal farther from the true one is turned back to this.
/// Bending by beta can add up to 1/cos^2(beta) - 1 of the spring's energy, a third at 30 degrees.
inline constexpr double kShadingLimit_rad = 0.5235987755982988;
inline constexpr double kShadingLimitCos = 0.8660254037844386, kShadingLimitSin = 0.5;
/// rad. Neighbours whose shaded normals differ by more meet in a crease: the file means the edge to be seen, and felt.
inline constexpr double kCrease_rad = 0.01;
/// s. A proxy that has rested so long is stuck. Shorter than that it still slides: the encoder of a slow finger stands
/// still between two counts, 3 ms at 10 mm/s and 30 um.
inline constexpr double kStuck_s = 0.020;
/// Rounds in which a slip comes down to where the Stribeck curve balances it.
inline constexpr int kSlipRounds = 60;
/// Rounds for the place of rest on textured friction: each halves the part of the way that is left at least.
inline constexpr int kRestRounds = 20;
/// Part of the pull to which the resistance balances it there.
inline constexpr double kBalanced = 1e-12;
/// Samples of a slip for each texel that it crosses, and at most: no narrow line of friction is missed.
inline constexpr double kSamplesPerTexel = 2, kMaxSamples = 4096;
/// The way over the edge of a textured triangle that makes its neighbour the one in contact, in proxy radii: the
/// closest point of the one left behind is then farther by 1/2 (1e-4)^2 = 5e-9 radii, 50 times the skin.
inline constexpr double kOverEdge = 1e-4;

// What moves: rigid_sweep.h, pushed_proxy.h, push_out.h.

/// rad. In an object's frame the way of the proxy is taken for straight. It strays from that by R q^2 / 8 at a turn of
/// q; at this turn by 1/200 of its distance R from the axis.
inline constexpr double kMaxTurn_rad = 0.2;
/// Part of the radius at which what moves counts as met: what rests on the proxy and slides along it has not met it.
inline constexpr double kMetAt = 0.9;
/// Of the radius: what the proxy touches of a deforming mesh that carries it lies within.
inline constexpr double kTouchingDeforming = 1.1;
/// How often the room that is looked for in a pinch is halved: the last is 1/256 of the radius.
inline constexpr int kPinchHalvings = 8;

}  // namespace accuracy

// ---- Convergence: what decides by which way, and after how many steps, the proxy gets there ----

namespace convergence {

// The end of a tick: progress.h, work.h, walk.h.

/// Steps in a row that come no nearer to the goal.
inline constexpr int kMaxIdle = 8;
/// Bounding volumes, each some 5 ns, that cost as much as a look at a place and the step that follows; as a contact
/// found there; and as an exact test.
inline constexpr std::size_t kWorkPerLook = 40, kWorkPerContact = 8, kWorkPerPrimitive = 8;
/// After so many ticks in a row that ran out of work the next may do twice as much, and so on up to 16 times. About a
/// vertex of 300 triangles a second-order step does not pay off within one tick's work: the proxy would never arrive.
inline constexpr int kTicksPerDoubling = 8, kMaxDoublings = 4;

/// Reaches of the first leg of a long way. A finger at 1 m/s goes one to five in a tick.
inline constexpr double kFirstLegPerReach = 8;

// The convex steps: constraints.h, recent_cuts.h, solver.h.

/// Steps in a row with cuts. Where the finger is all but at an edge, each goes a little farther around it and away from
/// it; then it is time to come down, and for Newton's step.
inline constexpr int kMaxCutsInARow = 3;
/// A step by cuts shorter than this part of the gap goes so little that it is time to come down.
inline constexpr double kMinCutPerGap = 1e-5;
/// In the open a step by cuts so many times as long as the way slid since the last touch would mostly end at once on
/// something new.
inline constexpr double kMaxCutPerSlid = 2;
/// Reaches within which what was left still counts as a cut: a thousandth beyond.
inline constexpr double kCutNear = 1.001;
/// Among planes of so many contacts no cuts are asked for.
inline constexpr std::size_t kMaxPlanesWithCuts = 16;
/// A bound on the solver's rounds; each strictly raises the distance to the goal, so it is met only through rounding.
inline constexpr std::size_t kMaxSolverRounds = 200;

// Second-order steps on trial: curvature_step.h, trial.h, back_off.h.

/// Reaches: a tangent of 45 degrees on the obstacle. Newton's step is cut there.
inline constexpr double kLongestPerReach = 1.0;
/// Part of the plain step: below this change of it the curvature is not worth leaving the surface for.
inline constexpr double kWorthwhile = 1e-3;
/// Times the way to where a sphere or cylinder ends: a step goes a little beyond, so that the next look finds what
/// follows.
inline constexpr double kTurnedBeyond = 1.001;
/// Steps until a trial must have paid off: on its way down the proxy may meet another surface first.
inline constexpr int kMaxDescents = 8;
/// By how much steps become bolder when one has paid off, and less bold when one has not.
inline constexpr double kBolder = 2, kLessBold = 4;
/// Times the plain step: a step on trial so long is never left out.
inline constexpr double kMuchLonger = 8;
/// Failures that count: after the n-th the next 2^n tries are left out, so what never works costs next to nothing.
inline constexpr int kMaxFailures = 10;

// The passes over the rules of the surfaces: surface_rules.h, anderson_mixing.h.

/// Passes in one sub-goal; each leaves sin^2(beta) + depth / radius of what the one before did.
inline constexpr int kInnerPasses = 12;
/// Sub-goals in contact under shading or friction, in one tick; the rest is for the next.
inline constexpr int kMaxProposals = 8;
/// Beyond so many contacts at once the passes are repeated by the tick itself, with the contacts found anew.
inline constexpr std::size_t kFewContacts = 8;
/// Farther than this the guess is no better than the pass itself: the passes hardly shrink, or a kink lies between.
inline constexpr double kMaxMixing = 0.9;
/// Square of the sine between the two differences: below it they are one direction to rounding.
inline constexpr double kParallelSquared = 1e-4;

// Where a proxy begins: start_search.h, clear_place.h.

/// Places that a tick looks at.
inline constexpr int kPlacesPerTick = 2;
/// How often a place is pushed out of what it overlaps: the finger, which mostly has just come in, and any other.
inline constexpr int kPushesOfFinger = 8, kPushesOfPlace = 2;
/// So many of the things that the finger overlaps are passed through.
inline constexpr int kBeyond = 12;
/// Directions: the middles of kAcross x kAcross cells on each side of a cube, 96 in all, up to 0.4 rad apart.
inline constexpr int kAcross = 4;
/// Spheres of places: their radii in reaches are 1, sqrt 2, 2, ... up to kFarthestStart.
inline constexpr int kSpheres = 14;
/// A place to begin is no farther from the finger than so many times the reach, and some pushes.
inline constexpr double kFarthestStart = 100;
/// Part of the clearance with which a push is swept, so that its centre passes nothing however that is rounded.
inline constexpr double kPushedPart = 0.5;

// What moves: pusher.h, small_step.h, push_out.h.

/// Sweeps or small steps from one tick to the next.
inline constexpr int kMaxCarrySteps = 64;
/// Proxy radii that a mesh may deform from one tick to the next without passing: each small step goes half a radius at
/// least, where nothing pinches the proxy; half of that where friction takes it along.
inline constexpr int kMaxDeformRadii = kMaxCarrySteps / 4;
/// Part of the clearance by which objects may close in on the proxy before it is pushed out again.
inline constexpr double kCloseIn = 0.5;
/// Of a turn of at most kMaxTurn_rad, with room to spare.
inline constexpr double kArcPerChord = 1.1;
/// Reaches about the way of the proxy within which objects are looked at.
inline constexpr double kNearPerReach = 2;
/// How often the proxy is pushed out of what has come too near: mostly once, but into a corner of rounded edges it
/// comes by halves.
inline constexpr int kPushTries = 32;
/// The same for each smaller room that is looked for in a pinch.
inline constexpr int kPinchedTries = 8;

}  // namespace convergence

// ---- Cost: what decides nothing but time ----

namespace cost {

// How far a step mostly goes: walk.h.

/// Along a surface: over rough terrain most steps end within so many reaches, and others cost one more look.
inline constexpr double kSlidePerReach = 0.5;
/// A proxy that has come off a curved surface comes down on it after some hundredths of the way it slid; one that has
/// not slid falls a part of its reach.
inline constexpr double kFallPerSlide = 0.02, kFallPerReach = 0.25;

// What is kept of a search for the next: sweep_cache.h.

/// Primitives. A sweep over a million triangles, a quarter of the proxy's radius wide, meets three in the mean.
inline constexpr std::size_t kSweepRoom = 24;
/// Primitives that touch and are kept measured: mostly one or two.
inline constexpr std::size_t kMeasuredRoom = 4;

// One search for several ticks: lookahead_ball.h.

/// Ticks that a ball serves at least, and at most: its search takes as long as two sweeps.
inline constexpr double kMinBallTicks = 3, kMaxBallTicks = 6;
/// The area of the smallest triangle touched over that of the disc which the ball cuts out of its plane.
inline constexpr double kTrianglePerDisc = 0.5;
/// Contacts of a proxy that is worth a ball.
inline constexpr std::size_t kMaxBallContacts = 3;
/// Primitives in a ball that was worth it.
inline constexpr std::size_t kMaxInBall = 8;

}  // namespace cost

/// The accuracy of one scene, m. Distances in a scene of coordinates up to `extent` carry a rounding error of some
/// units of eps * extent.
struct Tolerances {
  double skin;      ///< the width within which a primitive counts as a contact
  double reach;     ///< radius at which the proxy is held; above the nominal one, so that rounding never enters it
  double swept;     ///< radius of the sweep: less by a rounding, so that on a flat surface it stops at no neighbour
  double touching;  ///< a primitive no farther than this is a contact (a plane); all others are swept
  double feasible;  ///< by which a plane may be violated
  double rest;      ///< a step shorter than this is no step

  /// rad: so far the plane of a neighbour within the skin may lean, as an edge is round: skin = radius lean^2 / 2.
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
