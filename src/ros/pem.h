// Keys, certificates and signed texts of DDS Security, by OpenSSL: PEM and S/MIME, with the curve P-256 (prime256v1),
// as DDS Security 1.1 (9.3.1) and SROS2 have them.
#pragma once

#include <openssl/evp.h>
#include <openssl/x509.h>

#include <filesystem>
#include <memory>
#include <string>

namespace hl {

using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;

/// What makes certificates: the authority that others trust.
struct Authority {
  Key key;
  Certificate certificate;
};

/// A new one. Throws hl::Error when OpenSSL makes none; so do all below.
Key makeKey();
/// Valid from a day ago, as clocks differ, for ten years, as those of SROS2. `name`: its common name.
Certificate makeAuthorityCertificate(EVP_PKEY& key, const std::string& name);
Certificate makeCertificate(EVP_PKEY& key, const std::string& name, const Authority& authority);

/// Of a file that holds one of these. Throws hl::Error when it is not there or cannot be one.
std::string textOfKeyFile(const std::filesystem::path& file);
std::string pemOf(EVP_PKEY& key);
std::string pemOf(X509& certificate);
/// `name`: of the file, for the message. Throws hl::Error for what is none, and for a key with a passphrase.
Key keyOf(const std::string& pem, const std::string& name);
Certificate certificateOf(const std::string& pem, const std::string& name);

/// The text with its signature, as S/MIME.
std::string signedText(const std::string& text, const Authority& authority);
/// The text again. Throws hl::Error when the authority has not signed it.
std::string verifiedText(const std::string& smime, X509& authority, const std::string& name);
/// Throws hl::Error when the authority has not made this certificate, or its time is over or has not come.
void requireMadeBy(X509& certificate, X509& authority, const std::string& name, const std::string& authority_name);
/// When the certificate begins and ends to count, as permissions of DDS Security write it: 2030-01-31T12:00:00.
std::string beginOf(const X509& certificate);
std::string endOf(const X509& certificate);

}  // namespace hl
