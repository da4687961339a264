// FrameChanges: what a frame changes of objects that are there: vertices that move, values of volumes, compliances.
#pragma once

#include <hl.pb.h>

#include <string>

#include "session/frame_objects.h"
#include "session/frame_report.h"
#include "session/frame_shapes.h"

namespace hl {

class FrameChanges {
 public:
  /// All must outlive it.
  FrameChanges(const proto::Frame& frame, const SceneDecoder& decoder, const MemoryBudget& memory, FrameShapes& shapes,
               FrameObjects& objects, FrameReport& report)
      : frame_(frame), decoder_(decoder), memory_(memory), shapes_(shapes), objects_(objects), report_(report) {}

  /// After the frame's own objects. Throws hl::Error.
  void addTo(SceneEdit& edit) {
    addMoved();
    addIsos();
    addCompliances(edit);
  }

 private:
  void addMoved();
  void addIsos();
  void addCompliances(SceneEdit& edit);
  SceneItem& itemToMove(const proto::VertexUpdate& in, const std::string& where);
  void move(const proto::VertexUpdate& in, Model& model, const std::string& where);

  const proto::Frame& frame_;
  const SceneDecoder& decoder_;
  const MemoryBudget& memory_;
  FrameShapes& shapes_;
  FrameObjects& objects_;
  FrameReport& report_;
};

}  // namespace hl
