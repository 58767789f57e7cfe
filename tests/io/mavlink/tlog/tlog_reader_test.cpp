#include <algorithm>
#include <functional>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/mavlink/tlog/tlog_reader.hpp"
#include "tests/io/mavlink/tlog/tlog_fixture.hpp"

namespace godwit::io::mavlink::test {

namespace tlog_reader_test {

byte_buffer heartbeat_bytes() { return from_hex("fd09000000ffbe000000000000001208000403211a"); }
byte_buffer signed_heartbeat() {
  return from_hex("fd09010000ffbe000000000000001208000403c6e2036655443322115b1a95938762");
}
std::string hex_of_heartbeat() { return to_hex(heartbeat_bytes()); }

// What stands around the thing under test: two heartbeats before, two after, a millisecond apart.
reading read_between(const std::function<void(log_builder&)>& put) {
  log_builder log;
  log.record(some_day_us + 1000, heartbeat_bytes()).record(some_day_us + 2000, heartbeat_bytes());
  put(log);
  log.record(some_day_us + 4000, heartbeat_bytes()).record(some_day_us + 5000, heartbeat_bytes());
  return read_bytes(log.bytes());
}

void expect_the_four_around(const reading& seen) {
  ASSERT_GE(seen.records.size(), 4U);
  const auto& records = seen.records;
  const std::size_t n = records.size();
  EXPECT_EQ(records[0], (plain_record{some_day_us + 1000, hex_of_heartbeat()}));
  EXPECT_EQ(records[1], (plain_record{some_day_us + 2000, hex_of_heartbeat()}));
  EXPECT_EQ(records[n - 2], (plain_record{some_day_us + 4000, hex_of_heartbeat()}));
  EXPECT_EQ(records[n - 1], (plain_record{some_day_us + 5000, hex_of_heartbeat()}));
}

TEST(mavlink_tlog_reader, an_empty_log_has_an_end_and_nothing_else) {
  const auto seen = read_bytes({});
  EXPECT_TRUE(seen.records.empty());
  EXPECT_EQ(seen.counts.skipped_bytes, 0U);
}

TEST(mavlink_tlog_reader, gives_time_and_frame) {
  log_builder log;
  log.record(some_day_us, heartbeat_bytes()).record(some_day_us + 1, signed_heartbeat());
  const auto seen = read_bytes(log.bytes());
  EXPECT_EQ(seen.records, (std::vector<plain_record>{{some_day_us, hex_of_heartbeat()},
                                                     {some_day_us + 1, to_hex(signed_heartbeat())}}));
}

TEST(mavlink_tlog_reader, the_time_of_a_right_record_is_given_whatever_it_is) {
  log_builder log;
  for (const std::uint64_t time_us : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}})
    log.record(time_us, heartbeat_bytes());
  const auto seen = read_bytes(log.bytes());
  ASSERT_EQ(seen.records.size(), 3U);
  EXPECT_EQ(seen.records[0].timestamp_us, 0U);
  EXPECT_EQ(seen.records[2].timestamp_us, ~std::uint64_t{0});
}

TEST(mavlink_tlog_reader, a_frame_with_a_bad_checksum_is_passed_over) {
  auto bad = heartbeat_bytes();
  bad.back() ^= std::byte{1};
  const auto seen = read_between([&](log_builder& log) { log.record(some_day_us + 3000, bad); });
  expect_the_four_around(seen);
  EXPECT_EQ(seen.records.size(), 4U);
  EXPECT_EQ(seen.counts.bad_checksums, 1U);
  EXPECT_EQ(seen.counts.skipped_bytes, tlog_time_size + bad.size());
}

TEST(mavlink_tlog_reader, a_frame_cut_off_at_any_byte_costs_only_itself) {
  for (const auto& whole : {heartbeat_bytes(), signed_heartbeat()})
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto seen =
          read_between([&](log_builder& log) { log.record(some_day_us + 3000, byte_view(whole).first(size)); });
      expect_the_four_around(seen);
      EXPECT_EQ(seen.records.size(), 4U) << size;
      EXPECT_EQ(seen.counts.cut_off + seen.counts.not_frames, 1U) << size;
      EXPECT_EQ(seen.counts.skipped_bytes, tlog_time_size + size);
    }
}

TEST(mavlink_tlog_reader, a_time_cut_off_at_any_byte_costs_only_the_time) {
  for (std::size_t missing = 1; missing <= tlog_time_size; ++missing) {
    log_builder record;
    record.record(some_day_us + 3000, heartbeat_bytes());
    const auto seen = read_between([&](log_builder& log) { log.raw(byte_view(record.bytes()).subspan(missing)); });
    expect_the_four_around(seen);
    ASSERT_EQ(seen.records.size(), 5U) << missing;
    EXPECT_EQ(seen.records[2], (plain_record{some_day_us + 2000, hex_of_heartbeat()})) << missing;
    EXPECT_EQ(seen.counts.without_time, 1U);
  }
}

TEST(mavlink_tlog_reader, false_starts_cost_nothing) {
  for (const std::string_view start :
       {"fd", "fdff0000", "fe40", "fdff00000000000000000000", "fd0000", "fefe", "fdfdfd"}) {
    // As a record of its own, as bytes between records, and after a time together with a right frame.
    const auto alone = read_between([&](log_builder& log) { log.time(some_day_us + 3000).raw_hex(start); });
    expect_the_four_around(alone);
    EXPECT_EQ(alone.records.size(), 4U) << start;
    const auto between = read_between([&](log_builder& log) { log.raw_hex(start); });
    expect_the_four_around(between);
    EXPECT_EQ(between.records.size(), 4U) << start;
    const auto joined =
        read_between([&](log_builder& log) { log.time(some_day_us + 3000).raw_hex(start).raw(heartbeat_bytes()); });
    expect_the_four_around(joined);
    ASSERT_EQ(joined.records.size(), 5U) << start;
    EXPECT_EQ(joined.records[2], (plain_record{some_day_us + 3000, hex_of_heartbeat()})) << start;
  }
}

TEST(mavlink_tlog_reader, several_frames_after_one_time_are_all_given_with_it) {
  const auto seen = read_between([&](log_builder& log) {
    log.record(some_day_us + 3000, heartbeat_bytes()).raw(signed_heartbeat()).raw(heartbeat_bytes());
  });
  expect_the_four_around(seen);
  ASSERT_EQ(seen.records.size(), 7U);
  EXPECT_EQ(seen.records[3], (plain_record{some_day_us + 3000, to_hex(signed_heartbeat())}));
  EXPECT_EQ(seen.records[4], (plain_record{some_day_us + 3000, hex_of_heartbeat()}));
  EXPECT_EQ(seen.counts.without_time, 2U);
  EXPECT_EQ(seen.counts.skipped_bytes, 0U);
}

TEST(mavlink_tlog_reader, a_frame_of_an_unknown_id_is_given_as_not_verified) {
  for (const std::size_t size : {1, 9, 255}) {
    const auto seen = read_between([&](log_builder& log) { log.record(some_day_us + 3000, unknown_frame(size)); });
    expect_the_four_around(seen);
    ASSERT_EQ(seen.records.size(), 5U);
    EXPECT_EQ(seen.records[2], (plain_record{some_day_us + 3000, to_hex(unknown_frame(size)), false}));
    EXPECT_EQ(seen.counts.unknown_ids, 1U);
  }
  log_builder last;
  EXPECT_EQ(read_bytes(last.record(some_day_us, unknown_frame(9)).bytes()).records.size(), 1U);
}

TEST(mavlink_tlog_reader, a_false_start_whose_length_happens_to_fit_takes_no_record_with_it) {
  // An unknown id and a length that reaches exactly over one record to the next.
  log_builder record;
  record.record(some_day_us + 3500, heartbeat_bytes());
  byte_buffer start = unknown_frame(1);
  start.resize(header_size);
  start[length_at] = static_cast<std::byte>(record.bytes().size() - crc_size);
  const auto seen = read_between([&](log_builder& log) { log.record(some_day_us + 3000, start).raw(record.bytes()); });
  expect_the_four_around(seen);
  ASSERT_EQ(seen.records.size(), 5U);
  EXPECT_EQ(seen.records[2], (plain_record{some_day_us + 3500, hex_of_heartbeat()}));
  EXPECT_EQ(seen.counts.unknown_ids, 0U);
}

TEST(mavlink_tlog_reader, unknown_flags_and_mavlink_1_are_counted_and_passed_over) {
  const auto seen = read_between([&](log_builder& log) {
    log.record(some_day_us + 3000, with_flags(heartbeat_bytes(), 0x02)).record(some_day_us + 3100, v1_frame());
  });
  expect_the_four_around(seen);
  EXPECT_EQ(seen.records.size(), 4U);
  EXPECT_EQ(seen.counts.unknown_flags, 1U);
  EXPECT_EQ(seen.counts.v1_frames, 1U);
  EXPECT_EQ(seen.counts.skipped_bytes, 0U);
}

TEST(mavlink_tlog_reader, the_log_of_a_computer_whose_clock_was_never_set_is_read) {
  auto bad = heartbeat_bytes();
  bad.back() ^= std::byte{1};
  log_builder log;
  log.record(1'000'000, heartbeat_bytes()).record(2'000'000, bad).record(3'000'000, heartbeat_bytes());
  const auto seen = read_bytes(log.bytes());
  EXPECT_EQ(seen.records,
            (std::vector<plain_record>{{1'000'000, hex_of_heartbeat()}, {3'000'000, hex_of_heartbeat()}}));
}

TEST(mavlink_tlog_reader, garbage_of_many_windows_is_passed_with_what_lies_after_it) {
  byte_buffer garbage(5 * read_window::window_bytes + 3);
  std::mt19937_64 random(4);
  for (auto& each : garbage)
    each = random() % 8 == 0 ? magic_v2 : static_cast<std::byte>(random());
  const auto seen = read_between([&](log_builder& log) { log.raw(garbage); });
  expect_the_four_around(seen);
  EXPECT_EQ(seen.records.size(), 4U);
  EXPECT_EQ(seen.counts.skipped_bytes, garbage.size());
}

TEST(mavlink_tlog_reader, bytes_that_are_no_log_give_nothing) {
  for (const std::size_t size : {1, 7, 8, 9, 20, 1000, 200'000}) {
    const auto seen = read_bytes(byte_buffer(size, std::byte{'x'}));
    EXPECT_TRUE(seen.records.empty());
    EXPECT_EQ(seen.counts.skipped_bytes, size);
  }
}

// Of a frame with an unknown id nobody can say whether it is one, so only the verified ones count.
std::vector<plain_record> verified(const reading& seen) {
  auto records = seen.records;
  std::erase_if(records, [](const plain_record& each) { return !each.is_verified; });
  return records;
}

std::size_t bytes_of_records(const reading& seen) {
  std::size_t bytes = 0;
  for (const auto& each : seen.records)
    bytes += tlog_time_size + each.hex.size() / 2;
  return bytes;
}

// These in their order, but for what lies within a record that is none: a beginning of a frame that the bytes after it
// make one of an unknown id, or, once in 65,536, one with a right checksum.
bool is_whole_but_for(std::size_t unknown_frames, const std::vector<plain_record>& seen,
                      const std::vector<plain_record>& expected) {
  constexpr std::size_t shortest_record = tlog_time_size + 12;
  constexpr std::size_t most_chances = 1;
  std::size_t chances = 0;
  auto next = expected.begin();
  for (const auto& each : seen) {
    const auto found = std::find(next, expected.end(), each);
    if (found == expected.end())
      ++chances;
    else
      next = found + 1;
  }
  const auto missing = expected.size() + chances - seen.size();
  return chances <= most_chances &&
         missing <= (unknown_frames + chances) * (max_tlog_record_size / shortest_record + 1);
}

// Right records with anything between them, or a file cut anywhere: what is whole comes out, in its order.
RC_GTEST_PROP(mavlink_tlog_reader_property, no_right_frame_is_lost, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto frames = some_frames(*rc::gen::inRange<std::size_t>(1, 1500), random);
  const bool may_break = *rc::gen::arbitrary<bool>();
  log_builder log;
  std::vector<plain_record> expected;
  std::uint64_t time_us = some_day_us;
  for (const auto& frame : frames) {
    if (may_break && random() % 4 == 0)
      log.time(time_us).raw(byte_view(frames[random() % frames.size()]).first(random() % 12));
    if (may_break && random() % 4 == 0)
      log.raw(byte_buffer(random() % 600, static_cast<std::byte>(random())));
    time_us += random() % 1'000'000;
    log.record(time_us, frame);
    expected.push_back({time_us, to_hex(frame)});
  }
  const auto whole = read_bytes(log.bytes());
  const auto right = verified(whole);
  RC_ASSERT(is_whole_but_for(whole.records.size() - right.size(), right, expected));
  RC_ASSERT(bytes_of_records(whole) + whole.counts.skipped_bytes == log.bytes().size());

  const auto cut = read_bytes(byte_view(log.bytes()).first(random() % log.bytes().size()));
  const auto before_cut = verified(cut);
  RC_ASSERT(is_whole_but_for(expected.size(), before_cut, expected));
  RC_ASSERT(cut.records.size() > before_cut.size() || right != expected ||
            std::equal(before_cut.begin(), before_cut.end(), expected.begin()));
  RC_ASSERT(may_break || cut.counts.skipped_bytes < max_tlog_record_size);
}

} // namespace tlog_reader_test

namespace frame_shape_test {

byte_buffer plain_heartbeat() { return from_hex("fd09000000ffbe000000000000001208000403211a"); }

TEST(mavlink_frame_shape, a_right_frame_is_v2_also_with_more_bytes_after_it) {
  auto bytes = plain_heartbeat();
  bytes.resize(bytes.size() + 5);
  const auto found = look(bytes);
  EXPECT_EQ(found.shape, frame_shape::v2);
  EXPECT_EQ(found.size, 21U);
  EXPECT_TRUE(found.is_right());
}

TEST(mavlink_frame_shape, a_part_of_a_frame_is_cut_off) {
  for (const auto& whole : {plain_heartbeat(), v1_frame()})
    for (std::size_t size = 1; size < whole.size(); ++size)
      EXPECT_EQ(look(byte_view(whole).first(size)).shape, frame_shape::cut_off) << size;
}

TEST(mavlink_frame_shape, one_other_byte_makes_the_checksum_bad) {
  for (std::size_t at = 2; at < 21; ++at) {
    auto bytes = plain_heartbeat();
    if (at >= incompat_at && at < id_at && at != 4)
      continue;
    bytes[at] ^= std::byte{0x20};
    const auto found = look(bytes);
    EXPECT_FALSE(found.is_right()) << at;
    EXPECT_NE(found.shape, frame_shape::nothing) << at;
  }
}

TEST(mavlink_frame_shape, other_right_shapes_are_told_apart) {
  EXPECT_EQ(look(with_flags(plain_heartbeat(), 0x02)).shape, frame_shape::unknown_flags);
  EXPECT_EQ(look(v1_frame()).shape, frame_shape::v1);
  EXPECT_EQ(look(unknown_frame(7)).shape, frame_shape::unknown_id);
  EXPECT_EQ(look(unknown_frame(7)).size, 19U);
}

TEST(mavlink_frame_shape, nothing_begins_where_no_magic_is) {
  EXPECT_EQ(look({}).shape, frame_shape::nothing);
  EXPECT_EQ(look(from_hex("00fd")).shape, frame_shape::nothing);
}

} // namespace frame_shape_test

namespace read_window_test {

TEST(mavlink_read_window, passes_over_a_file_of_several_windows_without_a_gap) {
  byte_buffer all(3 * read_window::window_bytes + 17);
  std::mt19937_64 random(3);
  for (auto& each : all)
    each = static_cast<std::byte>(random());
  const mcap::memory_source source(all);
  read_window window(source);
  byte_buffer seen;
  for (;;) {
    ASSERT_TRUE(window.require(1000));
    if (window.bytes().empty())
      break;
    EXPECT_EQ(window.offset(), seen.size());
    EXPECT_TRUE(window.bytes().size() >= 1000 || window.offset() + window.bytes().size() == all.size());
    EXPECT_LE(window.bytes().size(), read_window::window_bytes);
    const auto count = std::min<std::size_t>(window.bytes().size(), random() % 999 + 1);
    append(seen, window.bytes().first(count));
    window.drop(count);
  }
  EXPECT_EQ(seen, all);
}

TEST(mavlink_read_window, hands_on_an_error_of_the_source) {
  const temporary_folder folder;
  std::filesystem::create_directory(folder / "sub");
  mcap::file_source source;
  ASSERT_TRUE(source.open(folder / "sub"));
  read_window window(source);
  const auto outcome = window.require(1);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, mcap::errc::io);
}

} // namespace read_window_test

} // namespace godwit::io::mavlink::test
