#include "io/sqlite/bus_guard.hpp"

#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

namespace godwit::io::sqlite {
namespace bus_guard_test {

TEST(bus_guard, a_page_that_was_cut_from_its_file_becomes_an_empty_one_and_is_counted) {
  guard_against_bus_errors();
  char name[] = "/tmp/bus_guard_XXXXXX";
  const int file = ::mkstemp(name);
  ASSERT_GE(file, 0);
  ::unlink(name);
  ASSERT_EQ(::ftruncate(file, 8192), 0);
  auto* const bytes = static_cast<volatile char*>(::mmap(nullptr, 8192, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
  bytes[0] = 7;
  bytes[4096] = 8;
  ASSERT_EQ(::ftruncate(file, 0), 0);
  const auto before = bus_errors();
  EXPECT_EQ(bytes[4097], 0);
  EXPECT_EQ(bytes[4096], 0) << "of the page nothing is left";
  EXPECT_EQ(bus_errors(), before + 1);
  bytes[0] = 1;
  EXPECT_EQ(bytes[0], 1) << "it can be written";
  EXPECT_EQ(bus_errors(), before + 2);
  ::close(file);
}

TEST(bus_guard_death, another_cause_ends_the_process_as_ever) {
  guard_against_bus_errors();
  EXPECT_EXIT(std::raise(SIGBUS), testing::KilledBySignal(SIGBUS), "");
}

} // namespace bus_guard_test
} // namespace godwit::io::sqlite
