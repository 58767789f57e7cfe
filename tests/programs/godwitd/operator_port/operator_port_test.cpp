// The port as its clients see it: what it shows, and what it bears.
#include "programs/godwitd/operator_port/operator_port.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <fstream>
#include <future>
#include <mutex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/http/client.hpp"
#include "io/http/secret_file.hpp"
#include "io/http/server/identity.hpp"
#include "programs/godwitd/operator_port/view_api.hpp"
#include "tests/io/http/server/server_fixture.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace operator_port_test {

using namespace godwit;
using namespace godwit::operator_port;
using namespace std::chrono_literals;
using io::http::test::raw_client;

// The port, and in the place of the health actor whoever the test wants.
class open_port : public testing::Test {
protected:
  open_port() {
    view = std::make_shared<view_api>(
        port.context(), view_parts{reports,
                                   [this] {
                                     health::report made;
                                     made.at_ms = ++asked;
                                     if (answers)
                                       reports->publish(made);
                                   },
                                   [this](io::prometheus::text_writer& out) { port.append_metrics(out); }, &time});
    view->open();
    const auto opened = port.open({.host = "127.0.0.1", .port = 0, .hosts = {}}, view->routes());
    EXPECT_TRUE(opened) << opened.error();
    const auto place = port.place();
    number = static_cast<std::uint16_t>(std::stoi(place.substr(place.find(':') + 1)));
  }
  ~open_port() override {
    port.close([this] { view->close(); });
  }

  raw_client::answer get(const std::string& target) {
    raw_client client(number);
    client.write("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return client.read();
  }
  // A client that was let in is answered; one that was turned away reads the end.
  static bool is_let_in(raw_client& client) {
    client.write("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return client.read().result_int() != 0;
  }

  std::atomic<int> asked = 0;
  std::atomic<bool> answers = true;
  runtime::system_time time;
  std::shared_ptr<health::report_port> reports = std::make_shared<health::report_port>();
  class port port;
  std::shared_ptr<view_api> view;
  std::uint16_t number = 0;
};

TEST_F(open_port, health_is_200_while_it_is_not_red_and_503_when_it_is_or_nobody_looks) {
  EXPECT_EQ(get("/healthz").result_int(), 503U) << "nobody has looked yet";
  for (const auto& [how, status] :
       {std::pair{health::colour::green, 200U}, {health::colour::yellow, 200U}, {health::colour::red, 503U}}) {
    reports->show({how, 1, {}}, time.monotonic_ns());
    const auto answer = get("/healthz");
    EXPECT_EQ(answer.result_int(), status);
    EXPECT_EQ(nlohmann::json::parse(answer.body()).at("worst"), io::name_of(how));
  }
  reports->show({health::colour::green, 1, {}}, time.monotonic_ns() - std::chrono::nanoseconds(6s).count());
  EXPECT_EQ(get("/healthz").result_int(), 503U) << "it is old";
}

TEST_F(open_port, a_status_is_a_report_that_was_asked_for) {
  const auto answer = get("/status");
  EXPECT_EQ(answer.result_int(), 200U);
  EXPECT_EQ(answer["Content-Type"], "application/json");
  EXPECT_EQ(nlohmann::json::parse(answer.body()).at("at_ms"), 1);
}

TEST_F(open_port, reports_that_are_wanted_at_once_are_one) {
  raw_client client(number);
  std::string many;
  for (int i = 0; i < 50; ++i)
    many += "GET /status HTTP/1.1\r\nHost: localhost\r\n\r\n";
  client.write(many);
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(client.read().result_int(), 200U);
  EXPECT_LT(asked, 10);
}

TEST_F(open_port, figures_are_what_prometheus_reads) {
  const auto answer = get("/metrics");
  EXPECT_EQ(answer["Content-Type"], "text/plain; version=0.0.4; charset=utf-8");
  EXPECT_NE(answer.body().find("# TYPE godwit_operator_port_requests_total counter\n"), std::string::npos);
  EXPECT_TRUE(answer.body().ends_with("\n"));
}

TEST_F(open_port, who_waits_for_a_report_that_does_not_come_is_told_so) {
  answers = false;
  const auto answer = get("/status");
  EXPECT_EQ(answer.result_int(), 503U);
  EXPECT_EQ(answer["Content-Type"], "application/problem+json");
}

TEST_F(open_port, each_answer_has_the_security_headers_also_a_refusal_of_the_server_itself) {
  raw_client client(number);
  client.write("nonsense\r\n\r\n");
  for (const auto& answer : {get("/healthz"), get("/nowhere"), client.read()}) {
    EXPECT_TRUE(std::string(answer["Content-Security-Policy"]).starts_with("default-src 'none'"));
    EXPECT_EQ(answer["X-Content-Type-Options"], "nosniff");
    EXPECT_EQ(answer["Cache-Control"], "no-store");
    EXPECT_EQ(answer.count("Server"), 0U);
  }
}

TEST_F(open_port, an_address_has_so_many_clients_and_a_place_is_free_when_one_has_gone) {
  std::vector<std::unique_ptr<raw_client>> all;
  for (std::size_t i = 0; i < settings().max_clients_an_address; ++i) {
    all.push_back(std::make_unique<raw_client>(number));
    EXPECT_TRUE(is_let_in(*all.back())) << i;
  }
  raw_client too_many(number);
  EXPECT_EQ(too_many.read_to_end(), "");
  all.pop_back();
  for (int tries = 0; tries < 200; ++tries) {
    raw_client next(number);
    if (!next.hears_within(5ms) && is_let_in(next))
      return;
  }
  FAIL() << "the place was never free";
}

// With TLS and a certificate of its own, and a client that knows it.
struct secure_port {
  explicit secure_port(const settings& wanted)
      : opened(
            port.open(wanted, {{"GET", "/", 0, say_it}}, {.on_certificate = [this](const auto& now) { hear(now); }})) {
    const auto place = port.place();
    if (opened)
      url = "https://localhost" + place.substr(place.find(':'));
  }
  ~secure_port() { port.close(); }
  static void say_it(const server_request& asked, responder answer) { answer.send({.body = asked.from}); }
  static settings wanted(const std::string& identity_file) {
    settings result{.host = "127.0.0.1", .port = 0, .hosts = {"drone.local"}};
    result.uses_tls = true;
    result.identity_file = identity_file;
    return result;
  }
  void hear(const tl::expected<std::string, std::string>& now) {
    const std::scoped_lock lock(reports_mutex);
    reports.push_back(now);
    reported.notify_one();
  }
  // What is reported of the certificate next; an error after 20 s without a report.
  tl::expected<std::string, std::string> next_report() {
    std::unique_lock lock(reports_mutex);
    if (!reported.wait_for(lock, 20s, [this] { return !reports.empty(); }))
      return tl::make_unexpected(std::string("nothing was reported"));
    auto result = std::move(reports.front());
    reports.pop_front();
    return result;
  }
  // The next report of a certificate; those of files that do not belong together yet come before it.
  tl::expected<std::string, std::string> next_certificate() {
    auto result = next_report();
    while (!result && result.error().find("stays as it was") != std::string::npos)
      result = next_report();
    return result;
  }
  std::mutex reports_mutex;
  std::condition_variable reported;
  std::deque<tl::expected<std::string, std::string>> reports;
  class port port;
  tl::expected<void, std::string> opened;
  std::string url;
};

TEST(operator_port_tls, makes_its_certificate_once_and_says_its_fingerprint) {
  const test::scratch folder;
  const auto wanted = secure_port::wanted(folder.file("godwit.tls"));
  std::string fingerprint;
  {
    secure_port first(wanted);
    ASSERT_TRUE(first.opened) << first.opened.error();
    EXPECT_TRUE(first.port.is_certificate_new());
    EXPECT_TRUE(first.port.url().starts_with("https://127.0.0.1:"));
    fingerprint = first.port.fingerprint();
    io::http::settings as_client;
    as_client.base_url = first.url;
    as_client.ca_file = folder.file("godwit.tls"); // what it has of keys is passed over
    std::promise<std::string> heard;
    auto client = io::http::client::open(as_client).value();
    (void)client->send({}, [&](const io::http::result<io::http::response>& end) {
      heard.set_value(end ? end->body : end.error().message());
    });
    EXPECT_EQ(heard.get_future().get(), "127.0.0.1");
  }
  secure_port second(wanted);
  EXPECT_FALSE(second.port.is_certificate_new());
  EXPECT_EQ(second.port.fingerprint(), fingerprint);
}

TEST(operator_port_tls, a_certificate_or_key_that_can_not_be_used_is_named_and_the_port_stays_closed) {
  const test::scratch folder;
  auto wanted = secure_port::wanted({});
  wanted.certificate_file = folder.file("none.pem");
  wanted.key_file = folder.file("none.key");
  const secure_port unreadable(wanted);
  ASSERT_FALSE(unreadable.opened);
  EXPECT_NE(unreadable.opened.error().find("none.pem"), std::string::npos);
  const auto one = io::http::make_identity({"localhost"}).value();
  const auto other = io::http::make_identity({"localhost"}).value();
  std::ofstream(wanted.certificate_file) << one.certificate;
  ASSERT_TRUE(io::http::store_secret_file(wanted.key_file, other.key.revealed(), io::http::errc::invalid_settings));
  const secure_port not_matching(wanted);
  ASSERT_FALSE(not_matching.opened);
  EXPECT_NE(not_matching.opened.error().find("none.key"), std::string::npos) << not_matching.opened.error();
}

void replace_file(const std::string& file, std::string_view content) {
  const auto next = file + ".next";
  std::ofstream(next) << content;
  std::filesystem::permissions(next, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::filesystem::rename(next, file);
}

// Whether a client that believes CERTIFICATE alone is answered at URL.
bool is_answered(const std::string& url, const std::string& certificate) {
  const test::scratch folder;
  replace_file(folder.file("ca.pem"), certificate);
  io::http::settings as_client;
  as_client.base_url = url;
  as_client.ca_file = folder.file("ca.pem");
  std::promise<bool> heard;
  auto client = io::http::client::open(as_client).value();
  (void)client->send({}, [&](const io::http::result<io::http::response>& end) { heard.set_value(end.has_value()); });
  return heard.get_future().get();
}

TEST(operator_port_tls, reads_a_certificate_anew_when_its_files_change_or_on_request_and_keeps_it_when_it_can_not) {
  const test::scratch folder;
  auto wanted = secure_port::wanted({});
  wanted.certificate_file = folder.file("port.pem");
  wanted.key_file = folder.file("port.key");
  const auto put = [&](const io::http::server_identity& who) {
    replace_file(wanted.key_file, who.key.revealed());
    replace_file(wanted.certificate_file, who.certificate);
  };
  const auto first = io::http::make_identity({"localhost"}).value();
  const auto second = io::http::make_identity({"localhost"}).value();
  put(first);
  secure_port served(wanted);
  ASSERT_TRUE(served.opened) << served.opened.error();
  EXPECT_TRUE(is_answered(served.url, first.certificate));
  put(second);
  EXPECT_EQ(served.next_certificate(), io::http::fingerprint_of(second.certificate));
  EXPECT_TRUE(is_answered(served.url, second.certificate));
  EXPECT_FALSE(is_answered(served.url, first.certificate));
  replace_file(wanted.certificate_file, "no PEM");
  const auto broken = served.next_report();
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().find("stays as it was"), std::string::npos) << broken.error();
  EXPECT_TRUE(is_answered(served.url, second.certificate));
  put(first);
  EXPECT_EQ(served.next_certificate(), io::http::fingerprint_of(first.certificate));
  served.port.read_certificate_anew();
  EXPECT_EQ(served.next_certificate(), io::http::fingerprint_of(first.certificate)) << "a request is always answered";
}

TEST_F(open_port, a_port_that_is_taken_is_named_with_the_remedy) {
  class port second;
  const auto opened = second.open({.host = "127.0.0.1", .port = number, .hosts = {}}, {});
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().find(std::to_string(number)), std::string::npos) << opened.error();
  EXPECT_NE(opened.error().find("another program listens there"), std::string::npos) << opened.error();
}

} // namespace operator_port_test
