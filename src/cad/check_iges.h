// Check IGES: whether a file is whole. Its reader takes what is there of one that is cut.
#pragma once

#include <string_view>

namespace hl {

/// Throws hl::Error for a file whose last record, T, is missing or tells of more lines of entities than there are (IGES
/// 5.3, 2.2.4.5). Of a file without lines nothing is asked.
void checkIges(std::string_view bytes);

}  // namespace hl
