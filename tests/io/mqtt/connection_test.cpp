// The connection against brokers that do not behave, over sockets: real time, with wide margins.
#include "io/mqtt/connection.hpp"

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <random>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "io/link/io_thread.hpp"
#include "tests/support/mqtt_peer.hpp"

namespace godwit::io::mqtt {
namespace connection_test {

using namespace std::chrono_literals;
namespace peers = tests::mqtt;
using peers::connack;

message text_of(bool is_acknowledged, std::string payload = "{}") {
  return {"gw/v1/rover-7/event", std::make_shared<const std::string>(std::move(payload)), is_acknowledged, false, 0};
}

class publisher {
public:
  explicit publisher(std::uint16_t port, std::string host = "127.0.0.1", connection_settings settings = {}) {
    thread_.start();
    settings.broker = {false, std::move(host), port};
    settings.client_id = "rover-7";
    const auto with = [this](auto what) {
      const std::lock_guard guard(mutex_);
      what();
      changed_.notify_all();
    };
    listener to;
    to.opened = [this, with](std::uint32_t) { with([this] { is_open = true; }); };
    to.closed = [this, with](failure why, const std::string& said) {
      with([&] {
        EXPECT_FALSE(reason) << "once";
        reason = why;
        sentence = said;
      });
    };
    to.published = [this, with](std::uint64_t token) { with([&] { tokens.push_back(token); }); };
    ours = std::make_unique<connection>(
        thread_.context(), settings,
        message{"gw/v1/rover-7/status", std::make_shared<const std::string>("{}"), true, true, 0}, std::move(to));
  }
  ~publisher() {
    if (!ours)
      return;
    ours->end();
    EXPECT_TRUE(ours->wait_for_end(5s));
  }
  publisher(const publisher&) = delete;
  publisher& operator=(const publisher&) = delete;

  template <class Condition>
  bool wait(const Condition& holds, std::chrono::seconds patience = 60s) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, holds);
  }
  bool is_closed(std::chrono::seconds patience = 60s) {
    return wait([this] { return reason.has_value(); }, patience);
  }
  bool is_opened() {
    return wait([this] { return is_open; });
  }

  std::unique_ptr<connection> ours;
  bool is_open = false;
  std::optional<failure> reason;
  std::string sentence;
  std::vector<std::uint64_t> tokens;

private:
  link::io_thread thread_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

long resident_kB() {
  std::ifstream from("/proc/self/statm");
  long pages = 0;
  from >> pages >> pages;
  return pages * 4;
}

TEST(mqtt_connection, publishes_and_tells_the_broker_to_publish_the_will_as_it_ends) {
  std::optional<peers::raw_packet> last;
  {
    peers::peer broker([&](peers::peer_end& end, int) {
      (void)end.read();
      end.write(connack());
      const auto sent = end.read();
      end.write(peers::puback(peers::read_publish(*sent).id));
      last = end.last();
    });
    publisher with(broker.port());
    ASSERT_TRUE(with.is_opened());
    with.ours->publish(text_of(true), 7);
    EXPECT_TRUE(with.wait([&] { return with.tokens == std::vector<std::uint64_t>{7}; }));
  }
  ASSERT_TRUE(last);
  EXPECT_EQ(last->type, peers::disconnect_type);
  EXPECT_EQ(last->body, "\x04");
}

TEST(mqtt_connection, the_packet_that_ended_godwitd_ends_the_connection_with_a_reason) {
  for (const auto& answer : {std::string("\x20\x05\x00\x00\x01\x7a\x00", 7), connack(0, peers::property(0x7a, "x"))}) {
    std::optional<peers::raw_packet> last;
    {
      peers::peer broker([&](peers::peer_end& end, int) {
        (void)end.read();
        end.write(answer);
        last = end.last();
      });
      publisher with(broker.port());
      ASSERT_TRUE(with.is_closed());
      EXPECT_EQ(with.reason, failure::refused);
      EXPECT_TRUE(with.sentence.starts_with("the broker sends CONNACK with ")) << with.sentence;
    }
    ASSERT_TRUE(last);
    EXPECT_EQ(last->body, "\x81") << "the broker is told: malformed packet";
  }
}

TEST(mqtt_connection, a_packet_of_256_MB_is_refused_at_its_length_and_takes_no_memory) {
  const auto before_kB = resident_kB();
  peers::peer broker([&](peers::peer_end& end, int) {
    (void)end.read();
    end.write(connack());
    (void)end.read();
    end.write(std::string("\x40\xff\xff\xff\x7f"));
    const std::string piece(1 << 16, 'x');
    for (int n = 0; n < 4'096 && end.write(piece); ++n) {
    }
  });
  publisher with(broker.port());
  ASSERT_TRUE(with.is_opened());
  with.ours->publish(text_of(true), 1);
  ASSERT_TRUE(with.is_closed());
  EXPECT_EQ(with.sentence, "the broker sends PUBACK that is longer than 4096 bytes");
  EXPECT_LT(resident_kB() - before_kB, 20'000);
}

TEST(mqtt_connection, garbage_ends_it_whatever_it_is) {
  std::mt19937_64 random(7);
  peers::peer broker([&](peers::peer_end& end, int) {
    (void)end.read();
    std::string noise(1 + random() % 300, '\0');
    for (auto& each : noise)
      each = static_cast<char>(random());
    noise[0] = static_cast<char>(noise[0] | 0x01); // no packet begins so
    end.write(noise);
    (void)end.last();
  });
  for (int n = 0; n < 50; ++n) {
    publisher with(broker.port());
    ASSERT_TRUE(with.is_closed());
    EXPECT_EQ(with.reason, failure::refused) << with.sentence;
  }
}

TEST(mqtt_connection, half_a_packet_and_then_the_end_is_a_lost_connection) {
  peers::peer broker([&](peers::peer_end& end, int) {
    (void)end.read();
    end.write(connack());
    (void)end.read();
    end.write("\x40\x02"); // and nothing of what it announces
  });
  publisher with(broker.port());
  ASSERT_TRUE(with.is_opened());
  with.ours->publish(text_of(true), 1);
  ASSERT_TRUE(with.is_closed());
  EXPECT_EQ(with.reason, failure::lost);
  EXPECT_TRUE(with.tokens.empty()) << "what is not acknowledged does not count";
}

TEST(mqtt_connection, packets_byte_by_byte_are_packets) {
  peers::peer broker([&](peers::peer_end& end, int) {
    (void)end.read();
    for (const char each : connack(0, peers::property(0x21, peers::number(5, 2))))
      end.write(std::string(1, each));
    (void)end.last();
  });
  publisher with(broker.port());
  EXPECT_TRUE(with.is_opened());
}

TEST(mqtt_connection, who_listens_and_is_silent_is_named_after_ten_seconds) {
  peers::peer broker([&](peers::peer_end& end, int) { (void)end.last(); });
  publisher with(broker.port());
  ASSERT_TRUE(with.is_closed());
  EXPECT_EQ(with.reason, failure::unreachable);
  EXPECT_NE(with.sentence.find("is it a broker of MQTT?"), std::string::npos) << with.sentence;
}

TEST(mqtt_connection, what_answers_http_or_closes_at_once_is_no_broker) {
  peers::peer http([&](peers::peer_end& end, int connection) {
    if (connection == 2)
      return;
    (void)end.read();
    end.write("HTTP/1.1 400 Bad Request\r\n\r\n");
    (void)end.last();
  });
  publisher first(http.port());
  ASSERT_TRUE(first.is_closed());
  EXPECT_EQ(first.reason, failure::refused) << first.sentence;
  publisher second(http.port());
  ASSERT_TRUE(second.is_closed());
  EXPECT_EQ(second.reason, failure::unreachable) << second.sentence;
}

TEST(mqtt_connection, floods_of_what_nobody_has_asked_for_end_it_at_the_first) {
  for (const auto& flood : {std::string("\x30\x05\x00\x01t\x00x", 7), peers::puback(3), peers::pingresp(), connack()}) {
    std::size_t written = 0;
    peers::peer broker([&](peers::peer_end& end, int) {
      (void)end.read();
      end.write(connack());
      std::string many;
      while (many.size() < 60'000)
        many += flood;
      while (end.write(many) && written < 1'000'000'000)
        written += many.size();
    });
    publisher with(broker.port());
    ASSERT_TRUE(with.is_closed());
    EXPECT_EQ(with.reason, failure::refused) << with.sentence;
  }
}

TEST(mqtt_connection, a_file_that_can_not_be_used_is_named_before_anybody_is_asked) {
  peers::peer broker([&](peers::peer_end& end, int) { (void)end.last(); });
  connection_settings settings;
  settings.username = "anna";
  settings.password_file = "/no/such/file";
  publisher with(broker.port(), "127.0.0.1", settings);
  ASSERT_TRUE(with.is_closed());
  EXPECT_EQ(with.reason, failure::unusable);
  EXPECT_NE(with.sentence.find("/no/such/file"), std::string::npos) << with.sentence;
  EXPECT_EQ(broker.connections(), 0);
}

TEST(mqtt_connection, ends_at_once_in_each_of_its_states) {
  peers::peer silent([&](peers::peer_end& end, int connection) {
    (void)end.read();
    if (connection % 2 == 0)
      end.write(connack());
    (void)end.last();
  });
  for (int n = 0; n < 40; ++n) {
    const auto began = std::chrono::steady_clock::now();
    {
      publisher with(silent.port());
      if (n % 4 >= 2)
        std::this_thread::sleep_for(20ms);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - began, 3s);
  }
}

} // namespace connection_test
} // namespace godwit::io::mqtt
