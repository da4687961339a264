// JSON words: what protobuf says of a value in JSON, as a person needs it who knows no protobuf: what to write.
#pragma once

#include <string>

namespace hl {

/// Where it is wrong, by protobuf's names, empty for all of it; and what is wrong there.
struct JsonFault {
  std::string where, words;
  /// In one line.
  std::string line() const;
};
/// Of the message of a status that protobuf gives for JSON.
JsonFault faultOfJson(std::string message);

/// Of the part of its message behind the place: `invalid value "X" for type type.googleapis.com/hl.proto.Shade` is
/// `"X" is none of SMOOTH, FLAT`. What is not known stays as it is.
std::string plainJsonWords(const std::string& said);

/// A place with its names as documents have them: "objects[0].body.velocity_m_s" is "objects[0].body.velocityMS".
std::string jsonPlace(const std::string& place);

}  // namespace hl
