// What hlGet*v answers: a table of names, each with the function that writes its values.
#pragma once

#include <hl/hl_types.h>

#include <array>
#include <cstddef>
#include <vector>

#include "client/context.h"

namespace hl::client {

/// The values of a query: at most a matrix.
struct Values {
  std::array<double, 16> numbers{};
  std::size_t count = 0;

  void add(double value) { numbers[count++] = value; }
};

/// Throws Fault HL_INVALID_ENUM.
Values answer(const HLcontext& context, HLenum name);

/// The contacts of the newest state, the one that presses hardest first.
std::vector<HLcontact> contactsOf(const HLcontext& context);

/// The bodies of the newest state, sorted by object and name.
std::vector<HLbody> bodiesOf(const HLcontext& context);
/// Its joints, sorted by number.
std::vector<HLjoint> jointsOf(const HLcontext& context);
/// Its hands of other servers, sorted by server.
std::vector<HLremotehand> remoteHandsOf(const HLcontext& context);

}  // namespace hl::client
