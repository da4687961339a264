// What is said of a model file that cannot be read.
#pragma once

#include <string>

#include "base/error.h"
#include "io/load_model.h"

namespace hl::test {

/// The text of the error; empty where the file is read.
inline std::string loadRefusal(const std::string& path) {
  try {
    loadModel(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace hl::test
