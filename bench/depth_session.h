// Depth session: pictures of a depth camera at 30 Hz under a hand that strokes them, and what the server misses of its
// deadlines beside as much time without pictures.
#pragma once

namespace hl::bench {

/// Works on the thread's context. Windows of 5 s with pictures and without take turns, `seconds` (> 0) of each in all.
/// Returns false if no picture could be shown; hlGetError() has the reason.
bool measureDepthSession(double seconds);

}  // namespace hl::bench
