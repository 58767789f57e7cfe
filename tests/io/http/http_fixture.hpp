// What tests of the client share: a folder for its files, certificates, and waiting for an answer.
#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "io/http/client.hpp"
#include "tests/support/http_server.hpp"

namespace godwit::io::http::test {

using godwit::test::http_answer;
using godwit::test::http_peer;
using godwit::test::http_request;
using godwit::test::http_server;

// Far longer than any of it takes: a test that waits so long has failed.
inline constexpr std::chrono::seconds patience{60};

// What a service was told, in a form in which the client does not find its token again: that it takes out of answers.
inline std::string backwards(std::string_view text) { return {text.rbegin(), text.rend()}; }

class http_fixture : public testing::Test {
protected:
  http_fixture();
  ~http_fixture() override;

  // The name of the file.
  std::string store(const std::string& name, std::string_view content, mode_t mode = 0600) const;
  // For URL, with the certificate of the test's issuer, and time-outs that do not end a test early.
  [[nodiscard]] settings settings_for(const std::string& url) const;
  [[nodiscard]] static std::unique_ptr<client> open(const settings& wanted);
  // Sends and waits.
  [[nodiscard]] static result<response> ask(client& service, request asked);
  [[nodiscard]] result<response> ask(const std::string& url, request asked = {}) const;
  [[nodiscard]] static errc code_of(const result<response>& end);
  [[nodiscard]] static std::string body_of(const result<response>& end); // or the sentence of the error
  [[nodiscard]] static unsigned status_of(const result<response>& end);  // or 0

  // Made once for all tests of the program: an issuer, and what it has signed.
  [[nodiscard]] static const godwit::test::tls_identity& issuer();
  [[nodiscard]] static const godwit::test::tls_identity& loopback_identity(); // for localhost and 127.0.0.1
  [[nodiscard]] static godwit::test::http_server_options with_tls();

private:
  std::filesystem::path folder_;
};

} // namespace godwit::io::http::test
