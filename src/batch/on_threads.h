// Runs work on so many threads at once, or on all that the machine has.
#pragma once

#include <oneapi/tbb/task_arena.h>

namespace hl {

/// `threads`: 0: all.
template <typename Work>
void onThreads(int threads, const Work& work) {
  oneapi::tbb::task_arena(threads == 0 ? oneapi::tbb::task_arena::automatic : threads).execute(work);
}

}  // namespace hl
