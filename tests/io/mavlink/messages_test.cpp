#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/fields/binary.hpp"
#include "io/fields/json_text.hpp"
#include "io/mavlink/ids.hpp"
#include "io/mavlink/messages.hpp"
#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink {

namespace messages_test {

TEST(messages, are_forty_five_each_as_published) {
  std::set<std::uint32_t> ids;
  known_messages::for_each([&]<message M>() {
    const auto* const info = find_message(M::message_id);
    ASSERT_NE(info, nullptr);
    EXPECT_EQ(info->name, type_name<M>());
    EXPECT_EQ(info->crc_extra, layout<M>::crc_extra) << type_name<M>();
    EXPECT_EQ(info->base_length, layout<M>::base_length) << type_name<M>();
    EXPECT_EQ(info->full_length, layout<M>::full_length) << type_name<M>();
    ids.insert(M::message_id);
  });
  EXPECT_EQ(ids.size(), 45U);
  EXPECT_EQ(known_messages::size, 45U);
}

TEST(messages, a_text_is_rendered_up_to_its_end) {
  statustext said{.severity = 6};
  std::string_view("Ready to FLY").copy(said.text.data(), said.text.size());
  EXPECT_EQ(to_json(said), R"({"severity":6,"text":"Ready to FLY","id":0,"chunk_seq":0})");
  said.text.fill('x');
  EXPECT_NE(to_json(said).find('"' + std::string(50, 'x') + '"'), std::string::npos);
}

// A value of a field, any bits of it; RapidCheck makes it smaller when a case fails.
template <class V>
void fill(V& value) {
  if constexpr (wire_value<V>::is_array) {
    for (auto& each : value)
      fill(each);
  } else if constexpr (std::is_same_v<V, float>) {
    const auto bits = *rc::gen::oneOf(rc::gen::just(0U), rc::gen::arbitrary<std::uint32_t>());
    std::memcpy(&value, &bits, sizeof value);
  } else {
    value = *rc::gen::oneOf(rc::gen::just(V{}), rc::gen::arbitrary<V>());
  }
}

template <message M>
M any() {
  M result;
  for_each_field<M>([&](const auto& entry) { fill(result.*entry.member); });
  return result;
}

template <message M>
void check_round_trip() {
  const M sent = any<M>();
  const sender from{*rc::gen::arbitrary<std::uint8_t>(), *rc::gen::arbitrary<std::uint8_t>()};
  const auto sequence = *rc::gen::arbitrary<std::uint8_t>();
  const auto frame = encode(sent, from, sequence);
  RC_ASSERT(frame.view().payload().size() == 1 || frame.view().payload().back() != std::byte{0});
  int frames = 0;
  scanner frames_of;
  frames_of.feed(frame.span(), [&](const frame_view& each) {
    ++frames;
    RC_ASSERT(each.from() == from && each.sequence() == sequence && each.id() == M::message_id);
    RC_ASSERT(visit(each, [&]<message R>(const R& received) {
      if constexpr (std::is_same_v<R, M>)
        RC_ASSERT(bits_of(received) == bits_of(sent));
      else
        RC_FAIL("visited as another message");
    }));
  });
  RC_ASSERT(frames == 1);
}

RC_GTEST_PROP(messages_property, each_comes_back_from_its_frame_with_all_its_bits, ()) {
  known_messages::for_each([]<message M>() { check_round_trip<M>(); });
}

template <class T>
std::string decoded_json(const T& value) {
  std::array<std::byte, 512> memory{};
  byte_sink sink(memory);
  encode_value(sink, value);
  byte_source source(std::span<const std::byte>(memory).first(sink.used()));
  std::string text;
  append_decoded_json<T>(text, source);
  return text;
}

RC_GTEST_PROP(messages_property, no_rendering_contains_the_secret, ()) {
  setup_signing said{.target_system = 1, .target_component = 1};
  for (auto& each : said.secret_key)
    each = *rc::gen::inRange<std::uint8_t>(100, 255); // three digits, which no other field gives
  std::array<std::byte, 64> memory{};
  byte_sink sink(memory);
  encode_value(sink, said);
  const auto stored = std::span<const std::byte>(memory).first(sink.used());
  const auto key = std::as_bytes(std::span(said.secret_key));
  RC_ASSERT(std::search(stored.begin(), stored.end(), key.begin(), key.begin() + 4) == stored.end());
  for (const auto& text : {to_json(said), decoded_json(said)}) {
    RC_ASSERT(text == R"({"target_system":1,"target_component":1,"initial_timestamp":0})");
    RC_ASSERT(text.find("key") == std::string::npos);
  }
}

TEST(messages, what_the_trace_stores_renders_as_the_message_does) {
  std::mt19937_64 random(3);
  known_messages::for_each([&]<message M>() {
    for (int i = 0; i < 20; ++i) {
      const auto each = random_message<M>(random);
      EXPECT_EQ(decoded_json(each), to_json(each)) << type_name<M>();
    }
  });
}

} // namespace messages_test

namespace message_list_test {

using two = message_list<heartbeat, statustext>;

TEST(message_list, visits_the_type_of_the_frame) {
  const auto frame = encode(heartbeat{.type = 2}, {1, 1}, 0);
  int type = 0;
  EXPECT_TRUE(two::visit(frame.view(), [&]<message M>(const M& each) {
    if constexpr (std::is_same_v<M, heartbeat>)
      type = each.type;
  }));
  EXPECT_EQ(type, 2);
}

TEST(message_list, does_not_visit_other_ids) {
  int calls = 0;
  const auto count = [&](const auto&) { ++calls; };
  EXPECT_FALSE(two::visit(encode(ping{}, {1, 1}, 0).view(), count));                       // a gap
  EXPECT_FALSE(two::visit(encode(protocol_version{}, {1, 1}, 0).view(), count));           // above the last
  EXPECT_FALSE(two::visit(frame_buffer(0xFFFFFF, 0, {}, {1, 1}, 0, false).view(), count)); // the highest there is
  EXPECT_EQ(calls, 0);
}

TEST(message_list, says_what_it_contains) {
  static_assert(two::contains(0) && two::contains(253));
  static_assert(!two::contains(1) && !two::contains(254) && !two::contains(1U << 23U));
  EXPECT_EQ(two::place_of(253), 1);
}

} // namespace message_list_test

} // namespace godwit::io::mavlink
