#include "programs/godwitd/doctor/line_listener.hpp"

#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>

#include "io/link/link.hpp"
#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "programs/common/heartbeat_sender.hpp"
#include "programs/common/peer_scanners.hpp"

namespace godwit::daemon::doctor {
namespace {

namespace mavlink = io::mavlink;
using std::chrono::steady_clock;

constexpr std::uint64_t heartbeats_enough = 3; // at 1 Hz a second autopilot has spoken by then
constexpr std::size_t max_senders = 32;        // more are not listed

std::int64_t wall_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

class listener {
public:
  void hear(io::link::peer_id peer, std::span<const std::byte> bytes, bool is_datagram) {
    const std::scoped_lock lock(mutex_);
    scanners_.feed(peer, is_datagram, bytes, [this](const mavlink::frame_view& frame) { note(frame); });
    changed_.notify_one();
  }

  void hear(const io::link::link_status& status) {
    const std::scoped_lock lock(mutex_);
    status_ = status;
  }

  // True: enough was heard.
  bool wait_until(steady_clock::time_point when) {
    std::unique_lock lock(mutex_);
    return changed_.wait_until(lock, when, [this] {
      return std::ranges::any_of(senders_, [](const heard_sender& each) {
        return each.heartbeats >= heartbeats_enough &&
               each.autopilot != mavlink::number(mavlink::mav_autopilot::invalid);
      });
    });
  }

  [[nodiscard]] heard_line result(std::chrono::seconds lasted) {
    const std::scoped_lock lock(mutex_);
    return {lasted, status_.phase == io::link::link_phase::up ? std::string() : status_.reason, scanners_.counters(),
            senders_};
  }

private:
  void note(const mavlink::frame_view& frame) {
    if (frame.id() != mavlink::heartbeat::message_id)
      return;
    auto found = std::ranges::find_if(senders_, [&](const heard_sender& each) {
      return each.system == frame.system() && each.component == frame.component();
    });
    if (found == senders_.end() && senders_.size() == max_senders)
      return;
    const auto said = mavlink::decode<mavlink::heartbeat>(frame);
    if (found == senders_.end())
      found = senders_.insert(found, {frame.system(), frame.component(), said.type, said.autopilot});
    found->is_signed |= frame.is_signed();
    ++found->heartbeats;
  }

  std::mutex mutex_; // over all
  std::condition_variable changed_;
  programs::peer_scanners scanners_;
  std::vector<heard_sender> senders_;
  io::link::link_status status_;
};

} // namespace

tl::expected<heard_line, std::string> listen_on(const io::link::uri& line, std::chrono::seconds patience) {
  listener heard;
  io::link::link_callbacks callbacks;
  callbacks.received = [&](io::link::peer_id peer, std::span<const std::byte> bytes, bool is_datagram) {
    heard.hear(peer, bytes, is_datagram);
  };
  callbacks.changed = [&](const io::link::link_status& status) { heard.hear(status); };
  auto opened = io::link::open_link(line, callbacks);
  if (!opened)
    return tl::make_unexpected(std::move(opened.error()));
  programs::heartbeat_sender heartbeats(programs::default_identity, std::nullopt);
  const auto began = steady_clock::now();
  for (auto next = began; next < began + patience; next += std::chrono::seconds(1)) {
    heartbeats.send(**opened, wall_ns());
    if (heard.wait_until(next + std::chrono::seconds(1)))
      break;
  }
  auto result = heard.result(std::chrono::ceil<std::chrono::seconds>(steady_clock::now() - began));
  opened->reset(); // its callbacks come no more
  return result;
}

} // namespace godwit::daemon::doctor
