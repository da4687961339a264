// Made bodies: the shape and the mass of each body are made once, however many frames show it.
#pragma once

#include <cstddef>
#include <memory>

#include "bodies/world.h"
#include "scene/body_spec.h"
#include "scene/shape.h"

namespace hl {

/// As bodyOf() of the shape's model. Kept as long as the shape is; of one shape the last kMaxOfAShape of different
/// specs. By any thread.
std::shared_ptr<const Body> madeBody(const std::shared_ptr<const Shape>& shape, const BodySpec& spec);
inline constexpr std::size_t kMaxOfAShape = 64;

}  // namespace hl
