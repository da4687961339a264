#include "scene/stretched_shapes.h"

#include "scene/model.h"

namespace hl {

// The hierarchy of a new copy is refitted from that of the copy that it replaces, or else from that of the shape.
std::shared_ptr<const Shape> StretchedCopies::of(const std::shared_ptr<const Shape>& shape, const Mat3& stretch) {
  if (stretch == Mat3::Identity()) return shape;
  const std::array<double, 6> upper{stretch(0, 0), stretch(0, 1), stretch(0, 2),
                                    stretch(1, 1), stretch(1, 2), stretch(2, 2)};
  auto& slot = used_[{shape->geometry, upper}];
  if (slot) return slot;
  const auto known = before_.find({shape->geometry, upper});
  if (shape->source) return slot = known != before_.end() ? known->second : placedShape(*shape, stretch, Vec3::Zero());
  sizes_.add(shape->model, "in the scaled copies of objects, ");
  if (known != before_.end()) return slot = known->second;
  const auto before = before_.find({shape->before, upper});
  return slot = makeCounted(memory_, bytesToMake(shape->model), [&] {
           Model model = shape->model;
           placeModel(model, {stretch, Vec3::Zero()});
           return makeShape(std::move(model), before == before_.end() ? *shape : *before->second);
         });
}

}  // namespace hl
