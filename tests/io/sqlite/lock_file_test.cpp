#include "io/sqlite/lock_file.hpp"

#include "tests/io/sqlite/store_fixture.hpp"

namespace godwit::tests {
namespace lock_file_test {

using namespace io::sqlite;

using lock_file_test = store_test;

TEST_F(lock_file_test, one_holds_it_and_the_other_hears_who) {
  const auto first = open();
  const auto second = lock_file::acquire(note_format().kind, path());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, store_errc::locked);
  EXPECT_NE(second.error().what.find(std::to_string(::getpid())), std::string::npos) << second.error().what;
}

TEST_F(lock_file_test, it_is_given_back_at_the_end_and_the_file_stays) {
  { const auto first = open(); }
  EXPECT_TRUE(std::filesystem::exists(path() + ".lock"));
  EXPECT_TRUE(lock_file::acquire(note_format().kind, path()));
}

TEST_F(lock_file_test, a_symbolic_link_and_a_removed_lock_file_let_nobody_else_in) {
  const auto first = open();
  const auto link = path() + ".link";
  std::filesystem::create_symlink(path(), link);
  auto wanted = options();
  wanted.path = link;
  const auto second = open_for_writing(note_format(), wanted);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, store_errc::locked);
  std::filesystem::remove(path() + ".lock");
  const auto third = open_for_writing(note_format(), options());
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().code, store_errc::locked);
}

TEST_F(lock_file_test, a_file_with_two_names_is_refused_under_both) {
  { const auto first = open(); }
  const auto link = path() + ".link";
  std::filesystem::create_hard_link(path(), link);
  for (const auto& each : {path(), link}) {
    auto wanted = options();
    wanted.path = each;
    const auto refused = open_for_writing(note_format(), wanted);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("2 names"), std::string::npos) << refused.error().what;
  }
}

TEST_F(lock_file_test, a_folder_that_is_not_there_is_an_error) {
  const auto refused = lock_file::acquire(note_format().kind, path());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find(path() + ".lock"), std::string::npos) << refused.error().what;
}

} // namespace lock_file_test
} // namespace godwit::tests
