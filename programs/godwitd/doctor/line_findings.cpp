#include "programs/godwitd/doctor/line_findings.hpp"

#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>

#include "io/link/link.hpp"
#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "programs/common/heartbeat_sender.hpp"
#include "programs/common/link_advice.hpp"
#include "programs/common/peer_scanners.hpp"
#include "programs/godwitd/open_line.hpp"

namespace godwit::daemon::doctor {

namespace {

using io::mavlink::mav_autopilot;
using io::mavlink::number;

constexpr std::uint64_t damaged_share = 20; // one frame of so many: a radio at its limit, or a wrong baud rate

std::string autopilot_name(std::uint8_t autopilot) {
  if (autopilot == number(mav_autopilot::ardupilotmega))
    return "ArduPilot";
  if (autopilot == number(mav_autopilot::px4))
    return "PX4";
  return "an autopilot of kind " + std::to_string(autopilot) + ", which was not tried";
}

std::string name_of(const heard_sender& who) {
  return std::to_string(who.system) + "/" + std::to_string(who.component);
}

std::vector<heard_sender> autopilots_of(const heard_line& heard) {
  std::vector<heard_sender> result;
  std::ranges::copy_if(heard.senders, std::back_inserter(result),
                       [](const heard_sender& each) { return each.autopilot != number(mav_autopilot::invalid); });
  return result;
}

finding no_frames(const heard_line& heard, const io::link::uri& line) {
  if (heard.counted.v1_frames != 0)
    return {grade::problem, "autopilot", "Only MAVLink 1 arrives on " + line.text() + ".",
            programs::advice_for_mavlink_1};
  auto advice = heard.counted.bytes == 0 ? programs::advice_for_silence(line, heard.lasted, true)
                                         : programs::advice_for_noise(line, heard.counted.bytes);
  return {grade::problem, "autopilot", "No autopilot is heard on " + line.text() + ".", std::move(advice)};
}

finding nobody_flies(const heard_line& heard, const io::link::uri& line) {
  std::string names;
  for (const auto& each : heard.senders)
    names += (names.empty() ? "" : ", ") + name_of(each);
  return {grade::problem, "autopilot",
          "MAVLink arrives on " + line.text() + ", and no heartbeat of an autopilot" +
              (names.empty() ? "." : "; heartbeats come from " + names + "."),
          "Connect the line to the autopilot itself, or have the router pass its heartbeats on."};
}

finding judge_autopilots(const std::vector<heard_sender>& all, const line_expectation& wanted) {
  std::string names;
  for (const auto& each : all)
    names += (names.empty() ? "" : " and ") + std::to_string(each.system) + " (" + autopilot_name(each.autopilot) + ")";
  const auto expected = std::ranges::find(all, wanted.system, &heard_sender::system);
  if (wanted.system != 0 && expected == all.end())
    return {grade::problem, "autopilot",
            "Vehicle " + std::to_string(wanted.system) + " is expected (vehicle.system), and " + names + " is heard.",
            "Set vehicle.system to the vehicle that godwit is to fly, or 0 where there is one alone."};
  if (all.size() > 1 && wanted.system == 0)
    return {grade::problem, "autopilot", "More than one autopilot is heard: " + names + ".",
            "Set vehicle.system to the one that godwit is to fly."};
  return {grade::good, "autopilot", "Vehicle " + names + " is heard on " + wanted.line.text() + "."};
}

finding judge_signing(const std::vector<heard_sender>& all, const line_expectation& wanted) {
  const bool is_signed = std::ranges::any_of(all, &heard_sender::is_signed);
  if (is_signed && !wanted.has_key)
    return {grade::problem, "signing", "The autopilot signs, and no key is set: it refuses what godwit sends.",
            "Name the key's file in vehicle.key_file (--signing-key)."};
  if (!is_signed && wanted.has_key)
    return {grade::problem, "signing", "A key is set, and the autopilot does not sign: nothing of it is believed.",
            "Give it the key over a serial line with `godwitd ctl sign`, or take vehicle.key_file out."};
  if (is_signed)
    return {grade::good, "signing", "The autopilot signs."};
  const auto open = open_line(wanted.line, false);
  if (open.empty())
    return {grade::good, "signing", "The line has no key, and does not leave this vehicle."};
  return {grade::warning, "signing",
          "The line has no key: whoever is in the network of " + open + " can take the flight.",
          "Set vehicle.key_file, and give the autopilot the key with `godwitd ctl sign`."};
}

} // namespace

findings judge_line(const heard_line& heard, const line_expectation& wanted) {
  if (!heard.why_down.empty())
    return {{grade::problem, "line", "The line is not open: " + heard.why_down + ".",
             "See what is found above about the serial line, or check address and port of vehicle.uri."}};
  if (heard.counted.frames == 0)
    return {no_frames(heard, wanted.line)};
  const auto all = autopilots_of(heard);
  findings result{all.empty() ? nobody_flies(heard, wanted.line) : judge_autopilots(all, wanted)};
  if (!all.empty())
    result.push_back(judge_signing(all, wanted));
  if (heard.counted.bad_crc * damaged_share > heard.counted.frames + heard.counted.bad_crc)
    result.push_back({grade::warning, "line",
                      std::to_string(heard.counted.bad_crc) + " of " +
                          std::to_string(heard.counted.frames + heard.counted.bad_crc) + " frames arrive damaged.",
                      "Check cable, ground and baud rate; a radio needs a lower data rate or a better antenna."});
  return result;
}

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
