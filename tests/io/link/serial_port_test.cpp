#include "io/link/serial_port.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>

#include "tests/io/link/far_ends.hpp"

namespace godwit::io::link {
namespace serial_port_test {

using testing::serial_line;

termios2 settings_of(const descriptor& port) {
  termios2 settings{};
  EXPECT_EQ(::ioctl(port.number(), TCGETS2, &settings), 0);
  return settings;
}

TEST(serial_port, the_line_is_raw_8n1_without_flow_control_at_the_rate_asked_for) {
  const serial_line line;
  for (const std::uint32_t baud : {57'600U, 921'600U, 123'456U}) {
    const auto port = open_serial_port(line.path(), baud);
    ASSERT_TRUE(port) << port.error();
    const auto settings = settings_of(*port);
    EXPECT_EQ(settings.c_ospeed, baud);
    EXPECT_EQ(settings.c_ispeed, baud);
    EXPECT_EQ(settings.c_cflag & (CSIZE | PARENB | CSTOPB | CRTSCTS | HUPCL), static_cast<unsigned>(CS8));
    EXPECT_EQ(settings.c_lflag | settings.c_iflag | settings.c_oflag, 0U);
  }
}

TEST(serial_port, a_line_has_one_user_at_a_time) {
  const serial_line line;
  auto first = open_serial_port(line.path(), 57'600);
  ASSERT_TRUE(first) << first.error();
  const auto second = open_serial_port(line.path(), 57'600);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().find("another program holds the device"), std::string::npos) << second.error();
  first->reset();
  EXPECT_TRUE(open_serial_port(line.path(), 57'600));
}

TEST(serial_port, what_is_not_a_serial_line_is_told_in_words) {
  const std::pair<const char*, const char*> cases[] = {
      {"/dev/ttyNoSuchDevice", "/dev/ttyNoSuchDevice: no such device; is the autopilot plugged in?"},
      {"/dev/null", "/dev/null: not a serial line"},
      {"/dev", "/dev: not a serial line but a folder"},
  };
  for (const auto& [device, sentence] : cases) {
    const auto port = open_serial_port(device, 57'600);
    ASSERT_FALSE(port);
    EXPECT_EQ(port.error(), sentence);
  }
}

} // namespace serial_port_test
} // namespace godwit::io::link
