#include "read_frame.h"

#include <utility>

#include "base/error.h"
#include "bodies/scene_world.h"
#include "scene/by_key.h"
#include "scene/editable_scene.h"
#include "scene/follow_on.h"
#include "session/check_bodies.h"
#include "session/decode_frame.h"
#include "session/message_size.h"
#include "touch.h"

namespace hl::fuzz {

namespace {

SceneLimits smallLimits() {
  SceneLimits limits;
  limits.objects = 64;
  limits.scene_bytes = 500'000;
  limits.instances = 64;
  limits.texture_bytes = 1U << 16;
  limits.nesting = 8;
  return limits;
}

// What a client has in the world before the frame comes, so that the frame can move, overwrite and delete things.
SceneEdit framesBefore() {
  Model model;
  model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  model.triangles = {{0, 1, 2}};
  SceneItem shape, call;
  shape.shape = makeShape(std::move(model));
  call.call = 1;
  SceneEdit edit;
  edit.objects[1] = std::make_shared<SceneItems>(1, std::move(shape));
  edit.world = std::make_shared<SceneItems>(1, std::move(call));
  return edit;
}

std::vector<Pose> posesOf(const EditableScene& scene) {
  std::vector<Pose> poses;
  for (const PlacedShape& placed : scene.placed()) poses.push_back(placed.pose);
  return poses;
}

}  // namespace

void readMessage(MessageForm form, std::string_view bytes) {
  proto::ClientMessage message;
  if (form == MessageForm::kBinary) outlineOf(bytes);
  const std::string refusal = decodeMessage(form, bytes, message);
  if (!refusal.empty()) {
    require(refusal.find('\n') == std::string::npos);
    return;
  }
  Uploads uploads;
  if (message.has_upload()) uploads[message.upload().id()].push_back(message.upload().part());
  for (const proto::Upload& upload : message.uploads().parts()) uploads[upload.id()].push_back(upload.part());
  const MemoryBudget budget(std::uint64_t{1} << 20);
  EditableScene scene(1, smallLimits(), budget);
  scene.apply(framesBefore());
  const std::vector<Pose> before = posesOf(scene);
  const std::vector<Instance> shown = followOn(scene.placed(), {}, 0, 0).instances;
  try {
    DecodedFrame frame = decodeFrame(message.frame(), uploads, smallLimits(), budget, [](double) {});
    EditableScene::Next next = scene.prepare(std::move(frame.edit));
    checkBodies(next.placed());
    scene.show(next);
  } catch (const Error& error) {
    require(posesOf(scene) == before && error.what()[0] != '\0');
    return;
  }
  constexpr std::int64_t kMove_ns = 3'000'000;
  const auto snapshot = makeSnapshot(followOn(scene.placed(), pointersByKey(shown), 0, kMove_ns).instances, {}, 1,
                                     kAbruptBlend_ns, {Vec3(0, -9.81, 0), scene.placed().joints});
  touch(*snapshot);
  if (const auto world = worldOf(*snapshot)) checkWorld(*world);
}

}  // namespace hl::fuzz
