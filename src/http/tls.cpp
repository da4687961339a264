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

std::string certificateWarning(const ssl::context& context) {
  const X509* const certificate = SSL_CTX_get0_certificate(const_cast<ssl::context&>(context).native_handle());
  if (certificate == nullptr) return {};
  if (X509_cmp_current_time(X509_get0_notAfter(certificate)) < 0)
    return "it has expired: no client takes it; make a new one";
  if (X509_cmp_current_time(X509_get0_notBefore(certificate)) > 0)
    return "it is not valid yet: no client takes it; see this machine's clock, or make a new one";
  return {};
}

}  // namespace hl
