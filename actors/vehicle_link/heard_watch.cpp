#include "actors/vehicle_link/heard_watch.hpp"

#include <algorithm>
#include <utility>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums.hpp"
#include "messages/vehicle_link/connection.hpp"

namespace godwit::vehicle_link {

namespace {

using io::mavlink::number;

std::pair<int, int> order_of(io::mavlink::sender who) { return {who.system, who.component}; }

std::string counted(std::uint64_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

} // namespace

void heard_watch::restart(const unusable_frames& until_now, std::int64_t now_ns) {
  senders_.clear();
  before_ = until_now;
  announced_.clear();
  announced_ns_ = now_ns;
}

heard_watch::sender_heard& heard_watch::entry_of(io::mavlink::sender who) {
  auto place = std::ranges::find(senders_, who, &sender_heard::who);
  if (place != senders_.end())
    return *place;
  if (senders_.size() == max_senders)
    senders_.erase(std::ranges::min_element(senders_, {}, &sender_heard::last_ns));
  place = std::ranges::lower_bound(senders_, order_of(who), {},
                                   [](const sender_heard& each) { return order_of(each.who); });
  return *senders_.insert(place, {.who = who});
}

void heard_watch::on_frame(const io::mavlink::frame_view& frame, std::int64_t now_ns) {
  auto& of = entry_of(frame.from());
  of.last_ns = now_ns;
  ++of.frames;
  if (frame.id() != io::mavlink::heartbeat::message_id)
    return;
  const auto beat = io::mavlink::decode<io::mavlink::heartbeat>(frame);
  ++of.heartbeats;
  if (beat.type == number(io::mavlink::mav_type::gcs))
    of.what = kind::ground_station;
  else
    of.what = beat.autopilot == number(io::mavlink::mav_autopilot::invalid) ? kind::program : kind::autopilot;
}

std::string heard_watch::described(const sender_heard& each, with what) const {
  std::string result;
  switch (each.what) {
  case kind::autopilot:
    result = "autopilot ";
    break;
  case kind::ground_station:
    result = "ground station ";
    break;
  case kind::program:
    result = "program ";
    break;
  case kind::without_heartbeat:
    result = "sender ";
  }
  result += std::to_string(each.who.system) + "/" + std::to_string(each.who.component);
  std::string remarks;
  if (what == with::numbers)
    remarks = each.heartbeats == 0 ? counted(each.frames, "frame") : counted(each.heartbeats, "heartbeat");
  if (each.what == kind::without_heartbeat)
    remarks += std::string(remarks.empty() ? "" : ", ") + "no heartbeat";
  if (each.what == kind::autopilot && each.who.component != expected_.component)
    remarks +=
        std::string(remarks.empty() ? "" : "; ") + "its component has to be " + std::to_string(expected_.component);
  return remarks.empty() ? result : result + " (" + remarks + ")";
}

std::string heard_watch::list(const unusable_frames& until_now, std::int64_t now_ns, with what) const {
  std::string result;
  const auto add = [&](const std::string& part) { result += (result.empty() ? "" : ", ") + part; };
  for (const auto& each : senders_)
    if (now_ns - each.last_ns < others_count_ns)
      add(described(each, what));
  const auto add_frames = [&](std::uint64_t count, const char* which) {
    if (count != 0)
      add((what == with::numbers ? counted(count, "frame") : std::string("frames")) + which);
  };
  // The channel forgets the numbers of who was silent longest.
  const auto since = [](std::uint64_t now, std::uint64_t before) { return now - std::min(now, before); };
  add_frames(since(until_now.unbelieved, before_.unbelieved), " not believed");
  add_frames(since(until_now.damaged, before_.damaged), " damaged");
  add_frames(since(until_now.of_mavlink_1, before_.of_mavlink_1), " of MAVLink 1");
  return result;
}

std::string heard_watch::sentence(const unusable_frames& until_now, std::int64_t now_ns) const {
  const auto all = list(until_now, now_ns, with::numbers);
  return all.empty() ? all : std::string(heard_instead) + all;
}

bool heard_watch::on_announcement(const unusable_frames& until_now, std::int64_t now_ns) {
  auto now = list(until_now, now_ns, with::names_alone);
  if (now == announced_)
    return false;
  announced_ = std::move(now);
  announced_ns_ = now_ns;
  return true;
}

} // namespace godwit::vehicle_link
