#include "programs/common/heartbeat_sender.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/signing/verifier.hpp"
#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace heartbeat_sender_test {

using namespace io::mavlink;
using programs::default_identity;
using programs::heartbeat_sender;

// A link that keeps what is sent.
class kept_link final : public io::link::link {
public:
  bool send(std::span<const std::byte> bytes, io::link::peer_id) override {
    sent.emplace_back(bytes.begin(), bytes.end());
    return true;
  }
  [[nodiscard]] io::link::link_counters counters() const override { return {}; }
  [[nodiscard]] std::string description() const override { return {}; }

  std::vector<std::vector<std::byte>> sent;
};

constexpr std::int64_t some_day_ns = static_cast<std::int64_t>(some_day_us) * 1'000;

TEST(heartbeat_sender, it_is_an_onboard_controller_and_numbers_its_frames) {
  kept_link link;
  heartbeat_sender sender(default_identity, std::nullopt);
  sender.send(link, some_day_ns);
  sender.send(link, some_day_ns);
  ASSERT_EQ(link.sent.size(), 2U);
  const auto frame = view_of(link.sent[1]);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->sequence(), 1);
  EXPECT_EQ(frame->from(), (io::mavlink::sender{1, 191}));
  const auto beat = decode<heartbeat>(*frame);
  EXPECT_EQ(beat.type, 18);
  EXPECT_EQ(beat.autopilot, 8);
  EXPECT_EQ(beat.base_mode, 0);
}

TEST(heartbeat_sender, with_a_key_it_is_signed) {
  kept_link link;
  heartbeat_sender sender({9, 100}, counting_key());
  sender.send(link, some_day_ns);
  sender.send(link, some_day_ns);
  replay_table streams;
  verifier check(counting_key(), streams);
  for (const auto& each : link.sent)
    EXPECT_EQ(check.judge(*view_of(each), signing_time_at(some_day_ns)), verdict::accepted_signed);
}

} // namespace heartbeat_sender_test
} // namespace godwit::trace_tool::test
