// ground_port on a real UDP socket: threads, sockets and a journal in a file.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "actors/ground_port/actor.hpp"
#include "actors/ground_port/link_port.hpp"
#include "runtime/process.hpp"
#include "tests/io/link/far_ends.hpp"

namespace ground_port_link_port_test {

using namespace godwit;
using namespace godwit::ground_port;

constexpr int max_datagrams = 200; // a station hears the wanted one among as many others

class real_process {
public:
  explicit real_process(const std::string& uri) {
    std::string pattern = (std::filesystem::temp_directory_path() / "godwit-port-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    runtime::process_options options;
    options.journal.path = (folder_ / "journal.db").string();
    host_ = *runtime::process::open(options);
    const auto port = host_->actors().add<actor>({.name = "ground_port"}, {}, settings{}, signing_settings{},
                                                 std::static_pointer_cast<wire>(line), std::make_shared<const peers>());
    host_->actors().start();
    const auto opened = line->open(*io::link::parse_uri(uri), {}, host_->actors().make_gateway("line"), port);
    EXPECT_TRUE(opened) << opened.error();
  }
  real_process(const real_process&) = delete;
  real_process& operator=(const real_process&) = delete;
  ~real_process() {
    line->close();
    EXPECT_EQ(host_->actors().restarts(), 0U) << "nothing may have crashed";
    (void)host_->finish(0);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::shared_ptr<link_port> line = std::make_shared<link_port>();

private:
  std::filesystem::path folder_;
  std::unique_ptr<runtime::process> host_;
};

template <class M>
std::string bytes_of(const M& message) {
  const auto frame = mavlink::encode(message, mavlink::sender{255, 190}, 0);
  return {reinterpret_cast<const char*>(frame.span().data()), frame.size()};
}

// Waits until a message of type M comes.
template <class M>
std::optional<M> hear(const io::link::testing::udp_end& station) {
  mavlink::scanner scan;
  std::optional<M> result;
  for (int i = 0; i < max_datagrams && !result; ++i) {
    const auto datagram = station.receive();
    if (!datagram)
      return std::nullopt;
    scan.feed_datagram(std::as_bytes(std::span(*datagram)), [&](const mavlink::frame_view& each) {
      if (each.id() == M::message_id)
        result = mavlink::decode<M>(each);
    });
  }
  return result;
}

TEST(ground_port_on_a_line, a_station_hears_the_port_and_uploads_a_mission_over_udp) {
  const io::link::testing::udp_end station;
  const real_process p("udpout://127.0.0.1:" + std::to_string(station.port()));
  ASSERT_TRUE(hear<mavlink::heartbeat>(station));
  const auto port = station.last_sender();
  station.send(port, bytes_of(mavlink::mission_count{.target_system = 1, .target_component = 191, .count = 1}));
  ASSERT_TRUE(hear<mavlink::mission_request_int>(station));
  mavlink::mission_item_int item;
  item.target_system = 1;
  item.target_component = 191;
  item.command = mavlink::number(mavlink::mav_cmd::nav_waypoint);
  item.frame = mavlink::number(mavlink::mav_frame::global_relative_alt);
  station.send(port, bytes_of(item));
  const auto ack = hear<mavlink::mission_ack>(station);
  ASSERT_TRUE(ack);
  EXPECT_EQ(ack->type, mavlink::number(mavlink::mav_mission_result::accepted));
  EXPECT_NE(ack->opaque_id, 0U);
}

// -- either side starts first, and comes back --------------------------------------------------------

using io::link::testing::tcp_caller;
using io::link::testing::tcp_end;
using io::link::testing::udp_end;
using io::link::testing::unused_udp_port;

const std::string gcs_beat = bytes_of(mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::gcs)});

// Until DONE, or for 10 s.
template <class Done>
bool wait_until(Done done) {
  for (int i = 0; i < 1'000; ++i) {
    if (done())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return done();
}

// A whole frame of the port, heard over TCP.
template <class Far>
bool hears_a_frame(const Far& far) {
  const auto start = far.read(1);
  return !start.empty() && start.front() == '\xFD';
}

TEST(ground_port_on_a_line, udpout_to_a_station_that_starts_later_is_heard) {
  const auto number = unused_udp_port();
  const real_process p("udpout://127.0.0.1:" + std::to_string(number));
  ASSERT_TRUE(wait_until([&] { return p.line->counters().errors > 0; })) << "the first heartbeat is refused";
  const udp_end station(number);
  EXPECT_TRUE(hear<mavlink::heartbeat>(station));
}

TEST(ground_port_on_a_line, udpout_to_a_station_that_goes_and_comes_back_is_heard_again) {
  auto station = std::make_unique<udp_end>();
  const auto number = station->port();
  const real_process p("udpout://127.0.0.1:" + std::to_string(number));
  ASSERT_TRUE(hear<mavlink::heartbeat>(*station));
  station.reset();
  ASSERT_TRUE(wait_until([&] { return p.line->counters().errors > 0; }));
  station = std::make_unique<udp_end>(number);
  EXPECT_TRUE(hear<mavlink::heartbeat>(*station));
}

TEST(ground_port_on_a_line, udpout_of_a_port_that_comes_back_is_heard_by_a_station_that_stayed) {
  const udp_end station;
  const auto uri = "udpout://127.0.0.1:" + std::to_string(station.port());
  {
    const real_process p(uri);
    ASSERT_TRUE(hear<mavlink::heartbeat>(station));
  }
  const real_process p(uri);
  EXPECT_TRUE(hear<mavlink::heartbeat>(station));
}

TEST(ground_port_on_a_line, udpin_answers_a_station_that_was_there_first_and_one_that_comes_back) {
  const auto number = unused_udp_port();
  const udp_end early;
  early.send(number, gcs_beat); // nobody is there
  const real_process p("udpin://127.0.0.1:" + std::to_string(number));
  // As a station does it: again and again, and the first ones before the port listens.
  const auto beats_until_taken = [&](const udp_end& station) {
    const auto before = p.line->counters().rx_chunks;
    return wait_until([&] {
      station.send(number, gcs_beat);
      return p.line->counters().rx_chunks > before;
    });
  };
  ASSERT_TRUE(beats_until_taken(early));
  EXPECT_TRUE(hear<mavlink::heartbeat>(early));
  const udp_end again; // the same station from another port
  ASSERT_TRUE(beats_until_taken(again));
  EXPECT_TRUE(hear<mavlink::heartbeat>(again));
}

TEST(ground_port_on_a_line, tcp_to_a_station_that_listens_later_or_again_is_heard) {
  std::uint16_t number = 0;
  {
    const tcp_end taken;
    number = taken.port();
  }
  const real_process p("tcp://127.0.0.1:" + std::to_string(number));
  std::this_thread::sleep_for(std::chrono::milliseconds(300)); // nobody listens
  {
    tcp_end station(number);
    station.accept();
    EXPECT_TRUE(hears_a_frame(station));
  }
  tcp_end again(number);
  again.accept();
  EXPECT_TRUE(hears_a_frame(again));
}

TEST(ground_port_on_a_line, tcpin_takes_a_station_and_takes_it_again) {
  const auto number = unused_udp_port();
  const real_process p("tcpin://127.0.0.1:" + std::to_string(number));
  // It is there as soon as the port listens.
  const auto call = [&] {
    std::unique_ptr<tcp_caller> result;
    (void)wait_until([&] {
      try {
        result = std::make_unique<tcp_caller>(number);
      } catch (const std::exception&) { // refused
      }
      return result != nullptr;
    });
    return result;
  };
  auto station = call();
  ASSERT_TRUE(station);
  EXPECT_TRUE(hears_a_frame(*station));
  station.reset();
  const auto again = call();
  ASSERT_TRUE(again);
  EXPECT_TRUE(hears_a_frame(*again));
}

TEST(ground_port_on_a_line, serial_to_a_station_that_is_plugged_in_later_or_again_is_heard_each_way) {
  io::link::testing::serial_line cable;
  const auto uri = cable.uri();
  cable.unplug();
  const real_process p(uri);
  std::this_thread::sleep_for(std::chrono::milliseconds(300)); // nothing is there
  for (int i = 0; i < 2; ++i) {
    cable.plug_in();
    EXPECT_TRUE(hears_a_frame(cable)) << i;
    const auto before = p.line->counters().rx_chunks;
    cable.write(gcs_beat);
    EXPECT_TRUE(wait_until([&] { return p.line->counters().rx_chunks > before; })) << i;
    cable.unplug();
  }
}

// After the end of the port a read of the other end of a pseudo-terminal fails until the port has opened it again.
TEST(ground_port_on_a_line, serial_of_a_port_that_comes_back_is_heard_by_a_station_that_stayed) {
  const io::link::testing::serial_line cable;
  for (int i = 0; i < 2; ++i) {
    const real_process p(cable.uri());
    mavlink::scanner scan;
    int heard = 0;
    EXPECT_TRUE(wait_until([&] {
      const auto byte = cable.read(1);
      scan.feed(std::as_bytes(std::span(byte)), [&](const mavlink::frame_view&) { ++heard; });
      return heard > 0;
    })) << i;
  }
}

} // namespace ground_port_link_port_test
