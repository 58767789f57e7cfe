#include "io/sqlite/lock_file.hpp"

#include "tests/io/sqlite/store_fixture.hpp"

namespace godwit::tests {
namespace {

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

TEST_F(lock_file_test, a_folder_that_is_not_there_is_an_error) {
  const auto refused = lock_file::acquire(note_format().kind, path());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find(path() + ".lock"), std::string::npos) << refused.error().what;
}

} // namespace
} // namespace godwit::tests
