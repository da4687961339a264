#include "ros/enclave.h"

#include "base/error.h"
#include "ros/governance.h"
#include "ros/pem.h"

namespace hl {

Enclave readEnclave(const std::filesystem::path& folder, std::uint32_t domain) {
  const auto named = [&](const char* file) { return (folder / file).string(); };
  const auto read = [&](const char* file) { return textOfKeyFile(folder / file); };
  const Enclave enclave{read("identity_ca.cert.pem"),    read("cert.pem"),       read("key.pem"),
                        read("permissions_ca.cert.pem"), read("governance.p7s"), read("permissions.p7s")};
  const Certificate identity_ca = certificateOf(enclave.identity_ca, named("identity_ca.cert.pem"));
  const Certificate certificate = certificateOf(enclave.certificate, named("cert.pem"));
  const Key key = keyOf(enclave.key, named("key.pem"));
  if (X509_check_private_key(certificate.get(), key.get()) != 1)
    throw Error(named("key.pem") + " is not the key of the cert.pem beside it");
  requireMadeBy(*certificate, *identity_ca, named("cert.pem"), named("identity_ca.cert.pem"));
  const Certificate permissions_ca = certificateOf(enclave.permissions_ca, named("permissions_ca.cert.pem"));
  verifiedText(enclave.permissions, *permissions_ca, named("permissions.p7s"));
  requireProtection(verifiedText(enclave.governance, *permissions_ca, named("governance.p7s")), domain,
                    named("governance.p7s"));
  return enclave;
}

}  // namespace hl
