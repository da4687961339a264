#include "http/tls.h"

#include "base/error.h"

namespace hl {

namespace ssl = boost::asio::ssl;

std::shared_ptr<ssl::context> makeServerTls(const TlsFiles& files) {
  if (files.certificate.empty() || files.key.empty()) {
    throw Error("TLS needs both a certificate and a key file (PEM); one of them is not given");
  }
  auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_3_VERSION);
  // Nothing is resumed: sessions are long, and tickets would be one more secret to keep.
  SSL_CTX_set_num_tickets(context->native_handle(), 0);
  boost::system::error_code error;
  context->use_certificate_chain_file(files.certificate, error);
  if (error) throw Error(files.certificate + ": no PEM certificate can be read from it (" + error.message() + ")");
  context->use_private_key_file(files.key, ssl::context::pem, error);
  if (error) {
    throw Error(files.key + ": no PEM key can be read from it that fits " + files.certificate + " (" + error.message() +
                ")");
  }
  return context;
}

}  // namespace hl
