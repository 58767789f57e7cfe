// A WebSocket against a client of another hand, and against bytes that are none.
#include "io/http/server/websocket.hpp"

#include <atomic>
#include <future>

#include <gtest/gtest.h>

#include "tests/io/http/server/server_fixture.hpp"
#include "tests/io/http/server/websocket_client.hpp"

namespace websocket_test {

using namespace godwit::io::http;
using namespace godwit::io::http::test;
using namespace std::chrono_literals;

// Takes WebSockets and answers each text with itself; "more" with a text that comes in pieces.
class echo : public testing::Test {
protected:
  struct held {
    std::shared_ptr<websocket> line;
    std::promise<std::string> ended;
  };

  void take(const server_request& asked, responder answer) {
    if (!is_websocket_request(asked))
      return answer.send({.status = 426});
    const auto who = std::make_shared<held>();
    websocket_hooks hooks;
    hooks.on_open = [this] { ++opened; };
    if (listens)
      hooks.on_text = [who](std::string_view text) {
        if (text == "close")
          return who->line->close(close_code::going_away, "as you say");
        who->line->write(
            std::make_shared<const std::string>(text == "more" ? std::string(100'000, 'x') : std::string(text)), [] {});
      };
    hooks.on_end = [this, who](const std::string& why) {
      last_end = why;
      ++ended;
      who->line.reset();
    };
    who->line = std::make_shared<websocket>(server.context(), set, hooks);
    answer.upgrade([&](std::unique_ptr<connection> taken, const std::string& early) {
      who->line->accept(asked, std::move(taken), early);
    });
  }
  bool reaches(const std::atomic<int>& what, int value) {
    for (int i = 0; i < 2000 && what < value; ++i)
      std::this_thread::sleep_for(5ms);
    return what >= value;
  }

  struct served {
    explicit served(handler handle) { http = std::make_unique<server_in_thread>(std::move(handle)); }
    struct server_in_thread {
      explicit server_in_thread(handler handle)
          : made(thread.context(), {}, {.handle = [handle = std::move(handle)](server_request asked, responder answer) {
                   handle(std::move(asked), std::move(answer));
                 }}) {
        EXPECT_TRUE(made.listen());
        thread.start();
      }
      ~server_in_thread() {
        thread.run_inside([&] { made.end_connections(); });
        thread.stop();
      }
      godwit::io::link::io_thread thread;
      server made;
    };
    [[nodiscard]] boost::asio::io_context& context() { return http->thread.context(); }
    [[nodiscard]] std::uint16_t port() const { return http->made.port(); }
    std::unique_ptr<server_in_thread> http;
  };

  std::atomic<int> opened = 0;
  std::atomic<int> ended = 0;
  std::string last_end; // read after `ended`
  bool listens = true;
  websocket_settings set;
  served server{[this](server_request asked, responder answer) { take(asked, std::move(answer)); }};
};

TEST_F(echo, texts_go_both_ways_long_ones_too) {
  websocket_client client(server.port(), "/");
  ASSERT_EQ(client.status(), 101U);
  client.write("hello");
  EXPECT_EQ(client.read(), "hello");
  client.write("more");
  EXPECT_EQ(client.read(), std::string(100'000, 'x'));
}

TEST_F(echo, a_close_has_a_code_and_a_reason_and_ends_it_once) {
  websocket_client client(server.port(), "/");
  client.write("close");
  EXPECT_EQ(client.read(), "");
  EXPECT_EQ(client.close_code(), 1001U);
  EXPECT_EQ(client.close_reason(), "as you say");
  EXPECT_TRUE(reaches(ended, 1));
}

TEST_F(echo, a_client_that_goes_ends_it) {
  {
    websocket_client client(server.port(), "/");
    client.write("hello");
    EXPECT_EQ(client.read(), "hello");
  }
  EXPECT_TRUE(reaches(ended, 1));
}

TEST_F(echo, what_is_no_request_for_one_is_not_taken_for_one) {
  raw_client client(server.port());
  client.write(get("/"));
  EXPECT_EQ(client.read().result_int(), 426U);
  raw_client other(server.port());
  other.write("GET / HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: h2c\r\n\r\n");
  EXPECT_EQ(other.read().result_int(), 426U);
}

TEST_F(echo, a_handshake_of_another_version_is_refused) {
  raw_client client(server.port());
  client.write("GET / HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 8\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  EXPECT_GE(client.read().result_int(), 400U);
}

TEST_F(echo, a_message_above_the_bound_ends_it) {
  websocket_client client(server.port(), "/");
  client.write(std::string(set.max_message_bytes + 1, 'x'));
  EXPECT_EQ(client.read(), "");
  EXPECT_EQ(client.close_code(), 1009U);
  EXPECT_TRUE(reaches(ended, 1));
}

TEST_F(echo, bytes_that_are_no_frame_of_a_client_end_it) {
  for (const std::string& bytes : {std::string("\x81\x05hello", 7), std::string(64, '\xff'), std::string(64, '\0'),
                                   std::string("\x83\x80\0\0\0\0", 6)}) {
    websocket_client client(server.port(), "/");
    client.write_raw(bytes);
    EXPECT_EQ(client.read(), "") << static_cast<int>(bytes[0]);
  }
  EXPECT_TRUE(reaches(ended, 4));
}

class deaf : public echo {
protected:
  deaf() { listens = false; }
};

TEST_F(deaf, who_speaks_where_nothing_is_to_be_said_is_closed) {
  websocket_client client(server.port(), "/");
  client.write("hello");
  EXPECT_EQ(client.read(), "");
  EXPECT_EQ(client.close_code(), 1008U);
}

TEST_F(deaf, who_speaks_before_it_was_answered_is_reset) {
  raw_client client(server.port());
  client.write("GET / HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n\x81\x85more");
  EXPECT_EQ(client.read_to_end(), "");
  EXPECT_TRUE(reaches(ended, 1));
}

class impatient : public echo {
protected:
  impatient() { set.idle_timeout = 1s; }
};

TEST_F(impatient, who_answers_no_ping_is_ended) {
  raw_client client(server.port());
  client.write("GET / HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  EXPECT_TRUE(reaches(opened, 1));
  EXPECT_TRUE(reaches(ended, 1));
}

TEST_F(impatient, who_answers_pings_stays_without_a_word) {
  websocket_client client(server.port(), "/");
  auto read = std::async(std::launch::async, [&] { return client.read(); }); // answers pings
  EXPECT_EQ(read.wait_for(3s), std::future_status::timeout);
  EXPECT_EQ(ended, 0);
  client.write("hello");
  EXPECT_EQ(read.get(), "hello");
}

} // namespace websocket_test
