// PlacedClient: a client within the server's own process, which places shapes in the scene by itself and sends no
// frames.
#pragma once

#include <cstdint>
#include <memory>

#include "base/memory_budget.h"
#include "session/client_table.h"

namespace hl {

/// One thread at a time. Its objects go with it.
class PlacedClient {
 public:
  /// `clients` outlive it.
  PlacedClient(ClientTable& clients, std::uint32_t session, const MemoryBudget& memory);
  ~PlacedClient() { clients_.remove(scene_); }
  PlacedClient(const PlacedClient&) = delete;
  PlacedClient& operator=(const PlacedClient&) = delete;

  /// Of its objects: PlacedShape::session, and that of a key of their own.
  std::uint32_t session() const { return session_; }
  /// What it makes the server keep is counted here.
  const MemoryBudget& memory() const { return memory_; }
  /// As ClientTable::place().
  void place(PlacedShapes placed, std::int64_t move_ns) { clients_.place(scene_, std::move(placed), move_ns); }

 private:
  ClientTable& clients_;
  const std::uint32_t session_;
  const MemoryBudget memory_;
  const std::shared_ptr<ClientScene> scene_;
};

}  // namespace hl
