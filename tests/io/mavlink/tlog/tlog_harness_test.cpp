// The harness of the fuzzer finds defects: each is planted, and a short run from the kept inputs must meet it.
#include "tests/fuzz/tlog_harness.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace tlog_harness_test {

constexpr std::size_t rounds = 200; // changes of each input

std::vector<byte_buffer> kept_inputs() {
  std::vector<std::string> names;
  for (const auto& each : std::filesystem::directory_iterator(GODWIT_TEST_DATA "/fuzz/tlog"))
    names.push_back("fuzz/tlog/" + each.path().filename().string());
  std::ranges::sort(names); // the order of a folder is not the same everywhere
  std::vector<byte_buffer> inputs;
  for (const auto& each : names)
    inputs.push_back(test_data(each));
  return inputs;
}

// The first finding of a run that is the same every time.
template <class Reader>
fuzz::finding run() {
  std::mt19937_64 random(13);
  for (const auto& input : kept_inputs())
    for (std::size_t round = 0; round < rounds; ++round) {
      auto changed = input;
      for (std::size_t i = 0; i < round % 5; ++i) {
        const auto at = changed.begin() + static_cast<std::ptrdiff_t>(random() % changed.size());
        if (random() % 2 == 0)
          *at = static_cast<std::byte>(random());
        else
          changed.insert(at, magic_v2);
      }
      if (auto found = fuzz::check_tlog<Reader>(changed))
        return found;
    }
  return std::nullopt;
}

TEST(tlog_harness, has_inputs_and_finds_nothing_in_what_is_sound) {
  EXPECT_GE(kept_inputs().size(), 5U);
  const auto found = run<tlog_reader>();
  EXPECT_FALSE(found) << *found;
}

// Loses the frame after a broken one, and nothing else.
struct loses_the_next : tlog_reader {
  using tlog_reader::tlog_reader;
  mcap::result<std::optional<tlog_record>> next() {
    const auto broken = counts().bad_checksums + counts().cut_off + counts().not_frames;
    auto record = tlog_reader::next();
    const auto broken_now = counts().bad_checksums + counts().cut_off + counts().not_frames;
    return record && *record && broken != broken_now ? tlog_reader::next() : record;
  }
};

TEST(tlog_harness, finds_a_reader_that_loses_a_frame_after_a_broken_one) { EXPECT_TRUE(run<loses_the_next>()); }

struct takes_the_time_of_the_last : tlog_reader {
  using tlog_reader::tlog_reader;
  mcap::result<std::optional<tlog_record>> next() {
    auto record = tlog_reader::next();
    if (record && *record)
      std::swap((*record)->timestamp_us, last_us_);
    return record;
  }

private:
  std::uint64_t last_us_ = 0;
};

TEST(tlog_harness, finds_a_reader_that_gives_another_time) { EXPECT_TRUE(run<takes_the_time_of_the_last>()); }

struct calls_all_verified : tlog_reader {
  using tlog_reader::tlog_reader;
  mcap::result<std::optional<tlog_record>> next() {
    auto record = tlog_reader::next();
    if (record && *record)
      (*record)->is_verified = true;
    return record;
  }
};

TEST(tlog_harness, finds_a_reader_that_calls_unknown_ids_verified) { EXPECT_TRUE(run<calls_all_verified>()); }

} // namespace tlog_harness_test
} // namespace godwit::io::mavlink::test
