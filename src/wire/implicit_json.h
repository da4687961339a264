// An implicit surface that is written as JSON, as programs give it.
#pragma once

#include <google/protobuf/util/json_util.h>
#include <hl.pb.h>

#include <string>

#include "base/error.h"
#include "wire/json_words.h"

namespace hl {

/// As scene files write it. Throws hl::Error, one line, for what is no such JSON.
inline proto::Implicit implicitOfJson(const std::string& json) {
  proto::Implicit result;
  const auto status = google::protobuf::util::JsonStringToMessage(json, &result);
  if (status.ok()) return result;
  throw Error("no JSON of an implicit surface: " + faultOfJson(std::string(status.message())).line());
}

}  // namespace hl
