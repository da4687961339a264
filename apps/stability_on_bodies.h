// hl stability --body: how stiff the servo's spring may be where a device presses on a free body.
#pragma once

#include <string>
#include <vector>

namespace hl {

struct BodyStabilityPlan {
  std::vector<double> bodies_kg, rates_Hz;
  std::vector<int> delays;
  std::string csv;  ///< a file; empty: none
};

/// Measures, and prints the table. Throws hl::Error when the CSV cannot be written.
void runStabilityOnBodies(const BodyStabilityPlan& plan);

}  // namespace hl
