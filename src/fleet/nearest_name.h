// Which of the names that there are was meant by one that is none of them.
#pragma once

#include <string>
#include <vector>

namespace hl {

/// The one of `names` with the fewest letters to insert, leave out, replace or swap with the next (the distance of
/// Damerau and Levenshtein, without swaps across others); empty if more than half of `name` would be wrong.
std::string nearestName(const std::string& name, const std::vector<std::string>& names);

}  // namespace hl
