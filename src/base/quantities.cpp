#include "base/quantities.h"

namespace hl {

namespace {

std::string lowered(const char* name, char space) {
  std::string text = name;
  for (char& c : text) c = c == '_' ? space : static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace

std::string plainName(const QuantityInfo& info) { return lowered(info.name, ' '); }

std::string optionName(const QuantityInfo& info) { return "--" + lowered(info.name, '-'); }

}  // namespace hl
