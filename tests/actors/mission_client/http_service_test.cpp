// The way to a real service: what io/http says in the words of mission_client, and that the actor is woken.
#include "actors/mission_client/http_service.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>

#include "actors/mission_client/judgement.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/system.hpp"
#include "tests/support/http_server.hpp"

namespace http_service_test {

using namespace godwit;
using namespace godwit::mission_client;
using namespace std::chrono_literals;

// Counts how often somebody was woken.
struct alarm {
  void ring() {
    const std::lock_guard guard(mutex);
    ++rings;
    changed.notify_all();
  }
  [[nodiscard]] bool wait() {
    std::unique_lock guard(mutex);
    const bool rang = changed.wait_for(guard, 30s, [this] { return rings > 0; });
    rings = 0;
    return rang;
  }
  std::mutex mutex;
  std::condition_variable changed;
  int rings = 0;
};

class sleeper final : public runtime::actor_base<wake_handle> {
public:
  sleeper(runtime::spawn_context context, alarm* bell) : actor_base(std::move(context)), bell_(bell) {}

protected:
  behavior_type handlers() override {
    return {on<wake>([this](const wake&) { bell_->ring(); })};
  }

private:
  alarm* bell_;
};

class http_service_test : public testing::Test {
protected:
  http_service_test() {
    outside_.time = &time_;
    outside_.names = &names_;
    outside_.health = &health_;
    actors_ = std::make_unique<runtime::system>(outside_, runtime::system_options{});
    actor_ = actors_->add<sleeper>({.name = "sleeper"}, {}, &bell_);
    actors_->start();
  }
  ~http_service_test() override {
    if (service_)
      service_->close();
    EXPECT_TRUE(actors_->stop());
  }

  void open(test::http_server::handler answer, const std::filesystem::path& pictures = {}) {
    server_ = std::make_unique<test::http_server>(std::move(answer));
    open_at(server_->url(), {}, pictures);
  }
  void open_at(const std::string& url, const std::string& issuer_file = {},
               const std::filesystem::path& pictures = {}) {
    io::http::settings where;
    where.base_url = url;
    where.ca_file = issuer_file;
    auto opened = http_service::open(where, pictures);
    ASSERT_TRUE(opened) << opened.error();
    service_ = *opened;
    service_->attach(actors_->make_gateway("service"), *actor_);
  }
  static service_call get(const std::string& target = "/missions/1") {
    return {.target = target, .max_answer_bytes = 1'000, .read_timeout = 30s, .total_timeout = 30s};
  }
  // The answer to this call.
  service_answer answer_to(service_call call) {
    const auto number = service_->send(std::move(call));
    while (true) {
      if (auto answer = service_->answers().take()) {
        EXPECT_EQ(answer->number, number);
        return *answer;
      }
      if (!bell_.wait()) {
        ADD_FAILURE() << "no answer came";
        return {};
      }
    }
  }

  alarm bell_;
  std::unique_ptr<test::http_server> server_;
  std::shared_ptr<http_service> service_;

private:
  runtime::system_time time_;
  runtime::directory names_;
  runtime::health_board health_;
  runtime::services outside_;
  std::unique_ptr<runtime::system> actors_;
  std::optional<wake_handle> actor_;
};

TEST_F(http_service_test, a_get_brings_status_and_body_and_wakes_the_actor) {
  open([](test::http_peer& peer, const test::http_request& asked) {
    EXPECT_EQ(asked.target(), "/missions/1?next=a%2Bb");
    peer.write(test::http_answer("200 OK", "{}", "Content-Type: application/json\r\n"));
  });
  const auto got = answer_to(get("/missions/1?next=a%2Bb"));
  EXPECT_EQ(got.how, ending::answered);
  EXPECT_EQ(got.status, 200U);
  EXPECT_EQ(got.body, "{}");
}

TEST_F(http_service_test, a_picture_becomes_the_end_of_its_body_and_one_that_is_gone_is_told) {
  const std::filesystem::path folder = testing::TempDir();
  std::ofstream(folder / "p.jpg", std::ios::binary) << "\xFF\xD8\xFF\xD9";
  open(
      [](test::http_peer& peer, const test::http_request& asked) {
        EXPECT_EQ(asked.body(), R"({"jpeg":"/9j/2Q=="})");
        peer.write(test::http_answer("200 OK", "{}", "Content-Type: application/json\r\n"));
      },
      folder);
  service_call call{.is_post = true, .target = "/x", .body = R"({"jpeg":""})", .key = "k", .picture = "p.jpg"};
  call.max_answer_bytes = 1'000;
  call.read_timeout = call.total_timeout = 30s;
  EXPECT_EQ(answer_to(call).status, 200U);
  call.picture = "gone.jpg";
  const auto got = answer_to(call);
  EXPECT_EQ(judge(got), judgement::wrong);
  EXPECT_EQ(sentence_of(got), "the picture gone.jpg is not on the disk any more");
}

TEST_F(http_service_test,
       the_head_of_a_page_names_the_next_one_before_its_body_comes_and_that_of_other_answers_does_not) {
  open([](test::http_peer& peer, const test::http_request& asked) {
    EXPECT_EQ(asked["Accept-Encoding"], asked.target() == "/page" ? "zstd, gzip" : "identity");
    peer.write(test::http_answer("200 OK", "{}", "Content-Type: application/json\r\nNext-Page: b-1\r\n"));
  });
  auto page = get("/page");
  page.is_page = true;
  const auto begun = answer_to(page);
  EXPECT_EQ(begun.how, ending::page_begun);
  EXPECT_EQ(begun.body, "b-1");
  std::optional<service_answer> end;
  while (!(end = service_->answers().take()))
    ASSERT_TRUE(bell_.wait());
  EXPECT_EQ(end->number, begun.number);
  EXPECT_EQ(end->how, ending::answered);
  EXPECT_EQ(end->body, "{}");
  EXPECT_EQ(answer_to(get("/other")).how, ending::answered);
}

TEST_F(http_service_test, a_post_carries_its_body_and_its_key) {
  open([](test::http_peer& peer, const test::http_request& asked) {
    EXPECT_EQ(asked.method_string(), "POST");
    EXPECT_EQ(asked.body(), R"({"idempotency_key":"k"})");
    EXPECT_EQ(asked["Idempotency-Key"], "k");
    EXPECT_EQ(asked["Content-Type"], "application/json");
    peer.write(test::http_answer("200 OK", "{}", "Content-Type: application/json\r\n"));
  });
  auto call = get();
  call.is_post = true;
  call.key = "k";
  call.body = R"({"idempotency_key":"k"})";
  EXPECT_EQ(answer_to(call).status, 200U);
}

TEST_F(http_service_test, what_the_service_asks_to_wait_is_handed_on) {
  open([](test::http_peer& peer, const test::http_request&) {
    peer.write(test::http_answer("503 Service Unavailable", "", "Retry-After: 7\r\n"));
  });
  const auto got = answer_to(get());
  EXPECT_EQ(got.status, 503U);
  EXPECT_EQ(got.retry_after_ns, 7'000'000'000);
}

TEST_F(http_service_test, another_type_and_a_body_that_is_too_long_are_bad_answers) {
  open([](test::http_peer& peer, const test::http_request& asked) {
    if (asked.target() == "/type")
      peer.write(test::http_answer("200 OK", "<html>", "Content-Type: text/html\r\n"));
    else
      peer.write(test::http_answer("200 OK", std::string(5'000, ' '), "Content-Type: application/json\r\n"));
  });
  EXPECT_EQ(answer_to(get("/type")).how, ending::bad_answer);
  EXPECT_EQ(answer_to(get("/long")).how, ending::bad_answer);
}

TEST_F(http_service_test, a_redirect_is_for_a_person_and_a_cut_connection_for_later) {
  open([](test::http_peer& peer, const test::http_request& asked) {
    if (asked.target() == "/away")
      peer.write(test::http_answer("302 Found", "", "Location: https://elsewhere.example/\r\n"));
    else
      peer.close();
  });
  EXPECT_EQ(judge(answer_to(get("/away"))), judgement::misconfigured);
  EXPECT_EQ(answer_to(get("/cut")).how, ending::not_reached);
}

TEST_F(http_service_test, nobody_there_is_not_reached_and_says_so) {
  open([](test::http_peer& peer, const test::http_request&) { peer.close(); });
  const auto url = server_->url();
  service_->close();
  server_.reset();
  open_at(url);
  const auto got = answer_to(get());
  EXPECT_EQ(got.how, ending::not_reached);
  EXPECT_NE(got.error, "");
}

TEST_F(http_service_test, a_certificate_that_is_not_valid_yet_is_for_later_and_the_clock_is_named) {
  const auto issuer = test::make_tls_identity({.common_name = "issuer", .is_issuer = true});
  const auto issuer_file = testing::TempDir() + "http_service_test_issuer.pem";
  std::ofstream(issuer_file) << issuer.certificate;
  const test::certificate_request wish{.common_name = "a", .hosts = {"IP:127.0.0.1"}, .begins_s = 3600, .ends_s = 7200};
  server_ = std::make_unique<test::http_server>([](test::http_peer& peer, const test::http_request&) { peer.close(); },
                                                test::http_server_options{test::make_tls_identity(wish, &issuer), {}});
  open_at(server_->url(), issuer_file);
  const auto got = answer_to(get());
  EXPECT_EQ(judge(got), judgement::transient);
  EXPECT_NE(got.error.find("is the clock of this computer right?"), std::string::npos) << got.error;
}

TEST_F(http_service_test, our_own_end_is_no_answer_and_so_no_failed_try) {
  open([](test::http_peer& peer, const test::http_request&) { peer.wait_until_gone(); });
  (void)service_->send(get());
  service_->close();
  (void)service_->send(get());
  EXPECT_FALSE(service_->answers().take());
}

TEST_F(http_service_test, a_cancelled_call_ends_at_once) {
  open([](test::http_peer& peer, const test::http_request&) { peer.wait_until_gone(); });
  const auto one = service_->send(get());
  const auto other = service_->send(get());
  service_->cancel(one);
  ASSERT_TRUE(bell_.wait());
  EXPECT_EQ(service_->answers().take()->number, one);
  EXPECT_FALSE(service_->answers().take());
  service_->cancel_all();
  ASSERT_TRUE(bell_.wait());
  EXPECT_EQ(service_->answers().take()->number, other);
}

TEST_F(http_service_test, an_address_that_is_none_is_refused_with_a_sentence) {
  io::http::settings where;
  where.base_url = "ftp://missions.example";
  const auto opened = http_service::open(where);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error(), "");
}

} // namespace http_service_test
