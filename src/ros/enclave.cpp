#include "ros/enclave.h"

#include "base/error.h"
#include "ros/governance.h"
#include "ros/pem.h"

namespace hl {

Enclave readEnclave(const std::filesystem::path& folder, std::uint32_t domain) {
  const auto nameOf = [&](const char* file) { return (folder / file).string(); };
  const auto read = [&](const char* file) { return textOfKeyFile(folder / file); };
  const Enclave enclave{read("identity_ca.cert.pem"),    read("cert.pem"),       read("key.pem"),
                        read("permissions_ca.cert.pem"), read("governance.p7s"), read("permissions.p7s")};
  const Certificate identity_ca = certificateOf(enclave.identity_ca, nameOf("identity_ca.cert.pem"));
  const Certificate certificate = certificateOf(enclave.certificate, nameOf("cert.pem"));
  const Key key = keyOf(enclave.key, nameOf("key.pem"));
  if (X509_check_private_key(certificate.get(), key.get()) != 1)
    throw Error(nameOf("key.pem") + " is not the key of the cert.pem beside it");
  requireMadeBy(*certificate, *identity_ca, nameOf("cert.pem"), nameOf("identity_ca.cert.pem"));
  const Certificate permissions_ca = certificateOf(enclave.permissions_ca, nameOf("permissions_ca.cert.pem"));
  verifiedText(enclave.permissions, *permissions_ca, nameOf("permissions.p7s"));
  requireProtection(verifiedText(enclave.governance, *permissions_ca, nameOf("governance.p7s")), domain,
                    nameOf("governance.p7s"));
  return enclave;
}

}  // namespace hl
