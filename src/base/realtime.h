// What a thread needs to be on time: priority, memory that is there, and a core of its own.
#pragma once

#include <cstddef>
#include <string>

namespace hl {

/// Of SCHED_FIFO; above the threads of the proxy and of the drivers, which the servo must never wait for.
inline constexpr int kServoPriority = 80;
inline constexpr int kProxyPriority = 70;  ///< of ticks by another thread

/// What the machine granted; `why` is one plain sentence for each thing refused, empty when all was granted.
struct RealtimeGrant {
  bool fifo = false;           ///< the calling thread runs under SCHED_FIFO
  bool memory_locked = false;  ///< the process's, by lockProcessMemory()
  int core = -1;               ///< the only one that the thread runs on; -1: any
  std::string why;
};

/// The core for one of the threads that want one to themselves, `nth` from 0: those that the kernel keeps free
/// (isolcpus), then, where the process has four or more, the last ones. -1: none can be spared. Setup only.
int spareCore(int nth);

/// Keeps all memory of this process where it is, now and later, each page from its first use on: what a loop reads has
/// been written before, by whoever made it. For HL's own programs, before they start threads. Never from a library: the
/// memory is its host's, and with a limit on locked memory every later allocation of the host could fail.
void lockProcessMemory();

/// Reads each page of the programs and libraries of this process: code and constants that no loop is then the first to
/// need, however seldom it needs them. lockProcessMemory() does so too. Setup only, some milliseconds.
void touchPrograms();

/// What the stack of a loop has ready. A tick and a servo step use up to 0.2 MB (tests/touch/test_stack_use.cpp).
inline constexpr std::size_t kTouchedStack_bytes = std::size_t{512} * 1024;

/// Asks for SCHED_FIFO at `priority` (1..99) and `core` (-1: any) for the calling thread, and touches its stack, so
/// that no page of it has to be found later. Setup only.
RealtimeGrant requestRealtime(int priority, int core = -1);

}  // namespace hl
