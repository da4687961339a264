// Newton's step along curved configuration-space obstacles (edge cylinders, vertex spheres).
//
// Minimise 1/2 |x - finger|^2 subject to d_i(x) = R for the active contacts. With multipliers lambda_i the Lagrangian's
// Hessian is H = I - sum lambda_i P_i / d_i, P_i the projector on the curved directions. On the tangent space T of the
// contacts the solver's step is the gradient step z0 = T' (finger - x); Newton's is z = (T' H T)^-1 z0. For one sphere
// or cylinder, at angle theta from the line through its axis and the finger, z = R tan(theta): the point of the tangent
// straight above the solution, from where the way to the finger meets it exactly.
#pragma once

#include <span>

#include "geometry/primitive.h"
#include "proxy/contacts.h"
#include "proxy/solver.h"

namespace hl {

/// The step, if curvature matters here: an active contact is curved and the minimum is near. `reach` in metres.
/// RT-safe.
bool curvatureStep(const ContactSet& set, const SceneAt& scene, const SolverResult& sub_goal, double reach, Vec3& step);

}  // namespace hl
