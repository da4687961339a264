// What a recording says of the proxy is taken only as far as a tick can work with it.
#include "record/recorded_proxy.h"

#include <gtest/gtest.h>

#include <climits>

#include "base/error.h"
#include "proxy/tolerances.h"

namespace hl::test_recorded_proxy {
namespace {

ProxyMemory takenWith(int out_of_work) {
  ProxyMemory memory;
  memory.state.out_of_work = out_of_work;
  proto::RecordedProxy message;
  toProto(memory, message);
  return fromProto(message);
}

// The limit of work is doubled by shifting it: after more ticks than are ever counted it would be shifted out.
TEST(RecordedProxy, NoMoreTicksOutOfWorkThanAreEverCounted) {
  constexpr int kMost = convergence::kMostOutOfWork;
  EXPECT_EQ(takenWith(kMost).state.out_of_work, kMost);
  for (const int wrong : {kMost + 1, 64 * convergence::kTicksPerDoubling, INT_MAX, -1})
    EXPECT_THROW(takenWith(wrong), Error) << wrong;
}

}  // namespace
}  // namespace hl::test_recorded_proxy
