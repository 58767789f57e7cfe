#include "io/http/server/identity.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <utility>

#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include "io/http/secret_file.hpp"
#include "io/http/url.hpp"

namespace godwit::io::http {
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
using text_handle = std::unique_ptr<BIO, freed_by<BIO_free_all>>;
using name_list = std::unique_ptr<GENERAL_NAMES, freed_by<GENERAL_NAMES_free>>;
using extension_handle = std::unique_ptr<X509_EXTENSION, freed_by<X509_EXTENSION_free>>;

constexpr const char* valid_from = "20200101000000Z";
constexpr const char* valid_until = "20491231235959Z"; // after it the form of dates changes (RFC 5280, 4.1.2.5)

text_handle over(std::string_view text) {
  return text_handle(::BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

certificate_handle read_certificate(std::string_view pem) {
  const auto text = over(pem);
  return certificate_handle(::PEM_read_bio_X509(text.get(), nullptr, nullptr, nullptr));
}

// A pass phrase is asked of nobody.
int no_pass_phrase(char*, int, int, void*) { return 0; }

key_handle read_key(std::string_view pem) {
  const auto text = over(pem);
  return key_handle(::PEM_read_bio_PrivateKey(text.get(), nullptr, no_pass_phrase, nullptr));
}

std::string_view content_of(BIO* text) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(text, &data); // NOLINT(*-cstyle-cast): a macro
  return {data, static_cast<std::size_t>(size)};
}

secret_text secret_of(std::string_view text) {
  secret_text result(text.size());
  std::ranges::copy(text, result.data());
  return result;
}

bool add_name(GENERAL_NAMES* to, const std::string& name) {
  GENERAL_NAME* const made = a2i_GENERAL_NAME(nullptr, nullptr, nullptr, is_address(name) ? GEN_IPADD : GEN_DNS,
                                              name.c_str(), 0); // NOLINT(*-pro-type-const-cast)
  if (made != nullptr && sk_GENERAL_NAME_push(to, made) > 0)
    return true;
  ::GENERAL_NAME_free(made);
  return false;
}

bool add_names(X509* to, const std::vector<std::string>& names) {
  const name_list all(::GENERAL_NAMES_new());
  return all && std::ranges::all_of(names, [&](const auto& each) { return add_name(all.get(), each); }) &&
         ::X509_add1_ext_i2d(to, NID_subject_alt_name, all.get(), 0, X509V3_ADD_DEFAULT) == 1;
}

bool add_extension(X509* to, int kind, const char* value) {
  const extension_handle made(::X509V3_EXT_conf_nid(nullptr, nullptr, kind, value));
  return made && ::X509_add_ext(to, made.get(), -1) == 1;
}

bool set_subject(X509* made) {
  const auto* const name = reinterpret_cast<const unsigned char*>("godwit");
  X509_NAME* const subject = ::X509_get_subject_name(made);
  return ::X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, name, -1, -1, 0) == 1 &&
         ::X509_set_issuer_name(made, subject) == 1;
}

bool set_serial(X509* made) {
  std::uint64_t number = 0;
  return ::RAND_bytes(reinterpret_cast<unsigned char*>(&number), sizeof(number)) == 1 &&
         ::ASN1_INTEGER_set_uint64(::X509_get_serialNumber(made), (number >> 1U) | 1U) == 1;
}

certificate_handle sign_own(EVP_PKEY* key, const std::vector<std::string>& names) {
  certificate_handle made(::X509_new());
  const bool is_done = made && ::X509_set_version(made.get(), X509_VERSION_3) == 1 && set_serial(made.get()) &&
                       set_subject(made.get()) &&
                       ::ASN1_TIME_set_string_X509(::X509_getm_notBefore(made.get()), valid_from) == 1 &&
                       ::ASN1_TIME_set_string_X509(::X509_getm_notAfter(made.get()), valid_until) == 1 &&
                       ::X509_set_pubkey(made.get(), key) == 1 &&
                       add_extension(made.get(), NID_basic_constraints, "critical,CA:FALSE") &&
                       add_extension(made.get(), NID_key_usage, "critical,digitalSignature") &&
                       add_extension(made.get(), NID_ext_key_usage, "serverAuth") && add_names(made.get(), names) &&
                       ::X509_sign(made.get(), key, ::EVP_sha256()) != 0;
  return is_done ? std::move(made) : nullptr;
}

tl::unexpected<error> no_openssl() {
  return failure(errc::invalid_settings, "OpenSSL makes no certificate of it: is one of its names none?",
                 "certificate of the server");
}

result<server_identity> sign_anew(EVP_PKEY* key, const std::vector<std::string>& names) {
  const auto made = sign_own(key, names);
  const text_handle certificate(::BIO_new(::BIO_s_mem()));
  const text_handle secret(::BIO_new(::BIO_s_secmem()));
  if (!made || !certificate || !secret || ::PEM_write_bio_X509(certificate.get(), made.get()) != 1 ||
      ::PEM_write_bio_PrivateKey(secret.get(), key, nullptr, nullptr, 0, nullptr, nullptr) != 1)
    return no_openssl();
  return server_identity{std::string(content_of(certificate.get())), secret_of(content_of(secret.get()))};
}

bool has_name(X509* certificate, const std::string& name) {
  return (is_address(name) ? ::X509_check_ip_asc(certificate, name.c_str(), 0)
                           : ::X509_check_host(certificate, name.c_str(), name.size(), 0, nullptr)) == 1;
}

bool is_there(const std::string& file) {
  struct stat found {};
  return ::lstat(file.c_str(), &found) == 0 || errno != ENOENT;
}

result<kept_identity> store(const std::string& file, result<server_identity> made) {
  if (!made)
    return tl::make_unexpected(made.error());
  secret_text both(made->key.revealed().size() + made->certificate.size());
  std::ranges::copy(made->certificate, std::ranges::copy(made->key.revealed(), both.data()).out);
  if (auto stored = store_secret_file(file, both.revealed(), errc::invalid_settings); !stored)
    return tl::make_unexpected(stored.error());
  return kept_identity{*std::move(made), true};
}

} // namespace

result<server_identity> make_identity(const std::vector<std::string>& names) {
  const key_handle key(EVP_EC_gen("P-256"));
  return key ? sign_anew(key.get(), names) : result<server_identity>(no_openssl());
}

result<server_identity> load_identity(const std::string& certificate_file, const std::string& key_file) {
  std::ifstream opened(certificate_file, std::ios::binary);
  std::string certificate(max_certificate_bytes, '\0');
  if (!opened || opened.read(certificate.data(), max_certificate_bytes).bad())
    return failure(errc::invalid_settings, "it can not be read", certificate_file);
  certificate.resize(static_cast<std::size_t>(opened.gcount()));
  auto key = load_secret_file(key_file, max_key_bytes, errc::invalid_settings);
  if (!key)
    return tl::make_unexpected(key.error());
  return server_identity{std::move(certificate), *std::move(key)};
}

result<kept_identity> keep_identity(const std::string& file, const std::vector<std::string>& names,
                                    const std::vector<std::string>& more_names) {
  auto all = names;
  all.insert(all.end(), more_names.begin(), more_names.end());
  if (!is_there(file))
    return store(file, make_identity(all));
  const auto both = load_secret_file(file, max_key_bytes, errc::invalid_settings);
  if (!both)
    return tl::make_unexpected(both.error());
  const auto certificate = read_certificate(both->revealed());
  const auto key = read_key(both->revealed());
  if (!certificate || !key || ::X509_check_private_key(certificate.get(), key.get()) != 1)
    return failure(errc::invalid_settings,
                   "it holds no key with its certificate: move it away, and a new one is made at the next start", file);
  if (!std::ranges::all_of(names, [&](const auto& each) { return has_name(certificate.get(), each); }))
    return store(file, sign_anew(key.get(), all));
  const auto text = both->revealed();
  const auto begin = text.find("-----BEGIN CERTIFICATE-----");
  return kept_identity{{std::string(text.substr(begin)), secret_of(text.substr(0, begin))}, false};
}

std::string fingerprint_of(std::string_view pem) {
  const auto certificate = read_certificate(pem);
  std::array<unsigned char, 32> digest{};
  unsigned size = 0;
  if (!certificate || ::X509_digest(certificate.get(), ::EVP_sha256(), digest.data(), &size) != 1)
    return {};
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string result;
  for (const auto each : digest) {
    result += result.empty() ? "" : ":";
    result += digits[each >> 4U];
    result += digits[each & 15U];
  }
  return result;
}

} // namespace godwit::io::http
