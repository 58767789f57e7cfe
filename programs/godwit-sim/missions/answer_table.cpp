#include "programs/godwit-sim/missions/answer_table.hpp"

#include <array>
#include <span>

#include <openssl/evp.h>

#include "io/fields/hex_text.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim::missions {

using io::sqlite::statement;

std::string digest_of(std::string_view method, std::string_view path, std::string_view body) {
  std::string all;
  all.reserve(method.size() + path.size() + body.size() + 2);
  all.append(method).append(" ").append(path).append("\n").append(body);
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  unsigned size = 0;
  const bool is_made = ::EVP_Digest(all.data(), all.size(), hash.data(), &size, ::EVP_sha256(), nullptr) == 1;
  GODWIT_ASSERT(is_made, "OpenSSL knows SHA-256");
  return io::hex_of(std::as_bytes(std::span(hash).first(size)));
}

std::optional<kept_answer> find_answer(service_file& file, const std::string& key) {
  return file.first_row(
      "SELECT digest, status, content_type, body FROM answers WHERE idempotency_key = ?1",
      [](const statement& row) {
        return kept_answer{row.text(0), {static_cast<unsigned>(row.integer(1)), row.text(2), row.text(3), {}}};
      },
      key);
}

void count_replay(service_file& file, const std::string& key) {
  file.run("UPDATE answers SET replays = replays + 1 WHERE idempotency_key = ?1", key);
}

void keep_answer(service_file& file, const std::string& key, const kept_answer& given, std::int64_t now_s) {
  file.run("INSERT INTO answers(idempotency_key, digest, status, content_type, body, made_s) "
           "VALUES (?1, ?2, ?3, ?4, ?5, ?6)",
           key, given.digest, given.what.status, given.what.content_type, given.what.body, now_s);
}

void forget_answers(service_file& file, std::int64_t now_s) {
  file.run("DELETE FROM answers WHERE made_s < ?1", now_s - keep_answers_s);
}

std::uint64_t replays(service_file& file) {
  return static_cast<std::uint64_t>(file.number("SELECT COALESCE(SUM(replays), 0) FROM answers").value_or(0));
}

} // namespace godwit::sim::missions
