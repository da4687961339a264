// JSON words: what protobuf says of a value in JSON, as a person needs it who knows no protobuf: what to write.
#pragma once

#include <string>

namespace hl {

/// Where it is wrong, by protobuf's names, empty for all of it; and what is wrong there.
struct JsonFault {
  std::string where, words;
  /// In one line, with names as documents have them: "objects[0].body.velocityMS".
  std::string line() const;
};
/// Of the message of a status that protobuf gives for JSON.
JsonFault faultOfJson(std::string message);

}  // namespace hl
