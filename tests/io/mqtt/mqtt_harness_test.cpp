// The harness of the fuzzer finds defects: each is planted, and a short run from the kept inputs must meet it. The run
// without one is the measured one, too: GODWIT_MUTATIONS says how many mutated inputs (docs/performance.md).
#include "tests/fuzz/mqtt_harness.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

namespace godwit::io::mqtt {
namespace mqtt_harness_test {

constexpr std::size_t usual_mutations = 12'000;

std::vector<std::string> kept_inputs() {
  std::vector<std::filesystem::path> files;
  for (const auto& each : std::filesystem::directory_iterator(GODWIT_TEST_DATA "/fuzz/mqtt"))
    files.push_back(each.path());
  std::ranges::sort(files); // the order of a folder is not the same everywhere
  std::vector<std::string> inputs;
  for (const auto& each : files) {
    std::ifstream from(each, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(from), std::istreambuf_iterator<char>());
  }
  return inputs;
}

void mutate(std::string& input, std::mt19937_64& random) {
  const auto at = random() % input.size();
  switch (random() % 4) {
  case 0:
    input[at] = static_cast<char>(random());
    break;
  case 1:
    input[at] = static_cast<char>(input[at] ^ (1 << random() % 8));
    break;
  case 2:
    input.insert(at, 1, static_cast<char>(random()));
    break;
  default:
    if (input.size() > 2)
      input.erase(at, 1);
  }
}

// The first finding of a run that is the same every time.
template <class Reader, class Session>
fuzz::finding run(std::size_t mutations = usual_mutations) {
  const auto inputs = kept_inputs();
  std::mt19937_64 random(35);
  for (std::size_t n = 0; n < mutations; ++n) {
    auto changed = inputs.at(n % inputs.size());
    for (auto left = n / inputs.size() % 5; left > 0; --left)
      mutate(changed, random);
    if (auto found = fuzz::check_mqtt<Reader, Session>(changed))
      return found;
  }
  return {};
}

TEST(mqtt_harness, has_inputs_and_finds_nothing_in_what_is_sound) {
  EXPECT_GE(kept_inputs().size(), 10U);
  const char* const asked = std::getenv("GODWIT_MUTATIONS");
  const auto found = run<packet_reader, session>(asked == nullptr ? usual_mutations : std::stoul(asked));
  EXPECT_FALSE(found) << *found;
}

// What the reader refuses by a sentence that ends in END is taken as a packet.
template <class Text>
struct takes_what_is : packet_reader {
  tl::expected<std::optional<packet>, violation> read(std::string_view& bytes) {
    auto next = packet_reader::read(bytes);
    if (next || !next.error().sentence.ends_with(Text::value))
      return next;
    bytes = {};
    return std::exchange(is_taken_, true) ? std::optional<packet>() : pingresp{};
  }

private:
  bool is_taken_ = false;
};
struct twice {
  static constexpr std::string_view value = " twice";
};
struct unknown {
  static constexpr std::string_view value = "(0x7a)";
};

TEST(mqtt_harness, finds_a_reader_that_takes_a_property_twice) { EXPECT_TRUE((run<takes_what_is<twice>, session>())); }
TEST(mqtt_harness, finds_a_reader_that_takes_an_unknown_property) {
  EXPECT_TRUE((run<takes_what_is<unknown>, session>()));
}

struct keeps_what_is_too_long : packet_reader {
  tl::expected<std::optional<packet>, violation> read(std::string_view& bytes) {
    const auto all = bytes;
    auto next = packet_reader::read(bytes);
    if (next || next.error().answer != reason_code::packet_too_large)
      return next;
    held_ += all.size() + max_packet_bytes;
    bytes = {};
    return std::nullopt;
  }
  [[nodiscard]] std::size_t held_bytes() const { return packet_reader::held_bytes() + held_; }

private:
  std::size_t held_ = 0;
};

TEST(mqtt_harness, finds_a_reader_that_keeps_a_packet_of_any_length) {
  EXPECT_TRUE((run<keeps_what_is_too_long, session>()));
}

struct loses_what_comes_in_pieces : packet_reader {
  tl::expected<std::optional<packet>, violation> read(std::string_view& bytes) {
    if (held_bytes() == 1 && !bytes.empty())
      bytes.remove_prefix(1);
    return packet_reader::read(bytes);
  }
};

TEST(mqtt_harness, finds_a_reader_that_loses_a_byte_between_two_pieces) {
  EXPECT_TRUE((run<loses_what_comes_in_pieces, session>()));
}

struct reports_twice : session {
  using session::session;
  std::vector<session_event> take_events() {
    auto result = session::take_events();
    if (!result.empty() && std::holds_alternative<session_published>(result.back()))
      result.push_back(result.back());
    return result;
  }
};

TEST(mqtt_harness, finds_a_session_that_reports_a_message_twice) { EXPECT_TRUE((run<packet_reader, reports_twice>())); }

// Receive Maximum comes to it as Topic Alias Maximum.
struct knows_no_receive_maximum : session {
  using session::session;
  void on_bytes(std::string_view bytes, std::int64_t now_ms) {
    std::string changed(bytes);
    std::ranges::replace(changed, '\x21', '\x22');
    session::on_bytes(changed, now_ms);
  }
};

TEST(mqtt_harness, finds_a_session_that_ignores_the_receive_maximum) {
  EXPECT_TRUE((run<packet_reader, knows_no_receive_maximum>()));
}

struct waits_for_ever : session {
  using session::session;
  void on_time(std::int64_t) {}
};

TEST(mqtt_harness, finds_a_session_that_waits_for_ever) { EXPECT_TRUE((run<packet_reader, waits_for_ever>())); }

} // namespace mqtt_harness_test
} // namespace godwit::io::mqtt
