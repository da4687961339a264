// Random sequences of calls against a small model of GL's rules: legal calls make no error, illegal ones exactly the
// expected one, and nothing ever crashes or sends what a server would refuse.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "client/fake_server.h"

namespace hl::client::test_random_calls {
namespace {

// What the rules say the calls' state is.
struct Model {
  bool between = false;
  HLuint defining = 0;
  int matrices = 1, attributes = 0, names = 0;
  int outer_matrices = 1, outer_attributes = 0, outer_names = 0;
  std::set<HLuint> objects;
  std::set<HLuint> kept;    // objects before the frame
  std::set<HLuint> joints;  // of the frame
};

// One random call: makes it and returns the error that GL's rules (as hl.h words them) demand.
class RandomCall {
 public:
  explicit RandomCall(Model& model) : model_(model) {}

  HLenum make() {
    switch (*rc::gen::inRange(0, 21)) {
      case 0:
        return begin();
      case 1:
        return end();
      case 2:
        hlVertex3d(number(), number(), number());
        return HL_NO_ERROR;
      case 3:
        hlNormal3d(number(), number(), number());
        return HL_NO_ERROR;
      case 4:
        return push();
      case 5:
        return pop();
      case 6:
        return newObject();
      case 7:
        return endObject();
      case 8:
        return callObject();
      case 9:
        return deleteObject();
      case 10:
        return pushPop(hlPushAttrib, HL_ALL_ATTRIB_BITS, model_.attributes, 16);
      case 11:
        return popOne(hlPopAttrib, model_.attributes);
      case 12:
        return pushPop(hlPushName, 3, model_.names, 64);
      case 13:
        return popOne(hlPopName, model_.names);
      case 14:
        return material();
      case 15:
        return notBetween([this] { hlTranslated(number(), number(), number()); });
      case 16:
        return join();
      case 17:
        return frame(*rc::gen::element(hlFlush, hlFinish, hlClear));
      case 18:
        return cancelObject();
      case 19:
        return cancelFrame();
      default:
        return notBetween([] { hlPoll(); });
    }
  }

 private:
  static double number() { return *rc::gen::inRange(-100, 100) / 16.0; }
  template <typename Call>
  HLenum notBetween(Call call) {
    call();
    return model_.between ? HL_INVALID_OPERATION : HL_NO_ERROR;
  }
  HLenum begin() {
    const auto mode = static_cast<HLenum>(*rc::gen::inRange(0, 12));
    hlBegin(mode);
    if (model_.between) return HL_INVALID_OPERATION;
    if (mode > HL_POLYGON) return HL_INVALID_ENUM;
    model_.between = true;
    return HL_NO_ERROR;
  }
  HLenum end() {
    hlEnd();
    if (!model_.between) return HL_INVALID_OPERATION;
    model_.between = false;
    return HL_NO_ERROR;
  }
  HLenum push() {
    hlPushMatrix();
    if (model_.between) return HL_INVALID_OPERATION;
    if (model_.matrices == 32) return HL_STACK_OVERFLOW;
    ++model_.matrices;
    return HL_NO_ERROR;
  }
  HLenum pop() {
    hlPopMatrix();
    if (model_.between) return HL_INVALID_OPERATION;
    if (model_.matrices == 1) return HL_STACK_UNDERFLOW;
    --model_.matrices;
    return HL_NO_ERROR;
  }
  HLenum pushPop(void (*call)(HLuint), HLuint value, int& depth, int most) {
    call(value);
    if (model_.between) return HL_INVALID_OPERATION;
    if (depth == most) return HL_STACK_OVERFLOW;
    ++depth;
    return HL_NO_ERROR;
  }
  HLenum popOne(void (*call)(), int& depth) {
    call();
    if (model_.between) return HL_INVALID_OPERATION;
    if (depth == 0) return HL_STACK_UNDERFLOW;
    --depth;
    return HL_NO_ERROR;
  }
  HLenum newObject() {
    const auto object = static_cast<HLuint>(*rc::gen::inRange(0, 5));
    hlNewObject(object);
    if (model_.between || model_.defining != 0) return HL_INVALID_OPERATION;
    if (object == 0) return HL_INVALID_VALUE;
    model_.defining = object;
    model_.outer_matrices = std::exchange(model_.matrices, 1);
    model_.outer_attributes = std::exchange(model_.attributes, 0);
    model_.outer_names = std::exchange(model_.names, 0);
    return HL_NO_ERROR;
  }
  HLenum endObject() {
    hlEndObject();
    if (model_.between || model_.defining == 0) return HL_INVALID_OPERATION;
    model_.objects.insert(model_.defining);
    leaveDefinition();
    return HL_NO_ERROR;
  }
  HLenum cancelObject() {
    hlCancelObject();
    if (model_.between || model_.defining == 0) return HL_INVALID_OPERATION;
    leaveDefinition();
    return HL_NO_ERROR;
  }
  HLenum cancelFrame() {
    hlCancelFrame();
    model_.between = false;
    if (model_.defining != 0) leaveDefinition();
    model_.objects = model_.kept;
    model_.joints.clear();
    return HL_NO_ERROR;
  }
  void leaveDefinition() {
    model_.defining = 0;
    model_.matrices = model_.outer_matrices;
    model_.attributes = model_.outer_attributes;
    model_.names = model_.outer_names;
  }
  // Definitions call only objects of lower numbers here, so that only a call of itself is a circle.
  HLenum callObject() {
    const HLuint limit = model_.defining != 0 ? model_.defining + 1 : 6;
    const HLuint object = *rc::gen::inRange<HLuint>(0, limit);
    hlCallObject(object);
    if (model_.between || (model_.defining != 0 && object == model_.defining)) return HL_INVALID_OPERATION;
    return model_.objects.contains(object) ? HL_NO_ERROR : HL_INVALID_VALUE;
  }
  HLenum deleteObject() {
    const auto object = static_cast<HLuint>(*rc::gen::inRange(0, 6));
    hlDeleteObjects(1, &object);
    if (model_.between || model_.defining != 0) return HL_INVALID_OPERATION;
    model_.objects.erase(object);
    return HL_NO_ERROR;
  }
  HLenum material() {
    const double value = number();
    hlMateriald(HL_STATIC_FRICTION, value);
    if (model_.between) return HL_INVALID_OPERATION;
    return value < 0 ? HL_INVALID_VALUE : HL_NO_ERROR;
  }
  HLenum join() {
    const HLuint joint = *rc::gen::inRange<HLuint>(0, 4), object = *rc::gen::inRange<HLuint>(0, 6);
    hlJoin(joint, object, 0, 0, 0);
    if (model_.between || model_.defining != 0) return HL_INVALID_OPERATION;
    if (joint == 0 || !model_.objects.contains(object)) return HL_INVALID_VALUE;
    return model_.joints.insert(joint).second ? HL_NO_ERROR : HL_INVALID_VALUE;
  }
  HLenum frame(void (*call)()) {
    call();
    if (model_.between || model_.defining != 0) return HL_INVALID_OPERATION;
    model_.joints.clear();
    if (call != hlClear) model_.kept = model_.objects;
    return HL_NO_ERROR;
  }

  Model& model_;
};

// The server's side of the rules: nothing is both new and deleted, and lists have the lengths they must have.
class Judge {
 public:
  void take(const proto::Frame& frame) {
    for (const proto::ObjectDefinition& object : frame.objects()) {
      const auto& deleted = frame.deleted_objects();
      RC_ASSERT(std::find(deleted.begin(), deleted.end(), object.id()) == deleted.end());
    }
    for (const proto::ObjectDefinition& object : frame.objects()) check(object.items());
    check(frame.world().items());
    std::set<HLuint> joints;
    for (const proto::WorldJoint& joint : frame.world().joints()) RC_ASSERT(joints.insert(joint.id()).second);
  }

 private:
  template <typename Items>
  void check(const Items& items) {
    for (const proto::Item& item : items) {
      const proto::Primitives& p = item.primitives();
      RC_ASSERT(p.normals_size() == 0 || p.normals_size() == p.vertices_size());
      for (const auto* list : {&p.triangles(), &p.segments(), &p.points()})
        for (const HLuint index : *list) RC_ASSERT(3 * index < static_cast<HLuint>(p.vertices_size()));
    }
  }
};

class RandomCalls : public CallsTest {};

RC_GTEST_FIXTURE_PROP(RandomCalls, MakeExactlyTheErrorsOfTheRules, ()) {
  Model model;
  RandomCall random(model);
  const int calls = *rc::gen::inRange(0, 300);
  for (int i = 0; i < calls; ++i) {
    const HLenum expected = random.make();
    // An error cannot be asked for between hlBegin and hlEnd: it is kept until then.
    if (model.between && expected == HL_NO_ERROR) continue;
    if (model.between) {
      hlEnd();
      model.between = false;
    }
    RC_ASSERT(hlGetError() == expected);
  }
  if (model.between) hlEnd();
  if (model.defining != 0) hlEndObject();
  hlFinish();
  RC_ASSERT(hlGetError() == static_cast<HLenum>(HL_NO_ERROR));
  Judge judge;
  for (const proto::Frame& frame : server->frames()) judge.take(frame);
}

}  // namespace
}  // namespace hl::client::test_random_calls
