#include "io/mcap/segment_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace segment_folder_test {

constexpr std::uint64_t small_segment_bytes = segment_folder::min_segment_bytes;

segment_folder_options options_for(const temporary_folder& folder) {
  return {folder.path(), "godwit", small_segment_bytes, 3 * small_segment_bytes};
}

TEST(mcap_segment_folder, names_sort_as_the_segments_were_made) {
  const temporary_folder folder;
  segment_folder segments;
  ASSERT_TRUE(segments.open(options_for(folder)));
  EXPECT_EQ(segments.add(7)->filename(), "godwit-0000000007-000001.mcap");
  EXPECT_EQ(segments.add(7)->filename(), "godwit-0000000007-000002.mcap");
  EXPECT_EQ(segments.add(12)->filename(), "godwit-0000000012-000001.mcap");
  EXPECT_EQ(segments.add(segment_folder::max_run + 1).error().code, errc::too_many);
}

TEST(mcap_segment_folder, a_folder_of_another_user_is_refused) {
  const temporary_folder folder;
  auto options = options_for(folder);
  options.folder = "/";
  if (::geteuid() == 0) {
    options.folder = folder / "theirs";
    std::filesystem::create_directory(options.folder);
    ASSERT_EQ(::chown(options.folder.c_str(), 1, 1), 0);
  }
  segment_folder segments;
  const auto refused = segments.open(options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("belongs to user"), std::string::npos) << refused.error().message();
}

TEST(mcap_segment_folder, recordings_of_other_endings_and_names_in_the_folder_are_left_alone) {
  const temporary_folder folder;
  store_bytes(folder / "godwit-0000000007-000001.mcap", {});
  store_bytes(folder / "ground-0000000007-000001.tlog", {});
  segment_folder segments;
  auto options = options_for(folder);
  options.prefix = "vehicle";
  options.extension = ".tlog";
  ASSERT_TRUE(segments.open(options));
  for (int n = 0; n < 9; ++n)
    ASSERT_TRUE(segments.add(7));
  EXPECT_EQ(segments.segments().back().path.filename(), "vehicle-0000000007-000009.tlog");
  EXPECT_TRUE(std::filesystem::exists(folder / "godwit-0000000007-000001.mcap"));
  EXPECT_TRUE(std::filesystem::exists(folder / "ground-0000000007-000001.tlog"));
}

TEST(mcap_segment_folder, a_run_that_comes_again_does_not_meet_its_old_names) {
  const temporary_folder folder;
  store_bytes(folder / "godwit-0000000007-000004.mcap", {});
  segment_folder segments;
  ASSERT_TRUE(segments.open(options_for(folder)));
  EXPECT_EQ(segments.add(7)->filename(), "godwit-0000000007-000005.mcap");
}

TEST(mcap_segment_folder, the_oldest_are_deleted_before_the_bound_is_passed) {
  const temporary_folder folder;
  const byte_buffer content(small_segment_bytes, std::byte{1});
  segment_folder segments;
  ASSERT_TRUE(segments.open(options_for(folder)));
  for (int i = 0; i < 10; ++i) {
    const auto path = segments.add(1);
    ASSERT_TRUE(path);
    store_bytes(*path, content);
    segments.note_size(content.size());
    EXPECT_LE(segments.total_bytes(), segments.options().total_bytes);
  }
  EXPECT_EQ(segments.segments().size(), 3U);
  EXPECT_EQ(segments.segments_deleted(), 7U);
  EXPECT_FALSE(std::filesystem::exists(folder / "godwit-0000000001-000007.mcap"));
  EXPECT_TRUE(std::filesystem::exists(folder / "godwit-0000000001-000008.mcap"));
}

TEST(mcap_segment_folder, files_of_others_are_neither_counted_nor_deleted) {
  const temporary_folder folder;
  const std::vector<std::string> others{"other-0000000001-000001.mcap", "godwit-0000000001-000001.mcap.bak",
                                        "godwit-1-1.mcap", "godwit-000000000x-000001.mcap"};
  for (const std::string& name : others) {
    store_bytes(folder / name, byte_buffer(100'000));
  }
  segment_folder segments;
  ASSERT_TRUE(segments.open(options_for(folder)));
  EXPECT_TRUE(segments.segments().empty());
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(segments.add(1));
  }
  for (const std::string& name : others) {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
}

TEST(mcap_segment_folder, all_segments_without_their_end_are_completed_at_the_start) {
  const temporary_folder folder;
  write_small_recording(folder / "godwit-0000000001-000001.mcap", true);
  write_small_recording(folder / "godwit-0000000001-000002.mcap", false);
  store_bytes(folder / "godwit-0000000002-000001.mcap", bytes_of("no MCAP at all"));
  write_small_recording(folder / "godwit-0000000003-000001.mcap", false);
  segment_folder segments;
  ASSERT_TRUE(segments.open(options_for(folder)));
  const std::vector<segment_completion> report = segments.complete_all();
  ASSERT_EQ(report.size(), 4U);
  EXPECT_TRUE(report[0].outcome->was_complete);
  EXPECT_EQ(report[1].outcome->messages, small_recording_messages);
  EXPECT_EQ(report[2].outcome.error().code, errc::malformed);
  EXPECT_EQ(report[3].outcome->messages, small_recording_messages);
  EXPECT_EQ(read_file(report[3].path).end, ending::complete);
  EXPECT_EQ(segments.segments()[3].size_bytes, std::filesystem::file_size(report[3].path));
}

TEST(mcap_segment_folder, impossible_options_are_refused) {
  const temporary_folder folder;
  segment_folder segments;
  auto options = options_for(folder);
  options.prefix = "../x";
  EXPECT_EQ(segments.open(options).error().code, errc::invalid_argument);
  options = options_for(folder);
  options.segment_bytes = max_segment_bytes + 1;
  EXPECT_EQ(segments.open(options).error().code, errc::invalid_argument);
  options = options_for(folder);
  options.total_bytes = options.segment_bytes;
  EXPECT_EQ(segments.open(options).error().code, errc::invalid_argument);
  options = options_for(folder);
  options.folder = "/dev/null/x";
  EXPECT_EQ(segments.open(options).error().code, errc::io);
}

} // namespace segment_folder_test
} // namespace godwit::io::mcap::test
