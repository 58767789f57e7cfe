#include "programs/godwit-sim/host/hosted_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"

namespace godwit::sim {

namespace mavlink = io::mavlink;

hosted_vehicle::hosted_vehicle(std::size_t number, const hosted_settings& settings, surroundings& around)
    : number_(number), settings_(settings), around_(around),
      line_(settings.vehicle.seed,
            [this](way to, std::span<const std::byte> frame, bool is_damaged) { arrived(to, frame, is_damaged); }),
      finder_(around.datagrams), vehicle_(settings.vehicle, around.now_ns(), [this](std::span<const std::byte> frame) {
        line_.send(way::out, frame, around_.now_ns());
      }) {
  line_.set(settings.faults);
  for (const auto& each : settings.refusals)
    vehicle_.refuse_command(each.command, each.result, each.times);
  for (const auto& each : settings.more_lines)
    add_line(each);
}

void hosted_vehicle::add_line(const io::link::uri& where) {
  further_.push_back(std::make_unique<further_line>(further_line{where, 0, frame_finder(around_.datagrams), nullptr}));
  auto& line = *further_.back();
  line.number = vehicle_.add_line(
      [this, &line](std::span<const std::byte> frame) {
        note_sent(mavlink::frame_view(frame.data()));
        if (line.link)
          static_cast<void>(line.link->send(frame));
      },
      around_.now_ns());
}

tl::expected<void, std::string> hosted_vehicle::open(const io::link::link_options& options) {
  auto opened = io::link::open_link(
      settings_.where, callbacks(finder_, settings_.where, [this](const mavlink::frame_view& frame) { heard(frame); }),
      options);
  if (!opened)
    return tl::make_unexpected(std::move(opened.error()));
  link_ = *std::move(opened);
  for (const auto& each : further_) {
    const auto heard_there = [this, &line = *each](const mavlink::frame_view& frame) { heard(line, frame); };
    auto another = io::link::open_link(each->where, callbacks(each->finder, each->where, heard_there), options);
    if (!another)
      return tl::make_unexpected(std::move(another.error()));
    each->link = *std::move(another);
  }
  return {};
}

std::vector<std::unique_ptr<io::link::link>> hosted_vehicle::take_links() {
  std::vector<std::unique_ptr<io::link::link>> result;
  result.push_back(std::move(link_));
  for (const auto& each : further_)
    result.push_back(std::move(each->link));
  return result;
}

std::vector<std::string> hosted_vehicle::more_link_descriptions() const {
  std::vector<std::string> result;
  for (const auto& each : further_)
    result.push_back(each->link ? each->link->description() : each->where.text());
  return result;
}

io::link::link_callbacks hosted_vehicle::callbacks(frame_finder& finder, const io::link::uri& where, frame_sink take) {
  return {.received =
              [this, &finder, take = std::move(take)](io::link::peer_id from, std::span<const std::byte> bytes,
                                                      bool is_datagram) {
                finder.feed(from, bytes, is_datagram, around_.now_ns(), take);
                around_.moved(*this);
              },
          .changed =
              [this, &finder, &where](const io::link::link_status& status) {
                if (status.phase != io::link::link_phase::up)
                  finder.forget_all();
                around_.changed(*this, where, status);
              },
          .left = [&finder](io::link::peer_id who) { finder.forget(who); }};
}

void hosted_vehicle::note_heard(const mavlink::frame_view& frame) {
  if (around_.record)
    around_.record(frame);
  tell(watch_.heard(frame));
}

void hosted_vehicle::note_sent(const mavlink::frame_view& frame) {
  if (around_.record)
    around_.record(frame);
  tell(watch_.sent(frame));
}

void hosted_vehicle::heard(const mavlink::frame_view& frame) {
  note_heard(frame);
  line_.send(way::in, frame.bytes(), around_.now_ns());
}

void hosted_vehicle::heard(const further_line& on, const mavlink::frame_view& frame) {
  note_heard(frame);
  vehicle_.on_frame(frame, around_.now_ns(), on.number);
}

void hosted_vehicle::arrived(way to, std::span<const std::byte> frame, bool is_damaged) {
  if (to == way::in) {
    const auto hand_on = [this](const mavlink::frame_view& good) { vehicle_.on_frame(good, around_.now_ns()); };
    if (is_damaged)
      around_.damaged.feed_datagram(frame, hand_on);
    else
      hand_on(mavlink::frame_view(frame.data()));
    return;
  }
  if (!is_damaged)
    note_sent(mavlink::frame_view(frame.data()));
  if (link_)
    static_cast<void>(link_->send(frame));
}

void hosted_vehicle::on_time(std::int64_t now_ns) {
  finder_.on_time(now_ns, [this](const mavlink::frame_view& frame) { heard(frame); });
  for (const auto& each : further_)
    each->finder.on_time(now_ns, [&](const mavlink::frame_view& frame) { heard(*each, frame); });
  line_.on_time(now_ns);
  if (vehicle_.next_deadline_ns() <= now_ns)
    vehicle_.on_time(now_ns);
  if (around_.tell && now_ns >= next_look_ns_)
    look(now_ns);
}

std::int64_t hosted_vehicle::next_deadline_ns() const {
  const auto look_at = around_.tell ? next_look_ns_ : faulty_line::never;
  auto next = std::min({vehicle_.next_deadline_ns(), line_.next_deadline_ns(), finder_.next_deadline_ns(), look_at});
  for (const auto& each : further_)
    next = std::min(next, each->finder.next_deadline_ns());
  return next;
}

void hosted_vehicle::look(std::int64_t now_ns) {
  next_look_ns_ = now_ns + look_ns;
  for (auto& each : watch_.look(vehicle_.describe()))
    tell(std::move(each));
}

void hosted_vehicle::tell(std::string sentence) {
  if (around_.tell && !sentence.empty())
    around_.tell(*this, std::move(sentence));
}

struct hosted_vehicle::apply_to {
  hosted_vehicle& self;
  std::int64_t now_ns;

  void operator()(const fault::set_line& it) const { self.line_.set(it.faults); }
  void operator()(const fault::cut& it) const {
    self.line_.cut(it.time ? now_ns + it.time->count() : faulty_line::never);
  }
  void operator()(const fault::restore&) const { self.line_.restore(); }
  void operator()(const fault::reboot&) const { self.vehicle_.reboot(now_ns); }
  void operator()(const fault::gps& it) const { self.vehicle_.lose_position(it.is_lost, now_ns); }
  void operator()(const fault::way& it) const { self.vehicle_.block(it.is_blocked, now_ns); }
  void operator()(const fault::battery& it) const { self.vehicle_.set_battery(it.percent, now_ns); }
  void operator()(const fault::camera& it) const {
    if (self.around_.cut_camera)
      self.around_.cut_camera(it.is_cut);
  }
  void operator()(const fault::say& it) const { self.vehicle_.say(it.words, now_ns); }
  void operator()(const fault::refuse& it) const { self.vehicle_.refuse_command(it.command, it.result, it.times); }
};

void hosted_vehicle::apply(const fault::any& what, std::int64_t now_ns) {
  std::visit(apply_to{*this, now_ns}, what);
  around_.moved(*this);
}

namespace {

double battery_level(double percent) { return std::ceil(percent / event_watch::battery_step_percent); }

std::string item_of(const vehicle_picture& now) {
  return "item " + std::to_string(now.mission_current) + " of a plan of " + std::to_string(now.mission_count);
}

std::string plan_sentence(const vehicle_picture& now) {
  return now.mission_count == 0 ? "has no mission any more"
                                : "has a mission of " + std::to_string(now.mission_count) + " items";
}

std::string mission_sentence(const vehicle_picture& now) {
  if (now.mission_state == "running")
    return "mission running, " + item_of(now);
  return "mission " + now.mission_state;
}

} // namespace

std::vector<std::string> event_watch::look(const vehicle_picture& now) {
  std::vector<std::string> told;
  const auto tell = [&](bool is_new, std::string sentence) {
    if (has_looked_ && is_new)
      told.push_back(std::move(sentence));
  };
  tell(now.world_ms < last_.world_ms, "started again");
  tell(now.has_position != last_.has_position, now.has_position ? "has a position" : "has lost its position");
  tell(now.mission_count != last_.mission_count || now.mission_id != last_.mission_id, plan_sentence(now));
  tell(now.armed != last_.armed, now.armed ? "armed" : "disarmed");
  tell(now.mode != last_.mode, "mode " + now.mode);
  tell(now.in_air != last_.in_air, now.in_air ? "took off" : "landed");
  tell(now.mission_state != last_.mission_state, mission_sentence(now));
  tell(battery_level(now.battery_percent) < battery_level(last_.battery_percent),
       "battery " + std::to_string(std::lround(now.battery_percent)) + " %");
  if (now.mission_state == "running" && last_.mission_state != "running")
    reached_ = -1; // on the way again: the same item may be reached anew
  last_ = now;
  has_looked_ = true;
  return told;
}

std::string event_watch::sent(const mavlink::frame_view& frame) {
  if (frame.id() == mavlink::mission_item_reached::message_id) {
    const int sequence = mavlink::decode<mavlink::mission_item_reached>(frame).seq;
    if (sequence == std::exchange(reached_, sequence))
      return {};
    return "item " + std::to_string(sequence) + " reached";
  }
  if (frame.id() == mavlink::statustext::message_id) {
    const auto message = mavlink::decode<mavlink::statustext>(frame);
    const auto text = io::text_in(message.text);
    return "says: " + std::string(text.substr(0, text.find_last_not_of(" \t") + 1)); // PX4's end with a tab
  }
  return {};
}

std::string event_watch::heard(const mavlink::frame_view& frame) {
  if (frame.id() != mavlink::heartbeat::message_id)
    return {};
  const auto who = frame.from();
  if (stations_.size() == max_stations || std::find(stations_.begin(), stations_.end(), who) != stations_.end())
    return {};
  stations_.push_back(who);
  return "hears " + std::to_string(who.system) + "/" + std::to_string(who.component);
}

frame_finder::torn_stream& frame_finder::stream_of(io::link::peer_id from) {
  const auto found =
      std::find_if(streams_.begin(), streams_.end(), [from](const auto& each) { return each.from == from; });
  if (found != streams_.end())
    return *found;
  if (streams_.size() == max_streams) {
    const auto earlier = [](const torn_stream& a, const torn_stream& b) { return a.heard_ns < b.heard_ns; };
    streams_.erase(std::min_element(streams_.begin(), streams_.end(), earlier));
  }
  return streams_.emplace_back(torn_stream{from, 0, std::make_unique<io::mavlink::scanner>()});
}

std::int64_t frame_finder::next_deadline_ns() const {
  auto next = never;
  for (const auto& each : streams_)
    if (each.scanner->waiting_bytes() != 0)
      next = std::min(next, each.heard_ns + silence_ns);
  return next;
}

void frame_finder::forget(io::link::peer_id who) {
  std::erase_if(streams_, [who](const torn_stream& each) { return each.from == who; });
}

} // namespace godwit::sim
