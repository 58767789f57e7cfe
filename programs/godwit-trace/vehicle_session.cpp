#include "programs/godwit-trace/vehicle_session.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <system_error>
#include <utility>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace godwit::trace_tool {

namespace {

std::int64_t since_epoch_ns(auto time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

void append(vehicle_link::effects& to, vehicle_link::effects more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

} // namespace

vehicle_session::vehicle_session(const vehicle_link::settings& configured,
                                 const vehicle_link::signing_settings& signing)
    : core_(configured, signing, {}), descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (descriptor_ < 0)
    throw std::system_error(errno, std::generic_category(), "eventfd");
}

vehicle_session::~vehicle_session() {
  link_.reset(); // its thread wakes us through the descriptor
  ::close(descriptor_);
}

vehicle_link::instant vehicle_session::now() {
  return {since_epoch_ns(std::chrono::steady_clock::now()), since_epoch_ns(std::chrono::system_clock::now())};
}

void vehicle_session::wake() const {
  const std::uint64_t one = 1;
  (void)!::write(descriptor_, &one, sizeof one); // it can only be full, and then it is readable already
}

tl::expected<void, std::string> vehicle_session::open(const io::link::uri& where) {
  io::link::link_callbacks callbacks;
  callbacks.received = [this](io::link::peer_id peer, std::span<const std::byte> bytes, bool is_datagram) {
    if (incoming_.put(peer, bytes, is_datagram))
      wake();
  };
  callbacks.changed = [this](const io::link::link_status& status) {
    if (incoming_.put(status))
      wake();
  };
  auto opened = io::link::open_link(where, std::move(callbacks));
  if (!opened)
    return tl::make_unexpected(opened.error());
  link_ = std::move(*opened);
  return {};
}

void vehicle_session::wait(std::int64_t until_ns, int stop) const {
  const auto left_ns = std::clamp<std::int64_t>(until_ns - now().monotonic_ns, 0, 1'000'000'000);
  const timespec left{left_ns / 1'000'000'000, left_ns % 1'000'000'000};
  pollfd watched[] = {{descriptor_, POLLIN, 0}, {stop, POLLIN, 0}};
  (void)::ppoll(watched, std::size(watched), &left, nullptr); // interrupted: the caller looks again
  std::uint64_t count = 0;
  (void)!::read(descriptor_, &count, sizeof count);
}

vehicle_link::effects vehicle_session::next(std::int64_t until_ns, int stop) {
  wait(std::min(until_ns, core_.next_deadline_ns()), stop);
  vehicle_link::effects told;
  while (const auto arrived = incoming_.take())
    append(told, carry_out(std::visit([this](const auto& what) { return take(what); }, *arrived)));
  if (now().monotonic_ns >= core_.next_deadline_ns())
    append(told, carry_out(core_.on_time(now())));
  return told;
}

vehicle_link::effects vehicle_session::take(const io::link::link_status& what) {
  status_ = what;
  return core_.on_link(what, now());
}

vehicle_link::effects vehicle_session::take(const io::link::arrival& what) {
  return core_.on_bytes(what.peer, what.is_datagram, what.bytes, now());
}

vehicle_link::effects vehicle_session::carry_out(vehicle_link::effects wanted) {
  vehicle_link::effects told;
  for (auto& each : wanted)
    if (const auto* out = std::get_if<vehicle_link::transmission>(&each))
      link_->send(out->frame.span(), out->to);
    else
      told.push_back(std::move(each));
  return told;
}

} // namespace godwit::trace_tool
