// Enclave: what a participant of DDS Security proves itself with, in a folder as SROS2 makes it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hl {

/// As it is in the files: PEM, and S/MIME for the signed ones.
struct Enclave {
  std::string identity_ca;     ///< identity_ca.cert.pem: whoever it has made a certificate for is let in
  std::string certificate;     ///< cert.pem
  std::string key;             ///< key.pem, of the certificate; without a passphrase
  std::string permissions_ca;  ///< permissions_ca.cert.pem: its signature makes the next two count
  std::string governance;      ///< governance.p7s
  std::string permissions;     ///< permissions.p7s
};

/// Throws hl::Error, which names the file, when one is missing, does not fit the others or does not count at this time,
/// and when its governance leaves the topics of this domain open. Whether the permissions are of this certificate only
/// DDS finds out.
Enclave readEnclave(const std::filesystem::path& folder, std::uint32_t domain);

}  // namespace hl
