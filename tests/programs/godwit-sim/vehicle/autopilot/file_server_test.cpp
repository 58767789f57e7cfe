#include "programs/godwit-sim/vehicle/autopilot/file_server.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/autopilot/param_list.hpp"

namespace godwit::sim {
namespace file_server_test {

constexpr mavlink::sender station{255, 190};
constexpr std::uint8_t open_file_ro = 4;
constexpr std::uint8_t read_file = 5;
constexpr std::uint8_t write_file = 7;
constexpr std::uint8_t burst_read_file = 15;
constexpr std::uint8_t ack = 128;
constexpr std::uint8_t nak = 129;
constexpr std::size_t data_at = 15;

// As QGroundControl sends it: zeros at the end are cut off.
std::vector<std::byte> request(std::uint8_t opcode, const std::string& path = {}, std::uint32_t offset = 0,
                               std::uint8_t size = 239) {
  std::vector<std::byte> result(data_at + path.size());
  result[1] = result[2] = std::byte{1};
  result[3] = std::byte{7}; // sequence
  result[6] = std::byte{opcode};
  result[7] = path.empty() ? std::byte{size} : static_cast<std::byte>(path.size());
  std::memcpy(&result[11], &offset, sizeof offset);
  std::memcpy(result.data() + data_at, path.data(), path.size());
  return result;
}

int byte_at(const file_server::payload& each, std::size_t at) { return std::to_integer<int>(each.at(at)); }

struct param_reader {
  std::vector<std::byte> bytes;
  std::size_t at = 6;
  std::string name;
  float value = 0;

  template <class V>
  V take() {
    V result;
    std::memcpy(&result, bytes.data() + at, sizeof result);
    at += sizeof result;
    return result;
  }
  // As the readers of ArduPilot's file do it. False: that was the last one.
  bool next() {
    if (at >= bytes.size())
      return false;
    const int kind = std::to_integer<int>(bytes[at]) & 0xF;
    const auto lengths = std::to_integer<std::size_t>(bytes[at + 1]);
    at += 2;
    name.resize(lengths & 0xFU);
    for (std::size_t i = 0; i <= lengths >> 4U; ++i)
      name += static_cast<char>(bytes.at(at++));
    value = kind == 1   ? static_cast<float>(take<std::int8_t>())
            : kind == 2 ? static_cast<float>(take<std::int16_t>())
            : kind == 3 ? static_cast<float>(take<std::int32_t>())
                        : take<float>();
    return true;
  }
};

TEST(file_server, the_parameter_file_is_read_in_a_burst_and_holds_all_parameters) {
  const auto params = copter_params();
  const std::vector files{param_file(params)};
  file_server server;
  const auto opened = server.on(station, request(open_file_ro, "@PARAM/param.pck"), files);
  ASSERT_EQ(opened.size(), 1U);
  EXPECT_EQ(byte_at(opened[0], 6), ack);
  EXPECT_EQ(byte_at(opened[0], 8), open_file_ro);
  EXPECT_EQ(byte_at(opened[0], 3), 8) << "the next sequence";
  EXPECT_EQ(byte_at(opened[0], 1), 255);
  param_reader reader;
  const auto burst = server.on(station, request(burst_read_file), files);
  for (const auto& each : burst)
    if (byte_at(each, 6) == ack)
      reader.bytes.insert(reader.bytes.end(), each.begin() + data_at, each.begin() + data_at + byte_at(each, 7));
  EXPECT_EQ(byte_at(burst.back(), 6), nak);
  EXPECT_EQ(byte_at(burst.back(), data_at), 6) << "end of file";
  std::size_t read = 0;
  for (; reader.next(); ++read) {
    ASSERT_EQ(reader.name, params.at(read).name);
    EXPECT_EQ(reader.value, params[read].value) << reader.name;
  }
  EXPECT_EQ(read, params.size());
}

// As with the 1,400 of a real ArduCopter; with less QGroundControl reports that the vehicle does not respond.
TEST(file_server, the_parameter_file_is_above_a_thousandth_of_the_size_that_is_told_of_it) {
  for (const auto& params : {copter_params(), plane_params()}) {
    const auto file = param_file(params);
    EXPECT_GT(file.content.size(), file.size_told / 1000);
  }
}

TEST(param_list, an_ArduPilot_has_the_limits_of_all_16_channels_of_its_remote_control) {
  const auto all = copter_params();
  for (int channel = 1; channel <= 16; ++channel)
    for (const std::string end : {"_MIN", "_MAX", "_TRIM"}) {
      const auto name = "RC" + std::to_string(channel) + end;
      EXPECT_EQ(std::ranges::count(all, name, &role::param::name), 1) << name;
    }
}

TEST(file_server, a_file_that_is_not_there_is_not_found_and_nothing_is_written) {
  file_server server;
  const auto absent = server.on(station, request(open_file_ro, "/etc/extras/component_general.json"), {});
  EXPECT_EQ(byte_at(absent.at(0), 6), nak);
  EXPECT_EQ(byte_at(absent[0], data_at), 10);
  EXPECT_EQ(byte_at(server.on(station, request(write_file), {}).at(0), 6), nak);
  EXPECT_EQ(byte_at(server.on(station, request(read_file), {}).at(0), data_at), 4) << "no session";
}

// Bytes that were cut off are 0, whatever is asked.
TEST(file_server, a_request_of_any_length_is_answered) {
  file_server server;
  for (std::size_t length = 0; length <= 20; ++length)
    EXPECT_EQ(server.on(station, std::vector<std::byte>(length), {}).size(), 1U) << length;
}

} // namespace file_server_test
} // namespace godwit::sim
