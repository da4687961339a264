// ScenePublisher: from the frames of all clients to the one scene that the devices touch. The data's way:
//
//   ClientTable    takes frames from the clients' sessions
//   FrameBuilders  make them into objects, several clients' at once
//   ClientTable    has the objects that are ready, from all clients
//   NextScene      makes them and the base into one scene
//   TouchingLoops  take it, when they have taken the scene before; the clients whose frames it shows are told
// The old scene stays touchable meanwhile.
#pragma once

#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "session/base_scene.h"
#include "session/client_table.h"
#include "session/frame_builders.h"
#include "session/next_scene.h"
#include "session/touching_loops.h"

namespace hl {

class ScenePublisher {
 public:
  /// `base` is touchable besides what clients bring. `hands`: of several devices; null: there is one. All must outlive
  /// the publisher.
  ScenePublisher(std::shared_ptr<const Snapshot> base, std::vector<TouchSession*> devices, HandGroup* hands = nullptr);
  ~ScenePublisher() { stop(); }
  void start();
  void stop();  ///< what is not shown by then never is; safe to call twice

  /// Through which clients bring their objects.
  ClientTable& clients() { return clients_; }
  const ClientTable& clients() const { return clients_; }

  /// Shows `base` in the place of the one before, fitted to the devices anew, as soon as the loops have taken the scene
  /// before. Returns when it is shown; false: the publisher has stopped before. ClientTable::admitBase() has been
  /// asked. Any thread but the publisher's own.
  bool replaceBase(const std::shared_ptr<const Snapshot>& base);

  /// Another value for a surface of a volume of the base, by its key in the scene that is shown; 0: the only one. It is
  /// the same object, with the same surface; nothing else changes. Shown as soon as the loops have taken the scene
  /// before; of several choices the last one counts. Throws hl::Error, and changes nothing, if there is no such surface
  /// or if the value is not finite. Any thread; returns at once.
  void setIso(std::uint64_t surface, const IsoChoice& choice);

 private:
  void run();
  bool waitForLoops() const;
  void publish();
  void show(const std::shared_ptr<const Snapshot>& scene, TouchingLoops::Scenes scenes, SceneParts& parts) noexcept;
  void reportShown(const ScenePart& part);

  TouchingLoops loops_;
  ClientTable clients_;
  BaseScene base_;
  NextScene next_;
  FrameBuilders builders_;
  std::thread thread_;
};

}  // namespace hl
