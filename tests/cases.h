// How many random cases a test with a fixed seed takes.
#pragma once

namespace hl::test {

/// `usual`; a tenth under the sanitizers, which slow each case ten times and more and look at how memory is used: that
/// varies less from case to case than the answers do, which the other builds judge.
constexpr int cases(int usual) {
#ifdef HL_SANITIZED
  constexpr int kShare = 10;
#else
  constexpr int kShare = 1;
#endif
  return usual / kShare;
}

}  // namespace hl::test
