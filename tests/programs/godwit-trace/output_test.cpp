#include "programs/godwit-trace/output.hpp"

#include <array>
#include <csignal>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace output_test {

TEST(output, text_waits_until_there_is_much_of_it) {
  const memory_file file;
  output out(file.descriptor());
  out.text() += "a line\n";
  EXPECT_TRUE(out.flush_if_full());
  EXPECT_EQ(file.text(), "");
  out.text().append(output::buffer_bytes, 'x');
  EXPECT_TRUE(out.flush_if_full());
  EXPECT_EQ(file.text().size(), output::buffer_bytes + 7);
}

TEST(output, what_is_left_is_written_at_the_end) {
  const memory_file file;
  {
    output out(file.descriptor());
    out.text() += "last";
  }
  EXPECT_EQ(file.text(), "last");
}

TEST(output, a_reader_that_has_gone_away_is_no_failure) {
  std::signal(SIGPIPE, SIG_IGN);
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  ::close(ends[0]);
  output out(ends[1]);
  out.text() += "nobody reads this";
  EXPECT_FALSE(out.flush());
  EXPECT_FALSE(out.is_taken());
  EXPECT_FALSE(out.flush_if_full());
  EXPECT_EQ(out.failure(), "");
  ::close(ends[1]);
}

TEST(output, a_full_disk_is_a_failure_in_words) {
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC); // NOLINT(cppcoreguidelines-pro-type-vararg)
  ASSERT_GE(full, 0);
  output out(full);
  out.text() += "x";
  EXPECT_FALSE(out.flush());
  EXPECT_EQ(out.failure(), "No space left on device");
  ::close(full);
}

TEST(console, a_sentence_is_said_at_once_behind_the_name_of_the_program) {
  kept_console console;
  console.to.say("all is well");
  EXPECT_EQ(console.words(), "godwit-trace: all is well\n");
}

} // namespace output_test
} // namespace godwit::trace_tool::test
