#include "tests/support/tls_identity.hpp"

#include <memory>
#include <stdexcept>

#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

namespace godwit::test {
namespace {

template <auto Free>
struct freed_by {
  template <class T>
  void operator()(T* object) const {
    Free(object);
  }
};
using key_handle = std::unique_ptr<EVP_PKEY, freed_by<EVP_PKEY_free>>;
using certificate_handle = std::unique_ptr<X509, freed_by<X509_free>>;
using text_handle = std::unique_ptr<BIO, freed_by<BIO_free>>;
using extension_handle = std::unique_ptr<X509_EXTENSION, freed_by<X509_EXTENSION_free>>;

void require(bool holds) {
  if (!holds)
    throw std::runtime_error("OpenSSL does not make the certificate of a test");
}

std::string content_of(BIO* text) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(text, &data); // NOLINT(*-cstyle-cast): a macro
  return {data, static_cast<std::size_t>(size)};
}

text_handle as_text(const std::string& pem) {
  return text_handle(::BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
}

void add_extension(X509* to, int kind, const std::string& value) {
  const extension_handle made(::X509V3_EXT_conf_nid(nullptr, nullptr, kind, value.c_str()));
  require(made && ::X509_add_ext(to, made.get(), -1) == 1);
}

std::string joined(const std::vector<std::string>& hosts) {
  std::string all;
  for (const auto& each : hosts)
    all += (all.empty() ? "" : ",") + each;
  return all;
}

void describe(X509* made, EVP_PKEY* key, const certificate_request& wanted) {
  unsigned char serial = 0;
  require(::RAND_bytes(&serial, 1) == 1 && ::X509_set_version(made, 2) == 1);
  ::ASN1_INTEGER_set(::X509_get_serialNumber(made), serial + 1L);
  ::X509_gmtime_adj(::X509_getm_notBefore(made), wanted.begins_s);
  ::X509_gmtime_adj(::X509_getm_notAfter(made), wanted.ends_s);
  require(::X509_set_pubkey(made, key) == 1);
  const auto* name = reinterpret_cast<const unsigned char*>(wanted.common_name.c_str());
  ::X509_NAME_add_entry_by_txt(::X509_get_subject_name(made), "CN", MBSTRING_UTF8, name, -1, -1, 0);
  add_extension(made, NID_basic_constraints, wanted.is_issuer ? "critical,CA:TRUE" : "critical,CA:FALSE");
  if (!wanted.hosts.empty())
    add_extension(made, NID_subject_alt_name, joined(wanted.hosts));
}

tls_identity to_pem(X509* certificate, EVP_PKEY* key) {
  const text_handle certificate_text(::BIO_new(::BIO_s_mem()));
  const text_handle key_text(::BIO_new(::BIO_s_mem()));
  require(::PEM_write_bio_X509(certificate_text.get(), certificate) == 1);
  require(::PEM_write_bio_PrivateKey(key_text.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1);
  return {content_of(certificate_text.get()), content_of(key_text.get())};
}

} // namespace

tls_identity make_tls_identity(const certificate_request& wanted, const tls_identity* issuer) {
  const key_handle key(EVP_EC_gen("P-256"));
  const certificate_handle made(::X509_new());
  require(key && made);
  describe(made.get(), key.get(), wanted);
  if (issuer == nullptr) {
    require(::X509_set_issuer_name(made.get(), ::X509_get_subject_name(made.get())) == 1);
    require(::X509_sign(made.get(), key.get(), ::EVP_sha256()) != 0);
    return to_pem(made.get(), key.get());
  }
  const auto certificate_text = as_text(issuer->certificate);
  const auto key_text = as_text(issuer->key);
  const certificate_handle signer(::PEM_read_bio_X509(certificate_text.get(), nullptr, nullptr, nullptr));
  const key_handle signer_key(::PEM_read_bio_PrivateKey(key_text.get(), nullptr, nullptr, nullptr));
  require(signer && signer_key);
  require(::X509_set_issuer_name(made.get(), ::X509_get_subject_name(signer.get())) == 1);
  require(::X509_sign(made.get(), signer_key.get(), ::EVP_sha256()) != 0);
  return to_pem(made.get(), key.get());
}

} // namespace godwit::test
