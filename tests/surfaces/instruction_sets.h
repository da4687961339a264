// Code that is compiled once for each instruction set, with each that this machine has.
#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace hl::test {

template <typename Test>
void withEachInstructionSet(const Test& run) {
  for (std::int64_t rest = hwy::SupportedTargets() | HWY_SCALAR; rest != 0; rest &= rest - 1) {
    const std::int64_t target = rest & -rest;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    run();
    hwy::SetSupportedTargetsForTest(0);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace hl::test
