// NullSessionHost: a server that shows its scene to pages and takes no HL clients.
#pragma once

#include <memory>
#include <string>

#include "base/error.h"
#include "server/client_session.h"

namespace hl {

class NullSessionHost : public SessionHost {
 public:
  std::unique_ptr<ClientSession> connect(const std::string&, WakeCarrier) override {
    throw Error("this server takes no HL clients");
  }
};

}  // namespace hl
