#include "base/quantities.h"

#include <algorithm>

#include "base/text.h"

namespace hl {

namespace {

// "dynamic friction" of "DYNAMIC_FRICTION".
std::string spelled(const char* name, char space) {
  std::string text = lowered(name);
  std::replace(text.begin(), text.end(), '_', space);
  return text;
}

}  // namespace

std::string plainName(const QuantityInfo& info) { return spelled(info.name, ' '); }

std::string optionName(const QuantityInfo& info) { return "--" + spelled(info.name, '-'); }

}  // namespace hl
