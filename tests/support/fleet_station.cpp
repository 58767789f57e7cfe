#include "tests/support/fleet_station.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/time.h>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::tests {
namespace {

namespace mavlink = io::mavlink;
using mavlink::mav_cmd;
using mavlink::number;

constexpr mavlink::sender identity{255, 190};
constexpr int receive_bytes = 8 * 1024 * 1024; // some seconds of a thousand vehicles
constexpr std::chrono::milliseconds again{1'000};
constexpr float guided = 4; // ArduPilot's
constexpr std::uint16_t items = 3;

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

} // namespace

fleet_station::fleet_station(const std::vector<vehicle>& fleet, bool makes_fly)
    : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  // Waits end by themselves, so that the thread sees when it is over.
  const timeval patience{0, 100'000};
  if (!socket_.is_open() || ::setsockopt(socket_.number(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience) != 0)
    throw std::system_error(errno, std::generic_category(), "socket");
  // Beyond the system's usual bound for root only; less is fewer messages counted.
  if (::setsockopt(socket_.number(), SOL_SOCKET, SO_RCVBUFFORCE, &receive_bytes, sizeof receive_bytes) != 0)
    ::setsockopt(socket_.number(), SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof receive_bytes);
  for (const auto& each : fleet) {
    by_port_[each.port] = fleet_.size();
    fleet_.push_back({each, makes_fly ? step::upload : step::done, false});
  }
  thread_ = std::thread([this] { run(); });
}

fleet_station::~fleet_station() {
  is_over_ = true;
  thread_.join();
}

void fleet_station::run() {
  auto next = std::chrono::steady_clock::now();
  std::array<std::byte, 2'048> buffer{};
  while (!is_over_) {
    if (const auto now = std::chrono::steady_clock::now(); now >= next) {
      next = now + again;
      speak_to_all();
    }
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const auto got =
        ::recvfrom(socket_.number(), buffer.data(), buffer.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    const auto who = by_port_.find(ntohs(from.sin_port));
    if (got <= 0 || who == by_port_.end())
      continue;
    auto& speaker = fleet_[who->second];
    heard_from_ += speaker.is_heard ? 0 : 1;
    speaker.is_heard = true;
    bytes_ += static_cast<std::uint64_t>(got);
    scanner_.feed_datagram(std::span(buffer).first(static_cast<std::size_t>(got)),
                           [&](const mavlink::frame_view& frame) { heard(speaker, frame); });
  }
}

void fleet_station::speak_to_all() {
  for (const auto& each : fleet_) {
    send(each, mavlink::heartbeat{.type = 6, .autopilot = 8});
    ask(each);
  }
}

void fleet_station::ask(const member& of) {
  mavlink::mission_count count;
  count.target_system = of.who.system;
  count.target_component = 1;
  count.count = items;
  switch (of.now) {
  case step::upload:
    return send(of, count);
  case step::guided:
    return command(of, number(mav_cmd::do_set_mode), 1, guided);
  case step::arm:
    return command(of, number(mav_cmd::component_arm_disarm), 1, 0);
  case step::start:
    return command(of, number(mav_cmd::mission_start), 0, 0);
  case step::done:
    return;
  }
}

void fleet_station::heard(member& from, const mavlink::frame_view& frame) {
  ++frames_;
  if (from.now == step::done)
    return;
  if (frame.id() == mavlink::mission_request::message_id)
    return send_item(from, mavlink::decode<mavlink::mission_request>(frame).seq);
  if (frame.id() == mavlink::mission_request_int::message_id)
    return send_item(from, mavlink::decode<mavlink::mission_request_int>(frame).seq);
  if (frame.id() == mavlink::mission_ack::message_id && from.now == step::upload &&
      mavlink::decode<mavlink::mission_ack>(frame).type == 0)
    return go_on(from);
  if (frame.id() != mavlink::command_ack::message_id)
    return;
  const auto ack = mavlink::decode<mavlink::command_ack>(frame);
  const bool fits = (ack.command == number(mav_cmd::do_set_mode) && from.now == step::guided) ||
                    (ack.command == number(mav_cmd::component_arm_disarm) && from.now == step::arm) ||
                    (ack.command == number(mav_cmd::mission_start) && from.now == step::start);
  if (fits && ack.result == 0)
    go_on(from);
}

void fleet_station::go_on(member& with) {
  with.now = static_cast<step>(static_cast<int>(with.now) + 1);
  flying_ += with.now == step::done ? 1 : 0;
  ask(with);
}

// Home, a take-off, and a place an hour away.
void fleet_station::send_item(const member& to, std::uint16_t seq) {
  constexpr std::uint16_t waypoint = 16;
  constexpr std::uint16_t takeoff = 22;
  constexpr std::uint8_t relative = 6;
  mavlink::mission_item_int item;
  item.target_system = to.who.system;
  item.target_component = 1;
  item.seq = seq;
  item.frame = relative;
  item.command = seq == 1 ? takeoff : waypoint;
  item.autocontinue = 1;
  item.x = 475'000'000;
  item.y = 85'000'000;
  item.z = 20;
  send(to, item);
}

template <class M>
void fleet_station::send(const member& to, const M& message) {
  const auto frame = mavlink::encode(message, identity, sequence_++);
  const auto address = loopback(to.who.port);
  // A datagram that is lost is sent again with all others.
  static_cast<void>(::sendto(socket_.number(), frame.span().data(), frame.size(), 0,
                             reinterpret_cast<const sockaddr*>(&address), sizeof address));
}

void fleet_station::command(const member& to, std::uint16_t which, float first, float second) {
  mavlink::command_long message;
  message.target_system = to.who.system;
  message.target_component = 1;
  message.command = which;
  message.param1 = first;
  message.param2 = second;
  send(to, message);
}

} // namespace godwit::tests
