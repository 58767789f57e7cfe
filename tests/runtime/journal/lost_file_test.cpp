// The file of a journal is deleted, replaced or cut while it is written: it is noticed, nothing that was acknowledged
// is lost, and a person has it written to a new file.
#include <filesystem>

#include "runtime/journal/journal_file.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"

namespace godwit::tests {
namespace lost_file_test {

namespace fs = std::filesystem;
using namespace runtime;

// What somebody does to the files of a journal at PATH.
struct harm {
  const char* name;
  void (*act)(const std::string& path);
};

const harm harms[] = {
    {"deleted", [](const std::string& path) { fs::remove(path); }},
    {"replaced",
     [](const std::string& path) {
       fs::copy_file(path, path + ".copy");
       fs::rename(path + ".copy", path);
     }},
    {"cut", [](const std::string& path) { fs::resize_file(path, 4096); }},
    {"emptied", [](const std::string& path) { fs::resize_file(path, 0); }},
    {"log_deleted", [](const std::string& path) { fs::remove(path + "-wal"); }},
    {"log_emptied", [](const std::string& path) { fs::resize_file(path + "-wal", 0); }},
    {"index_deleted", [](const std::string& path) { fs::remove(path + "-shm"); }},
    {"index_emptied", [](const std::string& path) { fs::resize_file(path + "-shm", 0); }},
    {"index_cut", [](const std::string& path) { fs::resize_file(path + "-shm", 4096); }},
};

class lost_journal : public testing::TestWithParam<harm> {
protected:
  scratch_folder folder;
  std::string path = folder.path("g.db");
  std::unique_ptr<sqlite_journal> journal = open_journal({.path = path});

  void SetUp() override {
    for (int i = 1; i <= 20; ++i)
      ASSERT_TRUE(commit(*journal, event_write("anna", i)));
    ASSERT_FALSE(journal->status().failing);
    ::usleep(1'200'000); // the file has been looked at as it is now
    GetParam().act(path);
  }
  tl::expected<std::string, journal_error> rescue() {
    std::promise<tl::expected<std::string, journal_error>> answer;
    journal->rescue([&](auto done) { answer.set_value(std::move(done)); });
    return answer.get_future().get();
  }
};

TEST_P(lost_journal, it_is_noticed_within_five_seconds_and_goes_on_in_a_new_file_when_somebody_says_so) {
  EXPECT_TRUE(wait_for([&] { return journal->status().failing; })) << "5 s";
  EXPECT_NE(journal->status().reason.find("rescue-journal"), std::string::npos) << journal->status().reason;
  auto waiting = submit(*journal, event_write("anna", 21));
  const auto meanwhile = recover(*journal, "anna", 2);
  ASSERT_TRUE(meanwhile);
  EXPECT_EQ(meanwhile->last_event, 21) << "from memory, with what waits";
  const auto done = rescue();
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_EQ(*done, path + rescued_suffix);
  EXPECT_TRUE(waiting.get());
  EXPECT_TRUE(commit(*journal, event_write("anna", 22, 2)));
  EXPECT_FALSE(journal->status().failing);
  EXPECT_NE(journal->status().reason.find(*done), std::string::npos);
  journal.reset();
  EXPECT_EQ(journal_in_use(path), *done);
  const auto again = open_journal({.path = *done, .check = integrity_check::full});
  const auto state = recover(*again, "anna", 3);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->last_event, 22);
  EXPECT_EQ(state->events.size(), 22U);
}

// What waits for the file of then must not come into it unseen.
TEST_P(lost_journal, without_a_word_it_ends_and_leaves_the_files_alone) {
  ASSERT_TRUE(wait_for([&] { return journal->status().failing; }));
  const auto size_of = [](const std::string& file) {
    std::error_code none;
    const auto bytes = fs::file_size(file, none);
    return none ? std::uintmax_t{0} : bytes;
  };
  const auto before = size_of(path);
  journal.reset();
  EXPECT_EQ(size_of(path), before);
}

INSTANTIATE_TEST_SUITE_P(every_harm, lost_journal, testing::ValuesIn(harms),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(journal, one_that_is_as_it_should_be_is_not_rescued) {
  const scratch_folder folder;
  const auto journal = open_journal({.path = folder.path("g.db")});
  std::promise<bool> was_done;
  journal->rescue([&](const auto& done) { was_done.set_value(done.has_value()); });
  EXPECT_FALSE(was_done.get_future().get());
  EXPECT_TRUE(commit(*journal, event_write("anna", 1)));
}

} // namespace lost_file_test
} // namespace godwit::tests
