#include "ros/pem.h"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <array>
#include <cstdint>
#include <ctime>

#include "base/error.h"
#include "base/plain_file.h"

namespace hl {

namespace {

constexpr long kDay_s = 86'400, kYears_s = 3650 * kDay_s;

using Bio = std::unique_ptr<BIO, decltype(&BIO_free)>;
using Pkcs7 = std::unique_ptr<PKCS7, decltype(&PKCS7_free)>;
using Store = std::unique_ptr<X509_STORE, decltype(&X509_STORE_free)>;

Bio emptyBio() { return {BIO_new(BIO_s_mem()), BIO_free}; }
Bio bioOf(const std::string& text) { return {BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), BIO_free}; }

std::string textOf(BIO& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(&bio, &data);
  return {data, static_cast<std::size_t>(size)};
}

void require(bool done, const char* what) {
  if (done) return;
  std::array<char, 256> reason;
  ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
  throw Error(std::string("OpenSSL ") + what + ": " + reason.data());
}

void addExtension(X509& certificate, X509& issuer, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, &issuer, &certificate, nullptr, nullptr, 0);
  const std::unique_ptr<X509_EXTENSION, decltype(&X509_EXTENSION_free)> extension(
      X509V3_EXT_conf_nid(nullptr, &context, kind, value), X509_EXTENSION_free);
  require(extension != nullptr && X509_add_ext(&certificate, extension.get(), -1) == 1, "adds no extension");
}

// 63 random bits: no two certificates of an authority have the same number.
void setNumber(X509& certificate) {
  std::uint64_t number = 0;
  require(RAND_bytes(reinterpret_cast<unsigned char*>(&number), sizeof number) == 1, "has no random numbers");
  require(ASN1_INTEGER_set_uint64(X509_get_serialNumber(&certificate), number >> 1U | 1U) == 1, "sets no number");
}

// With nothing but the signature.
Certificate unsignedCertificate(EVP_PKEY& key, const std::string& name) {
  Certificate certificate(X509_new(), X509_free);
  constexpr long kVersion3 = 2;
  X509_set_version(certificate.get(), kVersion3);
  setNumber(*certificate);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -kDay_s);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), kYears_s);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(name.c_str());
  require(
      X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate.get()), "CN", MBSTRING_UTF8, bytes, -1, -1, 0) == 1,
      "takes no such name");
  require(X509_set_pubkey(certificate.get(), &key) == 1, "takes no such key");
  return certificate;
}

std::string timeOf(const ASN1_TIME* time) {
  std::tm parts{};
  require(ASN1_TIME_to_tm(time, &parts) == 1, "reads no time of a certificate");
  std::array<char, 32> text;
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts)};
}

Store storeOf(X509& authority) {
  Store store(X509_STORE_new(), X509_STORE_free);
  require(X509_STORE_add_cert(store.get(), &authority) == 1, "keeps no certificate");
  return store;
}

}  // namespace

Key makeKey() {
  Key key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  require(key != nullptr, "makes no key");
  return key;
}

Certificate makeAuthorityCertificate(EVP_PKEY& key, const std::string& name) {
  Certificate certificate = unsignedCertificate(key, name);
  X509_set_issuer_name(certificate.get(), X509_get_subject_name(certificate.get()));
  addExtension(*certificate, *certificate, NID_basic_constraints, "critical,CA:TRUE,pathlen:1");
  require(X509_sign(certificate.get(), &key, EVP_sha256()) != 0, "signs no certificate");
  return certificate;
}

Certificate makeCertificate(EVP_PKEY& key, const std::string& name, const Authority& authority) {
  Certificate certificate = unsignedCertificate(key, name);
  X509_set_issuer_name(certificate.get(), X509_get_subject_name(authority.certificate.get()));
  addExtension(*certificate, *authority.certificate, NID_basic_constraints, "CA:FALSE");
  require(X509_sign(certificate.get(), authority.key.get(), EVP_sha256()) != 0, "signs no certificate");
  return certificate;
}

std::string textOfKeyFile(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMaxBytes = 1U << 20U;
  const std::string name = file.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw Error("there is no file " + name + ": hl keys makes folders with all that is needed");
  if (std::filesystem::file_size(file, error) > kMaxBytes || error) throw Error(name + " is too large for keys");
  std::string text = contentOf(name).value_or("");
  if (text.empty()) throw Error(name + " cannot be read, or is empty");
  return text;
}

std::string pemOf(EVP_PKEY& key) {
  const Bio bio = emptyBio();
  require(PEM_write_bio_PrivateKey(bio.get(), &key, nullptr, nullptr, 0, nullptr, nullptr) == 1, "writes no key");
  return textOf(*bio);
}

std::string pemOf(X509& certificate) {
  const Bio bio = emptyBio();
  require(PEM_write_bio_X509(bio.get(), &certificate) == 1, "writes no certificate");
  return textOf(*bio);
}

Key keyOf(const std::string& pem, const std::string& name) {
  // Nobody is there to be asked for a passphrase.
  const auto none = [](char*, int, int, void*) { return -1; };
  Key key(PEM_read_bio_PrivateKey(bioOf(pem).get(), nullptr, none, nullptr), EVP_PKEY_free);
  if (key == nullptr) throw Error(name + " has no private key in PEM without a passphrase");
  return key;
}

Certificate certificateOf(const std::string& pem, const std::string& name) {
  Certificate certificate(PEM_read_bio_X509(bioOf(pem).get(), nullptr, nullptr, nullptr), X509_free);
  if (certificate == nullptr) throw Error(name + " has no certificate in PEM");
  return certificate;
}

std::string signedText(const std::string& text, const Authority& authority) {
  constexpr int kFlags = PKCS7_TEXT | PKCS7_DETACHED;
  const Pkcs7 signature(
      PKCS7_sign(authority.certificate.get(), authority.key.get(), nullptr, bioOf(text).get(), kFlags), PKCS7_free);
  require(signature != nullptr, "signs nothing");
  const Bio out = emptyBio();
  require(SMIME_write_PKCS7(out.get(), signature.get(), bioOf(text).get(), kFlags) == 1, "writes nothing signed");
  return textOf(*out);
}

std::string verifiedText(const std::string& smime, X509& authority, const std::string& name) {
  BIO* raw_content = nullptr;
  const Pkcs7 signature(SMIME_read_PKCS7(bioOf(smime).get(), &raw_content), PKCS7_free);
  const Bio content(raw_content, BIO_free);
  if (signature == nullptr || content == nullptr) throw Error(name + " is no text signed by S/MIME");
  const Store store = storeOf(authority);
  // The authority itself has signed it: its certificate is all that counts, whatever the file brings along.
  STACK_OF(X509)* const signers = sk_X509_new_null();
  sk_X509_push(signers, &authority);
  const Bio out = emptyBio();
  const int verified =
      PKCS7_verify(signature.get(), signers, store.get(), content.get(), out.get(), PKCS7_TEXT | PKCS7_NOINTERN);
  sk_X509_free(signers);
  if (verified != 1)
    throw Error(name + " is not signed by permissions_ca.cert.pem, was changed since, or that is out of date");
  return textOf(*out);
}

void requireMadeBy(X509& certificate, X509& authority, const std::string& name, const std::string& authority_name) {
  const Store store = storeOf(authority);
  const std::unique_ptr<X509_STORE_CTX, decltype(&X509_STORE_CTX_free)> context(X509_STORE_CTX_new(),
                                                                                X509_STORE_CTX_free);
  require(X509_STORE_CTX_init(context.get(), store.get(), &certificate, nullptr) == 1, "verifies no certificate");
  if (X509_verify_cert(context.get()) == 1) return;
  const int reason = X509_STORE_CTX_get_error(context.get());
  const std::string& faulty = X509_STORE_CTX_get_error_depth(context.get()) == 0 ? name : authority_name;
  if (reason == X509_V_ERR_CERT_HAS_EXPIRED)
    throw Error(faulty + " has expired, on " + endOf(&faulty == &name ? certificate : authority) +
                " UTC: make another");
  if (reason == X509_V_ERR_CERT_NOT_YET_VALID)
    throw Error(faulty + " counts only from " + beginOf(&faulty == &name ? certificate : authority) +
                " UTC on: set the clock, or make another");
  throw Error(name + " is not made by " + authority_name + " (" + X509_verify_cert_error_string(reason) + ")");
}

std::string beginOf(const X509& certificate) { return timeOf(X509_get0_notBefore(&certificate)); }
std::string endOf(const X509& certificate) { return timeOf(X509_get0_notAfter(&certificate)); }

}  // namespace hl
