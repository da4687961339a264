// TLS of the server: TLS 1.3 only, with a certificate chain and its key from PEM files.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <memory>
#include <string>

namespace hl {

struct TlsFiles {
  std::string certificate;  ///< PEM: the server's certificate first, then the chain to its authority
  std::string key;          ///< PEM, without a passphrase
  bool empty() const { return certificate.empty() && key.empty(); }
};

/// What clients will refuse the certificate for today, in one line: it has expired, or is not valid yet; else empty.
std::string certificateWarning(const boost::asio::ssl::context& context);

/// Throws hl::Error that names the file that is missing, cannot be read, or does not fit the other.
std::shared_ptr<boost::asio::ssl::context> makeServerTls(const TlsFiles& files);

}  // namespace hl
