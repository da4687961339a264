// hl bench --bodies: steps of bodies by HL and other engines.
#pragma once

#include <string>

namespace hl {

/// `csv`: a file; empty: none. Throws hl::Error when it cannot be written.
void runBodyBench(bool peers, const std::string& csv);

}  // namespace hl
