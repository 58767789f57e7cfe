// ground_port on a real UDP socket: threads, sockets and a journal in a file.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "actors/ground_port/actor.hpp"
#include "actors/ground_port/link_port.hpp"
#include "runtime/process.hpp"
#include "tests/io/link/far_ends.hpp"

namespace {

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

} // namespace
