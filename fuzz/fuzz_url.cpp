// Addresses of servers and of Haply's service, as users write them.
#include "client/server_address.h"
#include "client/server_url.h"
#include "device/haply/haply_link.h"
#include "refusal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string url = hl::fuzz::textOf(data, size);
  hl::fuzz::takes([&] { hl::client::parseServerUrl(url); });
  hl::fuzz::takes([&] { hl::parseServerAddress(url).text(); });
  hl::fuzz::takes([&] { hl::HaplyAddress::parse(url).text(); });
  return 0;
}
