// Newton's step along curved configuration-space obstacles (edge cylinders, vertex spheres).
//
// Minimise 1/2 |x - finger|^2 subject to d_i(x) = R for the active contacts. With multipliers lambda_i the Lagrangian's
// Hessian is H = I - sum lambda_i P_i / d_i, P_i the projector on the curved directions. On the tangent space T of the
// contacts the solver's step is the gradient step z0 = T' (finger - x); Newton's is z = (T' H T)^-1 z0. For one sphere
// or cylinder, at angle theta from the line through its axis and the finger, z = R tan(theta): the point of the tangent
// straight above the solution, from where the way to the finger meets it exactly. Where H is not positive, as for a
// finger beyond the axis of an edge, there is no minimum to go to, but down either side. Either way the step goes no
// farther than to where the sphere or cylinder ends, as another feature of a primitive that shares the edge or vertex
// is the nearest from there on. The same along the curve in which two obstacles meet.
#pragma once

#include <span>

#include "geometry/primitive.h"
#include "proxy/contacts.h"
#include "proxy/solver.h"
#include "proxy/tolerances.h"

namespace hl {

/// The step, if curvature matters here: an active contact is curved. `boldness`: 1, or less where such steps have not
/// paid off, for a part of the step. RT-safe.
bool curvatureStep(const ContactSet& set, const SceneAt& scene, const SolverResult& proposal,
                   const Tolerances& tolerance, double boldness, Vec3& step);

}  // namespace hl
