// Replay: runs the recorded session again, the real proxy loop and the real servo step on the recorded samples and
// times, and holds what comes out against what is recorded, bit for bit.
#pragma once

#include <string>
#include <vector>

#include "record/replay_report.h"

namespace hl {

/// Throws hl::Error when the file is no recording, or one of another version.
ReplayReport replay(const std::string& path, const StepVisitor& visit = {});

/// The recordings of all devices of one session: of a scene with bodies what all hands do to them is made again. A
/// report for each, in this order. Throws as replay(), and where they are not of one session.
std::vector<ReplayReport> replayTogether(const std::vector<std::string>& paths);

}  // namespace hl
