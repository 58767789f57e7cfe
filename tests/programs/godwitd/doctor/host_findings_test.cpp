#include "programs/godwitd/doctor/host_findings.hpp"

#include <gtest/gtest.h>

namespace godwit::daemon::doctor {
namespace host_findings_test {

constexpr device_state usable{true, true, true};
const std::vector<std::string> ports{"/dev/ttyACM0", "/dev/ttyUSB0"};
const auto line = io::link::parse_uri("serial:///dev/ttyACM1:115200").value();

TEST(doctor_host, a_serial_port_that_is_not_there_names_those_that_are) {
  const auto found = judge_serial(line, {}, ports);
  EXPECT_EQ(found.how, grade::problem);
  EXPECT_EQ(found.sentence, "There is no /dev/ttyACM1.");
  EXPECT_NE(found.remedy.find("/dev/ttyACM0, /dev/ttyUSB0"), std::string::npos);
  EXPECT_NE(judge_serial(line, {}, {}).remedy.find("plug the autopilot in"), std::string::npos);
}

TEST(doctor_host, a_serial_port_of_another_group_names_the_command_that_helps) {
  const auto found = judge_serial(line, {true, true, false}, ports);
  EXPECT_EQ(found.how, grade::problem);
  EXPECT_NE(found.remedy.find("usermod -aG dialout"), std::string::npos);
}

TEST(doctor_host, a_file_is_no_serial_port) {
  EXPECT_EQ(judge_serial(line, {true, false, true}, ports).how, grade::problem);
  EXPECT_TRUE(state_of("/dev/null").is_character_device);
  EXPECT_FALSE(state_of("/etc/passwd").is_character_device);
  EXPECT_FALSE(state_of("/dev/there/is/none").exists);
}

TEST(doctor_host, an_unusual_baud_rate_is_a_warning) {
  EXPECT_EQ(judge_serial(line, usable, ports).how, grade::good);
  auto odd = line;
  odd.baud = 12'345;
  EXPECT_EQ(judge_serial(odd, usable, ports).how, grade::warning);
}

TEST(doctor_host, without_a_line_the_options_and_ports_are_named) {
  const auto found = judge_missing_line(ports);
  EXPECT_EQ(found.how, grade::problem);
  EXPECT_NE(found.remedy.find("--vehicle"), std::string::npos);
  EXPECT_NE(found.remedy.find("/dev/ttyUSB0"), std::string::npos);
}

TEST(doctor_host, a_camera_has_to_be_there_and_of_the_users_group) {
  EXPECT_EQ(judge_camera("v4l2:///dev/video0", usable).how, grade::good);
  EXPECT_EQ(judge_camera("v4l2:///dev/video0", {}).sentence, "There is no /dev/video0.");
  EXPECT_NE(judge_camera("v4l2:///dev/video0", {true, true, false}).remedy.find("usermod -aG video"),
            std::string::npos);
}

TEST(doctor_host, a_clock_that_nobody_synchronises_is_a_warning) {
  EXPECT_EQ(judge_clock(true).how, grade::good);
  EXPECT_EQ(judge_clock(false).how, grade::warning);
  EXPECT_EQ(judge_clock(std::nullopt).how, grade::warning);
}

TEST(doctor_host, a_full_disk_is_a_problem_and_a_filling_one_a_warning) {
  constexpr std::uint64_t mib = 1024 * 1024;
  EXPECT_EQ(judge_disk("/var/lib/godwit", 63 * mib).how, grade::problem);
  EXPECT_EQ(judge_disk("/var/lib/godwit", 511 * mib).how, grade::warning);
  EXPECT_EQ(judge_disk("/var/lib/godwit", 512 * mib).how, grade::good);
  EXPECT_EQ(judge_disk("/var/lib/godwit", std::nullopt).how, grade::warning);
}

} // namespace host_findings_test
} // namespace godwit::daemon::doctor
