#include "tests/io/http/http_fixture.hpp"

#include <cstdlib>
#include <fstream>

namespace godwit::io::http::test {

namespace fs = std::filesystem;
using godwit::test::make_tls_identity;
using godwit::test::tls_identity;

http_fixture::http_fixture() {
  std::string pattern = (fs::temp_directory_path() / "godwit-http-XXXXXX").string();
  folder_ = ::mkdtemp(pattern.data());
}
http_fixture::~http_fixture() { fs::remove_all(folder_); }

std::string http_fixture::store(const std::string& name, std::string_view content, mode_t mode) const {
  auto file = (folder_ / name).string();
  std::ofstream(file, std::ios::binary) << content;
  EXPECT_EQ(::chmod(file.c_str(), mode), 0);
  return file;
}

settings http_fixture::settings_for(const std::string& url) const {
  settings made;
  made.base_url = url;
  if (url.starts_with("https"))
    made.ca_file = store("issuer.pem", issuer().certificate);
  made.connect_timeout = made.read_timeout = made.total_timeout = patience;
  return made;
}

std::unique_ptr<client> http_fixture::open(const settings& wanted) {
  auto opened = client::open(wanted);
  EXPECT_TRUE(opened) << opened.error().message();
  return opened ? std::move(*opened) : nullptr;
}

result<response> http_fixture::ask(client& service, request asked) {
  auto promise = std::make_shared<std::promise<result<response>>>();
  auto answer = promise->get_future();
  const auto sent =
      service.send(std::move(asked), [promise](result<response> end) { promise->set_value(std::move(end)); });
  if (!sent)
    return tl::make_unexpected(sent.error());
  if (answer.wait_for(2 * patience) != std::future_status::ready) {
    ADD_FAILURE() << "the callback was not called";
    return failure(errc::cancelled, "the callback was not called");
  }
  return answer.get();
}

result<response> http_fixture::ask(const std::string& url, request asked) const {
  const auto service = open(settings_for(url));
  return ask(*service, std::move(asked));
}

errc http_fixture::code_of(const result<response>& end) {
  if (!end)
    return end.error().code;
  ADD_FAILURE() << "answered with " << end->status << " instead of an error";
  return {};
}

std::string http_fixture::body_of(const result<response>& end) { return end ? end->body : end.error().message(); }
unsigned http_fixture::status_of(const result<response>& end) { return end ? end->status : 0; }

const tls_identity& http_fixture::issuer() {
  static const auto made = make_tls_identity({.common_name = "godwit test issuer", .is_issuer = true});
  return made;
}

const tls_identity& http_fixture::loopback_identity() {
  static const auto made = make_tls_identity({.hosts = {"DNS:localhost", "IP:127.0.0.1"}}, &issuer());
  return made;
}

godwit::test::http_server_options http_fixture::with_tls() { return {.tls = loopback_identity(), .client_issuer = {}}; }

} // namespace godwit::io::http::test
