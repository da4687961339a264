#include "session/frame_objects.h"

#include <utility>

#include "base/error.h"

namespace hl {

void FrameObjects::define(std::uint32_t object, std::shared_ptr<SceneItems> items) {
  if (!edit_.objects.emplace(object, std::move(items)).second)
    throw Error("object " + std::to_string(object) + " is there twice");
}

void FrameObjects::remove(std::uint32_t object) {
  edit_.deleted_objects.push_back(object);
  removed_.insert(object);
}

bool FrameObjects::isThere(std::uint32_t object) const {
  return edit_.objects.contains(object) || (!removed_.contains(object) && before(object) != nullptr);
}

SceneItems& FrameObjects::toChange(std::uint32_t object, const std::string& where) {
  if (object == 0 || !isThere(object)) throw Error(where + ": there is no object " + std::to_string(object));
  auto found = edit_.objects.find(object);
  if (found == edit_.objects.end()) found = edit_.objects.emplace(object, copyOf(*before(object), memory_)).first;
  return *found->second;
}

}  // namespace hl
