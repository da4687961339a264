// JSON flags: protobuf reads texts such as "yes" and "0" as true and false; who writes one means something else.
#pragma once

#include <string>
#include <string_view>

namespace google::protobuf {
class Descriptor;
}

namespace hl {

/// The place, as "objects[0].body.fixed", of the first value of a message in JSON that is a text and must be true or
/// false. Empty: there is none. `json` is sound.
std::string textForFlag(std::string_view json, const google::protobuf::Descriptor& message);

}  // namespace hl
