// The harness of the fuzzer finds defects: each is planted, and a short run from the kept inputs must meet it.
#include "tests/fuzz/scan_harness.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink {
namespace scan_harness_test {

constexpr std::size_t rounds = 300; // changes of each input; the defects are met within some ten

std::vector<byte_buffer> kept_inputs() {
  std::vector<std::string> names;
  for (const auto& each : std::filesystem::directory_iterator(GODWIT_TEST_DATA "/fuzz/mavlink_scan"))
    names.push_back("fuzz/mavlink_scan/" + each.path().filename().string());
  std::ranges::sort(names); // the order of a folder is not the same everywhere
  std::vector<byte_buffer> inputs;
  for (const auto& each : names)
    inputs.push_back(test_data(each));
  return inputs;
}

// As a fuzzer would: a byte changed, put in or taken out, a few times.
byte_buffer changed(byte_buffer input, std::mt19937_64& random) {
  for (auto changes = 1 + random() % 4; changes != 0 && !input.empty(); --changes) {
    const auto at = input.begin() + static_cast<std::ptrdiff_t>(random() % input.size());
    switch (random() % 3) {
    case 0:
      *at = static_cast<std::byte>(random());
      break;
    case 1:
      input.insert(at, random() % 4 == 0 ? magic_v2 : static_cast<std::byte>(random()));
      break;
    default:
      input.erase(at);
    }
  }
  return input;
}

// The first finding of a run that is the same every time.
template <class Scanner, class Codec>
fuzz::finding run() {
  std::mt19937_64 random(11);
  for (const auto& input : kept_inputs()) {
    if (auto found = fuzz::check<Scanner, Codec>(input))
      return found;
    for (std::size_t i = 0; i < rounds; ++i)
      if (auto found = fuzz::check<Scanner, Codec>(changed(input, random)))
        return found;
  }
  return std::nullopt;
}

TEST(scan_harness, has_inputs_and_finds_nothing_in_what_is_sound) {
  EXPECT_GE(kept_inputs().size(), 5U);
  const auto found = run<scanner, fuzz::real_codec>();
  EXPECT_FALSE(found) << *found;
}

// Forgets that zeros were cut off: what stood in the memory before becomes part of the message.
struct codec_without_padding {
  template <message M>
  static M decode(const frame_view& frame) {
    std::array<std::byte, layout<M>::full_length> stale;
    stale.fill(std::byte{0xAA});
    const auto payload = frame.payload();
    std::memcpy(stale.data(), payload.data(), std::min(payload.size(), stale.size()));
    return read_fields<M>(stale.data());
  }
};

TEST(scan_harness, finds_a_decoder_that_does_not_fill_up_with_zeros) {
  EXPECT_TRUE((run<scanner, codec_without_padding>()));
}

// Reads one byte less than there is when the payload is longer than the message.
struct codec_off_by_one {
  template <message M>
  static M decode(const frame_view& frame) {
    const auto payload = frame.payload();
    return decode_payload<M>(payload.size() > 1 ? payload.first(payload.size() - 1) : payload);
  }
};

TEST(scan_harness, finds_a_decoder_that_drops_the_last_byte) { EXPECT_TRUE((run<scanner, codec_off_by_one>())); }

// Passes over by its length whatever begins with FD, right or not.
class blind_scanner {
public:
  template <class Sink>
  void feed(byte_view bytes, Sink&& sink) {
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    std::size_t at = 0;
    while (at + min_frame_size <= waiting_.size()) {
      if (waiting_[at] != magic_v2) {
        ++at;
        continue;
      }
      const frame_view frame(waiting_.data() + at);
      if (at + frame.size() > waiting_.size())
        break;
      const auto* const info = find_message(frame.id());
      if (info != nullptr && crc_matches(frame, info->crc_extra))
        sink(frame);
      at += frame.size();
    }
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  template <class Sink>
  void end_of_datagram(Sink&&) {
    waiting_.clear();
  }
  [[nodiscard]] const scan_counters& counters() const { return counters_; }

private:
  byte_buffer waiting_;
  scan_counters counters_;
};

TEST(scan_harness, finds_a_scanner_that_passes_over_blindly) { EXPECT_TRUE((run<blind_scanner, fuzz::real_codec>())); }

// Forgets what waits for its rest.
class forgetful_scanner {
public:
  template <class Sink>
  void feed(byte_view bytes, Sink&& sink) {
    inner_.feed_datagram(bytes, sink);
  }
  template <class Sink>
  void end_of_datagram(Sink&& sink) {
    inner_.end_of_datagram(sink);
  }
  [[nodiscard]] const scan_counters& counters() const { return inner_.counters(); }

private:
  scanner inner_;
};

TEST(scan_harness, finds_a_scanner_that_forgets_at_the_end_of_a_piece) {
  EXPECT_TRUE((run<forgetful_scanner, fuzz::real_codec>()));
}

} // namespace scan_harness_test
} // namespace godwit::io::mavlink
