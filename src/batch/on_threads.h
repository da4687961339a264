// Runs work on so many threads at once, or on all that the machine has.
#pragma once

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace hl {

/// `threads`: 0: all; more than the machine has count as all: TBB would not start them, and an arena of a million takes
/// more memory than there is.
template <typename Work>
void onThreads(int threads, const Work& work) {
  const int most = oneapi::tbb::info::default_concurrency();
  oneapi::tbb::task_arena(threads == 0 ? most : std::min(threads, most)).execute(work);
}

}  // namespace hl
