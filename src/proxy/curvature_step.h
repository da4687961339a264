// Newton's step along curved configuration-space obstacles (edge cylinders, vertex spheres).
//
// Minimise 1/2 |x - finger|^2 subject to d_i(x) = R for the active contacts. With multipliers lambda_i the Hessian of
// the Lagrangian is H = I - sum lambda_i P_i / d_i, with P_i the projector on the curved directions. On the tangent
// space T of the contacts the solver's step is the gradient step z0 = T' (finger - x); Newton's step is z = (T' H T)^-1
// z0. For one sphere or cylinder, at angle theta from the line through its axis and the finger, z = R tan(theta): the
// point of the tangent straight above the solution, from which the way to the finger meets the solution exactly. If H
// is not positive, as for a finger beyond the axis of an edge, there is no minimum, and the proxy can descend on either
// side. In both cases the step ends where the sphere or cylinder ends, because from there on another feature of a
// primitive that shares the edge or vertex is the nearest. The same holds along the curve in which two obstacles meet.
#pragma once

#include <optional>
#include <span>

#include "geometry/primitive.h"
#include "proxy/contacts.h"
#include "proxy/solver.h"
#include "proxy/tolerances.h"

namespace hl {

/// The step, if an active contact is curved and the curvature matters. `boldness`: the fraction of Newton's step to
/// use, 1, or less after failures. RT-safe.
std::optional<Vec3> curvatureStep(const ContactSet& set, const SceneAt& scene, const SolverResult& proposal,
                                  const Tolerances& tolerance, double boldness);

}  // namespace hl
