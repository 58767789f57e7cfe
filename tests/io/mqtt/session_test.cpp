// A session and a broker by hand, in a time that the test moves.
#include "io/mqtt/session.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "io/mqtt/encoder.hpp"
#include "tests/support/mqtt_bytes.hpp"

namespace godwit::io::mqtt {
namespace session_test {

namespace bytes = tests::mqtt;
using bytes::connack;
using bytes::number;
using bytes::property;

message text_of(bool is_acknowledged, std::string payload = "{}", bool is_retained = false) {
  return {"gw/v1/rover-7/event", std::make_shared<const std::string>(std::move(payload)), is_acknowledged, is_retained,
          0};
}

class talk {
public:
  talk() { begin(); }
  explicit talk(const std::string& answer) {
    begin();
    hear(answer);
  }

  void begin() {
    ours.begin(nullptr, now_ms);
    pump();
  }
  void hear(const std::string& what) {
    ours.on_bytes(what, now_ms);
    pump();
  }
  void publish(const message& what, std::uint64_t token) {
    ours.publish(what, token, now_ms);
    pump();
  }
  // Where the network takes all: written at once.
  void pump() {
    collect();
    for (auto batch = ours.take_batch(now_ms); takes && !batch.empty(); batch = ours.take_batch(now_ms)) {
      wire += batch;
      ours.on_written(now_ms);
      collect();
    }
    for (auto& each : bytes::packets_in(wire))
      sent.push_back(std::move(each));
  }
  void wait(std::int64_t ms) {
    for (const auto end = now_ms + ms; now_ms < end;) {
      now_ms = std::min(end, std::max(now_ms + 1, ours.next_due_ms()));
      ours.on_time(now_ms);
      pump();
    }
  }
  [[nodiscard]] std::vector<bytes::publish_packet> published() const {
    std::vector<bytes::publish_packet> result;
    for (const auto& each : sent)
      if (each.type == bytes::publish_type)
        result.push_back(bytes::read_publish(each));
    return result;
  }
  [[nodiscard]] std::ptrdiff_t count(int type) const {
    return std::ranges::count(sent, type, &bytes::raw_packet::type);
  }

  session ours{{"rover-7", "", 15}, {"gw/v1/rover-7/status", std::make_shared<const std::string>("{}"), true, true, 0}};
  std::int64_t now_ms = 1'000'000;
  bool takes = true;
  std::string wire;
  std::vector<bytes::raw_packet> sent;
  std::vector<std::uint64_t> tokens;
  std::optional<session_opened> opened;
  std::optional<session_closed> closed;

private:
  void collect() {
    for (const auto& event : ours.take_events()) {
      EXPECT_FALSE(closed) << "nothing comes after it";
      if (const auto* const m = std::get_if<session_opened>(&event))
        opened = *m;
      else if (const auto* const taken = std::get_if<session_published>(&event))
        tokens.push_back(taken->token);
      else
        closed = std::get<session_closed>(event);
    }
  }
};

TEST(mqtt_session, connects_publishes_and_reports_what_the_broker_has) {
  talk with;
  ASSERT_EQ(with.sent.size(), 1U);
  EXPECT_EQ(with.sent.front().type, bytes::connect_type);
  with.publish(text_of(true), 1);
  EXPECT_EQ(with.sent.size(), 1U) << "not before the broker has answered";
  with.hear(connack());
  ASSERT_TRUE(with.opened);
  with.publish(text_of(false), 2);
  with.publish(text_of(true), 3);
  EXPECT_EQ(with.tokens, std::vector<std::uint64_t>{2}) << "without an acknowledgement it counts when it has left";
  ASSERT_EQ(with.published().size(), 2U);
  with.hear(bytes::puback(with.published().back().id, 0x10));
  EXPECT_EQ(with.tokens, (std::vector<std::uint64_t>{2, 3}));
  EXPECT_FALSE(with.closed);
}

TEST(mqtt_session, the_receive_maximum_of_the_broker_is_not_exceeded_and_the_order_is_kept) {
  talk with(connack(0, property(0x21, number(2, 2))));
  for (std::uint64_t token = 1; token <= 5; ++token)
    with.publish(text_of(true, std::to_string(token)), token);
  with.publish(text_of(false, "live"), 9);
  EXPECT_EQ(with.published().size(), 3U) << "two, and what needs no acknowledgement";
  for (std::size_t n = 0; with.tokens.size() < 6 && n < 20; ++n) {
    std::vector<int> waiting;
    for (const auto& each : with.published())
      if (each.qos == 1)
        waiting.push_back(each.id);
    with.hear(bytes::puback(waiting.at(n)));
  }
  EXPECT_EQ(with.tokens, (std::vector<std::uint64_t>{9, 1, 2, 3, 4, 5}));
}

TEST(mqtt_session, the_keep_alive_of_the_broker_holds_and_ours_where_it_has_none) {
  for (const auto& [answer, period_ms] : {std::pair(connack(), 15'000),
                                          {connack(0, property(0x13, number(5, 2))), 5'000},
                                          {connack(0, property(0x13, number(600, 2))), 15'000},
                                          {connack(0, property(0x13, number(0, 2))), 15'000}}) {
    talk with(answer);
    with.wait(period_ms - 1);
    EXPECT_EQ(with.count(bytes::pingreq_type), 0);
    with.wait(1);
    EXPECT_EQ(with.count(bytes::pingreq_type), 1);
    with.hear(bytes::pingresp());
    with.wait(period_ms);
    EXPECT_EQ(with.count(bytes::pingreq_type), 2);
    EXPECT_FALSE(with.closed);
  }
}

TEST(mqtt_session, who_only_sends_still_asks_for_a_sign_of_life) {
  talk with(connack());
  for (int i = 0; i < 29 && !with.closed; ++i) {
    with.wait(1'000);
    with.publish(text_of(false), 1);
  }
  EXPECT_EQ(with.count(bytes::pingreq_type), 1);
  with.wait(2'000);
  ASSERT_TRUE(with.closed) << "15 s after the ping";
  EXPECT_EQ(with.closed->why, failure::lost);
}

TEST(mqtt_session, a_broker_without_retained_messages_gets_none) {
  talk with(connack(0, property(0x25, number(0, 1))));
  with.publish(text_of(false, "{}", true), 1);
  ASSERT_EQ(with.published().size(), 1U);
  EXPECT_FALSE(with.published().front().is_retained);
  talk refused(connack(0x9A));
  EXPECT_EQ(refused.closed->why, failure::retain_refused) << "then without a retained will";
}

TEST(mqtt_session, a_broker_under_which_events_would_be_lost_is_refused) {
  talk without(connack(0, property(0x24, number(0, 1))));
  ASSERT_TRUE(without.closed);
  EXPECT_NE(without.closed->sentence.find("Maximum QoS 0"), std::string::npos);
  EXPECT_EQ(without.count(bytes::disconnect_type), 1);
  talk small(connack(0, property(0x27, number(1'023, 4))));
  ASSERT_TRUE(small.closed);
  EXPECT_NE(small.closed->sentence.find("at most 1023 bytes"), std::string::npos) << small.closed->sentence;
}

TEST(mqtt_session, a_packet_that_the_broker_does_not_take_is_not_sent) {
  talk with(connack(0, property(0x27, number(2'000, 4))));
  EXPECT_EQ(with.opened->max_packet_bytes, 2'000U);
  with.publish(text_of(true, std::string(1'900, ' ')), 1);
  EXPECT_EQ(with.published().size(), 1U);
  with.publish(text_of(true, std::string(2'000, ' ')), 2);
  EXPECT_EQ(with.published().size(), 1U);
  ASSERT_TRUE(with.closed);
  EXPECT_EQ(with.closed->why, failure::unusable);
}

TEST(mqtt_session, who_refuses_is_understood) {
  for (const auto& [answer, why] : {std::pair(connack(0x87), failure::not_authorised),
                                    {connack(0x86), failure::not_authorised},
                                    {connack(0x97), failure::refused},
                                    {std::string("\x20\x02\x00\x01", 4), failure::refused},
                                    {bytes::disconnect(0x89), failure::refused}}) {
    talk with(answer);
    ASSERT_TRUE(with.closed);
    EXPECT_EQ(with.closed->why, why);
    EXPECT_TRUE(with.ours.is_over());
    EXPECT_TRUE(with.closed->sentence.starts_with("the broker refuses the connection: ")) << with.closed->sentence;
  }
  talk moved(connack());
  moved.hear(bytes::disconnect(0x8E));
  EXPECT_EQ(moved.closed->why, failure::taken_over);
}

TEST(mqtt_session, a_message_that_is_not_taken_ends_it_and_does_not_count) {
  talk with(connack());
  with.publish(text_of(true), 1);
  with.hear(bytes::puback(with.published().front().id, 0x87));
  EXPECT_TRUE(with.tokens.empty());
  ASSERT_TRUE(with.closed);
  EXPECT_EQ(with.closed->why, failure::not_authorised);
  EXPECT_EQ(with.closed->sentence, "the broker does not take a message: Not authorized");
}

TEST(mqtt_session, what_does_not_belong_here_ends_it_with_a_reason_for_the_broker) {
  for (const auto& [sent, reason] : {std::pair(std::string("\x30\x03\x00\x01t", 5), 0x82),
                                     {connack(), 0x82},
                                     {bytes::pingresp(), 0x82},
                                     {bytes::puback(77), 0x82},
                                     {std::string("\x20\xff\xff\xff\x7f"), 0x95},
                                     {bytes::puback(1, 0, property(0x7a, "x")), 0x81}}) {
    talk with(connack());
    with.hear(sent);
    ASSERT_TRUE(with.closed) << reason;
    EXPECT_EQ(with.closed->why, failure::refused);
    ASSERT_EQ(with.count(bytes::disconnect_type), 1);
    EXPECT_EQ(static_cast<unsigned char>(with.sent.back().body.at(0)), reason) << with.closed->sentence;
    EXPECT_TRUE(with.ours.is_over());
    with.publish(text_of(true), 1);
    EXPECT_EQ(with.count(bytes::publish_type), 0);
  }
}

TEST(mqtt_session, a_broker_that_says_nothing_is_given_up) {
  talk silent;
  silent.wait(session::answer_timeout_ms - 1);
  EXPECT_FALSE(silent.closed);
  silent.wait(1);
  EXPECT_EQ(silent.closed->why, failure::unreachable);

  talk pings_only(connack());
  pings_only.publish(text_of(true), 1);
  for (int i = 0; i < 65 && !pings_only.closed; ++i) {
    const auto pings = pings_only.count(bytes::pingreq_type);
    pings_only.wait(1'000);
    if (pings_only.count(bytes::pingreq_type) > pings)
      pings_only.hear(bytes::pingresp());
  }
  ASSERT_TRUE(pings_only.closed) << "it has acknowledged nothing for a minute";
  EXPECT_EQ(pings_only.closed->sentence, "the broker has acknowledged no message for 60 s");
}

TEST(mqtt_session, a_network_that_takes_nothing_is_given_up_and_no_queue_grows) {
  talk with(connack());
  with.takes = false;
  with.publish(text_of(false), 1);
  with.wait(session::write_timeout_ms);
  ASSERT_TRUE(with.closed);
  EXPECT_EQ(with.closed->sentence, "the network has taken nothing for 30 s");

  talk flooded(connack());
  flooded.takes = false;
  for (std::uint64_t token = 1; token <= session::max_queued + 2; ++token)
    flooded.publish(text_of(false), token);
  EXPECT_TRUE(flooded.closed);
}

TEST(mqtt_session, its_end_tells_the_broker_to_publish_the_will) {
  talk with(connack());
  with.ours.end(with.now_ms);
  with.pump();
  ASSERT_EQ(with.sent.back().type, bytes::disconnect_type);
  EXPECT_EQ(with.sent.back().body, "\x04");
  EXPECT_TRUE(with.ours.is_over());
  EXPECT_FALSE(with.closed) << "nobody listens any more";
}

RC_GTEST_PROP(mqtt_session_property, each_message_counts_once_and_no_more_wait_than_the_broker_bears, ()) {
  const auto maximum = *rc::gen::inRange(1, 30);
  talk with(connack(0, property(0x21, number(static_cast<std::uint64_t>(maximum), 2))));
  std::set<int> waiting;
  std::size_t seen = 0;
  std::set<std::uint64_t> expected;
  std::uint64_t token = 0;
  for (const auto act : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 4))) {
    if (act == 0 && !waiting.empty()) {
      const auto id = *std::next(waiting.begin(), *rc::gen::inRange<int>(0, static_cast<int>(waiting.size())));
      waiting.erase(id);
      with.hear(bytes::puback(id));
    } else if (token < session::max_queued - 2) {
      with.publish(text_of(act != 1), ++token);
    }
    const auto sent = with.published();
    for (; seen < sent.size(); ++seen)
      if (sent[seen].qos == 1)
        RC_ASSERT(waiting.insert(sent[seen].id).second);
    RC_ASSERT(waiting.size() <= static_cast<std::size_t>(maximum));
  }
  RC_ASSERT(!with.closed);
  while (!waiting.empty()) {
    const auto id = *waiting.begin();
    waiting.erase(id);
    with.hear(bytes::puback(id));
    const auto sent = with.published();
    for (; seen < sent.size(); ++seen)
      if (sent[seen].qos == 1)
        waiting.insert(sent[seen].id);
  }
  RC_ASSERT(std::set(with.tokens.begin(), with.tokens.end()).size() == with.tokens.size());
  RC_ASSERT(with.tokens.size() == token);
}

} // namespace session_test
} // namespace godwit::io::mqtt
