// A worker of `hl sweep`: a process that does one trace after the other.
#pragma once

#include <string>

namespace hl {

/// The first word of hl that makes it a worker; the second is the folder of results.
inline constexpr const char* kSweepWorker = "--sweep-worker";

/// What main() does then.
int runSweepWorker(const std::string& folder);

}  // namespace hl
