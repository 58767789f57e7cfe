// Recordings of real autopilots and ground stations. The totals were counted by another program when they were made.
#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "io/mavlink/crc.hpp"
#include "io/mavlink/ids.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/tlog/tlog_reader.hpp"
#include "io/mavlink/tlog/tlog_writer.hpp"
#include "tests/io/mavlink/tlog/tlog_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace tlog_recordings_test {

using senders = std::map<std::string, std::uint64_t>;

struct totals {
  std::uint64_t frames = 0;
  std::uint64_t known = 0; // of a message that godwit decodes
  std::uint64_t other = 0;
  std::uint64_t with_signature = 0;
  senders by_sender;
  bool operator==(const totals&) const = default;
};

struct counted {
  totals all;
  tlog_counts counts;
};

std::filesystem::path recording(const std::string& name) {
  return std::filesystem::path(GODWIT_TEST_DATA) / "captures" / name;
}

counted count(const std::string& name) {
  counted seen;
  mcap::file_source file;
  EXPECT_TRUE(file.open(recording(name)));
  tlog_reader reader(file);
  for (auto record = reader.next(); record && *record; record = reader.next()) {
    const frame_view& frame = (*record)->frame;
    ++seen.all.frames;
    ++(known_messages::contains(frame.id()) ? seen.all.known : seen.all.other);
    seen.all.with_signature += frame.is_signed() ? 1 : 0;
    ++seen.all.by_sender[std::to_string(frame.system()) + "/" + std::to_string(frame.component())];
  }
  seen.counts = reader.counts();
  return seen;
}

void expect_whole(const std::string& name, const totals& expected) {
  const counted seen = count(name);
  EXPECT_EQ(seen.all.frames, expected.frames) << name;
  EXPECT_EQ(seen.all.known, expected.known) << name;
  EXPECT_EQ(seen.all.other, expected.other) << name;
  EXPECT_EQ(seen.all.with_signature, expected.with_signature) << name;
  EXPECT_EQ(seen.all.by_sender, expected.by_sender) << name;
  EXPECT_EQ(seen.counts.bad_checksums + seen.counts.cut_off + seen.counts.not_frames, 0U) << name;
  EXPECT_EQ(seen.counts.skipped_bytes, 0U) << name;
}

TEST(mavlink_tlog_recordings, whole_recordings_give_the_totals_that_they_were_made_with) {
  expect_whole("ardurover_mission.tlog", {7219, 2846, 4373, 0, {{"1/1", 7110}, {"255/190", 109}}});
  expect_whole("ardurover_signing_serial1.tlog", {557, 277, 280, 387, {{"1/1", 515}, {"255/190", 42}}});
  expect_whole("px4_quad_mission.tlog", {28799, 8986, 19813, 0, {{"1/1", 28684}, {"255/190", 115}}});
  expect_whole("mavsdk_client_vs_passive.tlog", {52, 52, 0, 0, {{"1/1", 14}, {"245/190", 38}}});
}

// Tries every byte of the file, with the definition of the checksum a bit at a time, and skips nothing.
std::uint64_t right_frames_at_any_offset(byte_view bytes) {
  std::uint64_t right = 0;
  for (std::size_t at = 0; at + min_frame_size <= bytes.size(); ++at) {
    const auto byte = [&](std::size_t i) { return std::to_integer<std::uint8_t>(bytes[at + i]); };
    const std::size_t crc_at = header_size + byte(length_at);
    const auto* const info =
        find_message(byte(id_at) | unsigned{byte(id_at + 1)} << 8U | unsigned{byte(id_at + 2)} << 16U);
    if (bytes[at] != magic_v2 || byte(incompat_at) > incompat_signed || info == nullptr ||
        at + crc_at + crc_size > bytes.size())
      continue;
    std::uint16_t crc = crc_init;
    for (std::size_t i = 1; i < crc_at; ++i)
      crc = crc_of_byte(crc, byte(i));
    crc = crc_of_byte(crc, info->crc_extra);
    right += crc == (byte(crc_at) | unsigned{byte(crc_at + 1)} << 8U) ? 1 : 0;
  }
  return right;
}

// In these, frames were sent on purpose that are cut off, have a bad checksum, an unknown flag, or garbage before them.
TEST(mavlink_tlog_recordings, no_right_frame_is_lost_between_deliberately_broken_ones) {
  const std::map<std::string, std::uint64_t> right{{"ardurover_probes.tlog", 7155}, {"px4_quad_probes.tlog", 33173}};
  for (const auto& [name, frames] : right) {
    const counted seen = count(name);
    EXPECT_EQ(right_frames_at_any_offset(test_data("captures/" + name)), frames) << name;
    EXPECT_EQ(seen.counts.frames, frames) << name;
    EXPECT_EQ(seen.counts.unknown_flags, 1U) << name;
    EXPECT_EQ(seen.counts.v1_frames, 1U) << name;
    EXPECT_EQ(seen.counts.without_time, 2U) << name;
    EXPECT_EQ(seen.counts.bad_checksums, 2U) << name; // one of them is a frame that was sent in two parts
    EXPECT_EQ(seen.counts.cut_off, 0U) << name;
    EXPECT_EQ(seen.counts.not_frames, 2U) << name;
  }
  EXPECT_EQ(count("px4_quad_probes.tlog").counts.unknown_ids, 88U);
}

TEST(mavlink_tlog_recordings, a_signed_recording_written_again_has_neither_signatures_nor_the_key) {
  const temporary_folder folder;
  mcap::file_source file;
  ASSERT_TRUE(file.open(recording("ardurover_signing_serial1.tlog")));
  tlog_reader reader(file);
  tlog_writer writer;
  ASSERT_TRUE(writer.open({folder / "copy.tlog"}));
  std::string key;
  for (auto record = reader.next(); record && *record; record = reader.next()) {
    ASSERT_TRUE(writer.write((*record)->timestamp_us, (*record)->frame));
    if (key.empty() && (*record)->frame.id() == setup_signing::message_id) {
      const auto message = decode<setup_signing>((*record)->frame);
      key = to_hex(std::as_bytes(std::span(message.secret_key)));
    }
  }
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(writer.counts().keys_withheld, 2U);      // signing was switched on and off
  const auto copy = read_file(folder / "copy.tlog"); // and every checksum is right
  EXPECT_EQ(copy.counts.frames, 555U);
  EXPECT_EQ(copy.counts.skipped_bytes, 0U);
  std::string content;
  for (const auto& each : copy.records) {
    EXPECT_EQ(each.hex.substr(2 * incompat_at, 2), "00");
    content += each.hex;
  }
  ASSERT_EQ(key.size(), 64U);
  EXPECT_EQ(content.find(key.substr(0, 16)), std::string::npos);
}

TEST(mavlink_tlog_recordings, every_offset_of_the_whole_recordings_agrees_too) {
  for (const std::string name : {"ardurover_mission.tlog", "ardurover_signing_serial1.tlog"})
    EXPECT_EQ(right_frames_at_any_offset(test_data("captures/" + name)), count(name).counts.frames) << name;
}

} // namespace tlog_recordings_test
} // namespace godwit::io::mavlink::test
