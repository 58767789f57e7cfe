// The harness of the fuzzer finds defects: each is planted, and a short run from the kept inputs must meet it.
#include "tests/fuzz/signed_harness.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace signed_harness_test {

constexpr std::size_t rounds = 200; // changes of each input

std::vector<byte_buffer> kept_inputs() {
  std::vector<std::string> names;
  for (const auto& each : std::filesystem::directory_iterator(GODWIT_TEST_DATA "/fuzz/mavlink_signed"))
    names.push_back("fuzz/mavlink_signed/" + each.path().filename().string());
  std::ranges::sort(names); // the order of a folder is not the same everywhere
  std::vector<byte_buffer> inputs;
  for (const auto& each : names)
    inputs.push_back(test_data(each));
  return inputs;
}

// The first finding of a run that is the same every time. Bytes are changed in place, so that the steps stay apart.
template <class Verifier>
fuzz::finding run() {
  std::mt19937_64 random(12);
  for (const auto& input : kept_inputs())
    for (std::size_t round = 0; round < rounds; ++round) {
      auto changed = input;
      for (std::size_t i = 0; i < round % 5; ++i)
        changed[random() % changed.size()] = static_cast<std::byte>(random());
      if (auto found = fuzz::check_signed<Verifier>(changed))
        return found;
    }
  return std::nullopt;
}

// A verifier as it is, to plant a defect into what it says.
class defective_verifier {
public:
  defective_verifier(secret_key key, replay_table& streams) : right_(std::move(key), streams) {}

protected:
  [[nodiscard]] verdict right_verdict(const frame_view& frame, signing_time now) { return right_.judge(frame, now); }

private:
  verifier right_;
};

TEST(signed_harness, has_inputs_and_finds_nothing_in_what_is_sound) {
  EXPECT_GE(kept_inputs().size(), 5U);
  const auto found = run<verifier>();
  EXPECT_FALSE(found) << *found;
}

struct accepts_what_is_equal : defective_verifier {
  using defective_verifier::defective_verifier;
  verdict judge(const frame_view& frame, signing_time now) {
    const auto found = right_verdict(frame, now);
    return found == verdict::replayed ? verdict::accepted_signed : found;
  }
};

TEST(signed_harness, finds_a_verifier_that_takes_replays) { EXPECT_TRUE(run<accepts_what_is_equal>()); }

struct accepts_the_future : defective_verifier {
  using defective_verifier::defective_verifier;
  verdict judge(const frame_view& frame, signing_time now) {
    const auto found = right_verdict(frame, now);
    return found == verdict::too_new ? verdict::accepted_signed : found;
  }
};

TEST(signed_harness, finds_a_verifier_without_a_bound_on_the_future) { EXPECT_TRUE(run<accepts_the_future>()); }

// Compares five of the six bytes.
struct compares_too_little : defective_verifier {
  compares_too_little(secret_key key, replay_table& streams)
      : defective_verifier(std::move(key), streams), hasher_(secret_key(fuzz::harness_key())) {}
  verdict judge(const frame_view& frame, signing_time now) {
    const auto found = right_verdict(frame, now);
    if (found != verdict::bad_signature)
      return found;
    const auto claimed = signature_of(frame);
    const auto right = hasher_.hash_of(frame.bytes().first(frame.size() - signature_size), claimed.link, claimed.time);
    return std::equal(right.begin(), right.end() - 1, claimed.hash.begin()) ? verdict::accepted_signed : found;
  }

private:
  frame_hasher hasher_;
};

TEST(signed_harness, finds_a_verifier_that_compares_five_of_six_bytes) { EXPECT_TRUE(run<compares_too_little>()); }

} // namespace signed_harness_test
} // namespace godwit::io::mavlink::test
