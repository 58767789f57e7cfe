// The certificate that a server makes for itself, and what it keeps of it.
#include "io/http/server/identity.hpp"

#include <fstream>
#include <iterator>

#include <sys/stat.h>

#include "io/http/tls.hpp"
#include "tests/io/http/http_fixture.hpp"
#include "tests/io/http/server/server_fixture.hpp"

namespace godwit::io::http::test {
namespace identity_test {

using http_server_identity = http_fixture;
using names = std::vector<std::string>;

TEST_F(http_server_identity, is_one_whose_names_a_client_that_knows_it_accepts_and_no_others) {
  const auto who = make_identity({"localhost", "127.0.0.1"}).value();
  const std::shared_ptr tls = make_server_tls_context(who.certificate, who.key.revealed()).value();
  running_server server(say_target, {}, {.tls = [&] { return tls; }});
  const auto known = store("own.pem", who.certificate);
  for (const std::string host : {"localhost", "127.0.0.1"}) {
    auto wanted = settings_for("https://" + host + ":" + std::to_string(server.port()));
    wanted.ca_file = known;
    EXPECT_EQ(body_of(ask(*open(wanted), {})), "/") << host;
  }
  EXPECT_EQ(server.counters().handshakes, 2U);
  const auto other = make_identity({"drone.local", "::1"}).value();
  const std::shared_ptr other_tls = make_server_tls_context(other.certificate, other.key.revealed()).value();
  running_server elsewhere(say_target, {}, {.tls = [&] { return other_tls; }});
  auto wanted = settings_for("https://127.0.0.1:" + std::to_string(elsewhere.port()));
  wanted.ca_file = store("other.pem", other.certificate);
  EXPECT_EQ(code_of(ask(*open(wanted), {})), errc::wrong_host);
}

TEST_F(http_server_identity, is_made_once_with_mode_0600_and_kept) {
  const auto file = store("there", "") + ".tls";
  const auto made = keep_identity(file, {"localhost"}, {"192.168.7.7"}).value();
  EXPECT_TRUE(made.is_new);
  struct stat found {};
  ASSERT_EQ(::stat(file.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 07777, 0600U);
  const auto print = fingerprint_of(made.identity.certificate);
  EXPECT_EQ(print.size(), 32U * 3 - 1);
  const auto kept = keep_identity(file, {"localhost"}, {"192.168.7.8"}).value(); // its address has changed meanwhile
  EXPECT_FALSE(kept.is_new);
  EXPECT_EQ(fingerprint_of(kept.identity.certificate), print);
  EXPECT_EQ(kept.identity.key.revealed(), made.identity.key.revealed());
  EXPECT_TRUE(make_server_tls_context(kept.identity.certificate, kept.identity.key.revealed()));
}

TEST_F(http_server_identity, is_signed_anew_with_the_same_key_for_a_name_that_it_lacks) {
  const auto file = store("there", "") + ".tls";
  const auto before = keep_identity(file, {"localhost"}, {}).value();
  const auto after = keep_identity(file, {"localhost", "drone.local"}, {}).value();
  EXPECT_TRUE(after.is_new);
  EXPECT_EQ(after.identity.key.revealed(), before.identity.key.revealed());
  EXPECT_NE(fingerprint_of(after.identity.certificate), fingerprint_of(before.identity.certificate));
  EXPECT_FALSE(keep_identity(file, {"drone.local"}, {}).value().is_new);
}

TEST_F(http_server_identity, of_a_file_that_is_damaged_or_open_to_others_is_named_and_nothing_is_overwritten) {
  const auto damaged = store("damaged.tls", "-----BEGIN PRIVATE KEY-----\nnonsense\n");
  const auto wrong = keep_identity(damaged, {"localhost"}, {});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().where, damaged);
  EXPECT_NE(wrong.error().what.find("move it away"), std::string::npos);
  const auto open_to_all = store("open.tls", "x", 0644);
  EXPECT_NE(keep_identity(open_to_all, {}, {}).error().what.find("chmod 600"), std::string::npos);
  std::ifstream still(damaged);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(still), {}).size(), 37U);
  EXPECT_FALSE(keep_identity("/nowhere/at/all.tls", {"localhost"}, {}));
}

TEST_F(http_server_identity, of_files_is_what_they_hold_and_a_file_that_can_not_be_read_is_named) {
  const auto& who = loopback_identity();
  const auto certificate = store("c.pem", who.certificate, 0644);
  const auto key = store("k.pem", who.key);
  EXPECT_EQ(load_identity(certificate, key)->certificate, who.certificate);
  EXPECT_EQ(load_identity(certificate + ".none", key).error().where, certificate + ".none");
  EXPECT_EQ(load_identity(certificate, certificate).error().where, certificate) << "its mode is not 0600";
  EXPECT_EQ(fingerprint_of("no PEM"), "");
}

TEST_F(http_server_identity, has_names_and_addresses_and_nothing_that_is_neither) {
  EXPECT_TRUE(make_identity({"drone.local", "10.0.0.7", "fd00::7"}));
  EXPECT_TRUE(make_identity(names{"a,DNS:b"})) << "one odd name, and not two";
}

} // namespace identity_test
} // namespace godwit::io::http::test
