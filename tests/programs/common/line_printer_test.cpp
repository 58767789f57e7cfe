#include "programs/common/line_printer.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "io/link/descriptor.hpp"

namespace godwit::programs {
namespace line_printer_test {

struct line_printer_test : ::testing::Test {
  line_printer_test() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    reader = io::link::descriptor(ends[0]);
    writer = io::link::descriptor(ends[1]);
    printer.emplace(writer.number());
  }
  // What was printed, when the printer is over.
  [[nodiscard]] std::string all() {
    printer.reset();
    writer.reset();
    std::string text;
    std::array<char, 4'096> buffer{};
    for (ssize_t size = 0; (size = ::read(reader.number(), buffer.data(), buffer.size())) > 0;)
      text.append(buffer.data(), static_cast<std::size_t>(size));
    return text;
  }

  io::link::descriptor reader;
  io::link::descriptor writer;
  std::optional<line_printer> printer;
};

TEST_F(line_printer_test, lines_come_in_order_and_none_is_left_at_the_end) {
  printer->push("one");
  printer->push("two");
  EXPECT_EQ(all(), "one\ntwo\n");
}

TEST_F(line_printer_test, nobody_waits_for_a_reader_that_does_not_read) {
  for (std::size_t n = 0; n < 3 * line_printer::max_waiting; ++n)
    printer->push("a line of some length, so that the pipe is full soon");
  EXPECT_GE(printer->dropped(), line_printer::max_waiting);
  printer.reset();
}

// The sum of all "(12 lines are missing here: ...".
std::uint64_t told_in(const std::string& text) {
  std::uint64_t result = 0;
  for (auto end = text.find(" lines are missing here"); end != std::string::npos;
       end = text.find(" lines are missing here", end + 1))
    result += std::stoull(text.substr(text.rfind('(', end) + 1));
  return result;
}

TEST_F(line_printer_test, what_is_missing_is_said_in_its_place) {
  for (std::size_t n = 0; n < 3 * line_printer::max_waiting; ++n)
    printer->push("a line of some length, so that the pipe is full soon");
  const auto dropped = printer->dropped();
  std::string text;
  std::array<char, 4'096> buffer{};
  // There is room again when enough has been read; the next line then brings the news along. It may have come in parts.
  while (told_in(text) < dropped) {
    const auto size = ::read(reader.number(), buffer.data(), buffer.size());
    ASSERT_GT(size, 0);
    text.append(buffer.data(), static_cast<std::size_t>(size));
    printer->push("more");
  }
  EXPECT_LE(told_in(text), printer->dropped());
}

TEST_F(line_printer_test, a_reader_that_has_gone_away_is_no_error) {
  std::signal(SIGPIPE, SIG_IGN);
  reader.reset();
  printer->push("is anybody there?");
  printer.reset();
}

TEST(line_printer, what_the_disk_refuses_is_counted_and_told_when_it_takes_lines_again) {
  io::link::descriptor full(::open("/dev/full", O_WRONLY | O_CLOEXEC));
  ASSERT_TRUE(full.is_open());
  std::string pattern = (std::filesystem::temp_directory_path() / "line-printer-XXXXXX").string();
  io::link::descriptor file(::mkostemp(pattern.data(), O_CLOEXEC));
  ASSERT_TRUE(file.is_open());
  {
    line_printer printer(full.number());
    printer.push("lost");
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (printer.dropped() == 0 && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_EQ(printer.dropped(), 1U);
    ASSERT_TRUE(printer.put_file(file.number()));
    printer.push("kept");
  }
  std::ostringstream text;
  text << std::ifstream(pattern).rdbuf();
  EXPECT_EQ(text.str(), line_printer::plain_loss(1) + "\nkept\n");
  std::filesystem::remove(pattern);
}

} // namespace line_printer_test
} // namespace godwit::programs
