// hlGet*v, hlGetContacts and hlGetRemoteHands.
#include <hl/hl.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "client/call.h"
#include "client/queries.h"

using hl::client::call;
using hl::client::When;

namespace {

template <typename Number, typename Convert>
void get(const char* function, HLenum name, Number* values, Convert convert) {
  call(function, [&](HLcontext& context) {
    const hl::client::Values answer = hl::client::answer(context, name);
    hl::client::requirePointer(values);
    std::transform(answer.numbers.begin(), answer.numbers.begin() + answer.count, values, convert);
  });
}

HLint rounded(double value) {
  constexpr double kMin = std::numeric_limits<HLint>::min(), kMax = std::numeric_limits<HLint>::max();
  return std::isnan(value) ? 0 : static_cast<HLint>(std::clamp(std::round(value), kMin, kMax));
}

}  // namespace

void hlGetBooleanv(HLenum name, HLboolean* values) {
  get(__func__, name, values, [](double value) -> HLboolean { return value != 0 ? HL_TRUE : HL_FALSE; });
}

void hlGetIntegerv(HLenum name, HLint* values) { get(__func__, name, values, rounded); }

void hlGetFloatv(HLenum name, HLfloat* values) {
  get(__func__, name, values, [](double value) { return static_cast<HLfloat>(value); });
}

void hlGetDoublev(HLenum name, HLdouble* values) {
  get(__func__, name, values, [](double value) { return value; });
}

HLsizei hlGetContacts(HLsizei most, HLcontact* contacts) {
  return hl::client::getList(__func__, most, contacts, hl::client::contactsOf);
}

HLsizei hlGetRemoteHands(HLsizei most, HLremotehand* hands) {
  return hl::client::getList(__func__, most, hands, hl::client::remoteHandsOf);
}
