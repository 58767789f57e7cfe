// What QGroundControl sent (tests/data/stations), sent again at its times: to a simulated vehicle alone, and to the
// whole daemon before the same vehicle. What the station hears of each request and what the vehicle then does is the
// same, but for the differences that are listed here with their reasons.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"
#include "tests/programs/godwitd/flight_simulation/station_recording.hpp"

namespace station_recordings_test {

using namespace godwit;
using namespace godwit::drill;
namespace mavlink = io::mavlink;
using mavlink::mav_cmd;
using mavlink::number;
using station_recording::recorded_frame;

constexpr std::int64_t ns_per_s = 1'000'000'000;
constexpr double settles_s = 5;    // from the vehicle's start to the first frame of the station
constexpr double act_takes_s = 20; // after an act: what the vehicle does by then counts
constexpr double end_takes_s = 60;

struct recording {
  std::string name;
  sim::personality who;
};

const std::array recordings{recording{"qgc_px4_direct", sim::personality::px4},
                            recording{"qgc_px4_plan_port", sim::personality::px4},
                            recording{"qgc_px4_modes_port", sim::personality::px4},
                            recording{"qgc_px4_joystick_port", sim::personality::px4},
                            recording{"qgc_px4_takeoff_goto_port", sim::personality::px4},
                            recording{"qgc_ardupilot_direct", sim::personality::ardupilot},
                            recording{"qgc_ardupilot_port", sim::personality::ardupilot}};

// -- what is heard ------------------------------------------------------------------------------------

// Of each kind of answer, in order.
using answers = std::map<std::string, std::vector<std::string>>;

class notebook {
public:
  void hear(const mavlink::frame_view& frame) {
    ++heard_[frame.id()];
    switch (frame.id()) {
    case mavlink::command_ack::message_id:
      return note(mavlink::decode<mavlink::command_ack>(frame));
    case mavlink::mission_ack::message_id: {
      const auto m = mavlink::decode<mavlink::mission_ack>(frame);
      return add("MISSION_ACK", m.mission_type, std::to_string(m.type));
    }
    case mavlink::mission_count::message_id: {
      const auto m = mavlink::decode<mavlink::mission_count>(frame);
      return add("MISSION_COUNT", m.mission_type, std::to_string(m.count));
    }
    case mavlink::mission_request::message_id: { // an ArduPilot asks with the older one
      const auto m = mavlink::decode<mavlink::mission_request>(frame);
      return add("MISSION_REQUEST", m.mission_type, std::to_string(m.seq));
    }
    case mavlink::mission_request_int::message_id: {
      const auto m = mavlink::decode<mavlink::mission_request_int>(frame);
      return add("MISSION_REQUEST", m.mission_type, std::to_string(m.seq));
    }
    case mavlink::mission_item_int::message_id: {
      const auto m = mavlink::decode<mavlink::mission_item_int>(frame);
      return add("MISSION_ITEM_INT", m.mission_type,
                 std::to_string(m.seq) + ": " + std::to_string(m.command) + " at " + std::to_string(m.x) + ' ' +
                     std::to_string(m.y) + ' ' + std::to_string(m.z));
    }
    case mavlink::mission_current::message_id:
      current_ = mavlink::decode<mavlink::mission_current>(frame);
      return;
    case mavlink::param_value::message_id:
      params_[mavlink::decode<mavlink::param_value>(frame).param_index] = true;
      return;
    default:
      return;
    }
  }
  void add(const std::string& kind, int of, const std::string& what) {
    said_[kind + ' ' + std::to_string(of)].push_back(what);
  }
  void add_done(const std::string& kind, const std::string& what) { done_[kind].push_back(what); }

  // To what the station has asked.
  [[nodiscard]] const answers& answers_alone() const { return said_; }
  [[nodiscard]] answers all() const {
    auto result = said_;
    result.insert(done_.begin(), done_.end());
    result["PARAM_VALUE"] = {std::to_string(params_.size()) + " parameters"};
    for (const std::uint32_t id : {110U, mavlink::autopilot_version::message_id, mavlink::protocol_version::message_id})
      if (const auto found = heard_.find(id); found != heard_.end())
        result["message " + std::to_string(id)] = {std::to_string(found->second)};
    return result;
  }
  // As a station shows it.
  [[nodiscard]] std::string plan() const {
    if (!current_)
      return "no plan";
    return "item " + std::to_string(current_->seq) + " of " + std::to_string(current_->total);
  }

private:
  void note(const mavlink::command_ack& m) {
    if (m.result != number(mavlink::mav_result::in_progress))
      add("COMMAND_ACK", m.command, std::to_string(m.result));
  }

  answers said_;
  answers done_; // what the vehicle did
  std::map<std::uint32_t, std::size_t> heard_;
  std::map<std::uint16_t, bool> params_;
  std::optional<mavlink::mission_current> current_;
};

// -- the two lines ------------------------------------------------------------------------------------

// The vehicle alone.
class direct_line {
public:
  explicit direct_line(sim::personality who)
      : station_([this](std::span<const std::byte> frame) {
          vehicle_->on_frame(mavlink::frame_view(frame.data()), now_ns_);
        }) {
    sim::vehicle_settings settings;
    settings.who = who;
    vehicle_ = std::make_unique<sim::vehicle>(settings, now_ns_,
                                              [this](std::span<const std::byte> frame) { station_.receive(frame); });
  }
  void run_for(double seconds) {
    const auto end_ns = now_ns_ + static_cast<std::int64_t>(seconds * 1e9);
    while (now_ns_ < end_ns) {
      now_ns_ = std::clamp(std::min(vehicle_->next_deadline_ns(), station_.next_deadline_ns()), now_ns_, end_ns);
      if (vehicle_->next_deadline_ns() <= now_ns_)
        vehicle_->on_time(now_ns_);
      station_.on_time(now_ns_);
    }
  }
  [[nodiscard]] simulated_station& station() { return station_; }
  [[nodiscard]] sim::vehicle& vehicle() { return *vehicle_; }

private:
  std::int64_t now_ns_ = ns_per_s;
  simulated_station station_;
  std::unique_ptr<sim::vehicle> vehicle_;
};

flight_simulation::options through_port(sim::personality who) {
  flight_simulation::options result;
  result.who = who;
  result.starts_by_itself = false;
  result.arms_on_start = false;
  result.speaks_as_autopilot = true;
  result.has_service = false;
  result.speed = 1;
  result.stream_factor = 1;
  result.is_shuffled = false;
  return result;
}

// -- the replay ---------------------------------------------------------------------------------------

// After which the vehicle does something else. Empty: nothing of the kind.
std::string act_in(const mavlink::frame_view& frame) {
  if (frame.id() == mavlink::set_mode::message_id)
    return "mode " + std::to_string(mavlink::decode<mavlink::set_mode>(frame).custom_mode);
  if (frame.id() == mavlink::mission_item::message_id)
    return "item to fly to";
  std::uint16_t command = 0;
  if (frame.id() == mavlink::command_long::message_id)
    command = mavlink::decode<mavlink::command_long>(frame).command;
  if (frame.id() == mavlink::command_int::message_id)
    command = mavlink::decode<mavlink::command_int>(frame).command;
  switch (command) {
  case number(mav_cmd::do_set_mode):
    return "mode " + std::to_string(static_cast<int>(mavlink::decode<mavlink::command_long>(frame).param2));
  case number(mav_cmd::component_arm_disarm):
    return mavlink::decode<mavlink::command_long>(frame).param1 == 0 ? "disarm" : "arm";
  case number(mav_cmd::nav_takeoff):
    return "take off";
  case number(mav_cmd::mission_start):
    return "start";
  case number(mav_cmd::do_reposition):
    return "go to";
  default:
    return {};
  }
}

std::string state_of(const sim::vehicle& vehicle) {
  const auto seen = vehicle.describe();
  return seen.mode + (seen.armed ? " armed" : " disarmed") + (seen.in_air ? " in the air" : "");
}

struct replayed {
  answers heard;
  std::map<std::string, sim::position> places; // at the end of each act
};

template <class Line>
replayed replay(Line& line, const std::vector<recorded_frame>& frames, notebook& notes) {
  replayed result;
  std::map<std::string, int> acts;
  std::string last_act;
  const auto look = [&] {
    if (last_act.empty())
      return;
    notes.add_done("after " + last_act, state_of(line.vehicle()));
    notes.add_done("plan after " + last_act, notes.plan());
    result.places[last_act] = line.vehicle().describe().where;
    last_act.clear();
  };
  line.run_for(settles_s);
  std::int64_t at_ns = 0;
  const auto run_to = [&](std::int64_t until_ns) {
    const double left_s = static_cast<double>(until_ns - at_ns) / 1e9;
    if (left_s > act_takes_s) {
      line.run_for(act_takes_s);
      look();
      line.run_for(left_s - act_takes_s);
    } else {
      line.run_for(left_s);
    }
    at_ns = until_ns;
  };
  for (const auto& each : frames) {
    if (!each.is_stations)
      continue;
    run_to(each.at_ns);
    const auto frame = each.frame.view();
    if (const auto act = act_in(frame); !act.empty()) {
      last_act.clear(); // two in one breath: what comes of the last one counts
      last_act = act + " #" + std::to_string(++acts[act]);
    }
    line.station().send_frame(each.frame.span());
  }
  run_to(at_ns + static_cast<std::int64_t>(end_takes_s * 1e9));
  result.heard = notes.all();
  return result;
}

template <class Line>
replayed replay(Line& line, const std::vector<recorded_frame>& frames) {
  notebook notes;
  line.station().listen([&](const mavlink::frame_view& frame) { notes.hear(frame); });
  return replay(line, frames, notes);
}

replayed directly(const recording& what, const std::vector<recorded_frame>& frames) {
  direct_line line(what.who);
  return replay(line, frames);
}

replayed by_port(const recording& what, const std::vector<recorded_frame>& frames) {
  flight_simulation line(through_port(what.who));
  return replay(line, frames);
}

std::vector<recorded_frame> frames_of(const recording& what) {
  return station_recording::read(std::string(GODWIT_TEST_DATA) + "/stations/" + what.name + ".txt");
}

// -- differences --------------------------------------------------------------------------------------

std::string join(const std::vector<std::string>& texts) {
  std::string result;
  for (const auto& each : texts)
    result += (result.empty() ? "" : ", ") + each;
  return result.empty() ? "nothing" : result;
}

// A line for each.
std::vector<std::string> differences(const answers& direct, const answers& port) {
  std::vector<std::string> result;
  const auto compare = [&](const std::string& kind) {
    const auto found = [&](const answers& in) {
      const auto at = in.find(kind);
      return at == in.end() ? std::vector<std::string>{} : at->second;
    };
    if (found(direct) != found(port))
      result.push_back(kind + ": " + join(found(direct)) + " / " + join(found(port)));
  };
  for (const auto& [kind, texts] : direct)
    compare(kind);
  for (const auto& [kind, texts] : port)
    if (!direct.contains(kind))
      compare(kind);
  return result;
}

struct listed {
  std::string_view recording;
  std::string_view difference; // "kind: direct / port"
  std::string_view reason;
};

constexpr std::string_view flown_as_plan = "a go to is a plan of godwit's, which its failsafes and fences watch";
constexpr std::string_view landed_elsewhere =
    "where its person has ended the flight the plan is shown as the vehicle has it";

constexpr std::array differences_of_port{
    listed{"qgc_px4_plan_port", "MISSION_ACK 0: 0, 0 / 0, 14", "a plan that is flown is not cleared"},
    listed{"qgc_px4_modes_port", "MISSION_ACK 0: 0, 0, 0 / 0, 0, 14",
           "after a person's emergency stop the plan stays until the vehicle is handed back"},
    listed{"qgc_px4_modes_port", "COMMAND_ACK 176: 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 / 0, 0, 0, 0, 0, 0, 0, 0, 1, 1",
           "what the station shows is not what would be flown: it has to load the plan before it starts it"},
    listed{"qgc_px4_modes_port", "plan after disarm #1: item 0 of 65535 / item 1 of 5", landed_elsewhere},
    listed{"qgc_px4_modes_port", "plan after arm #2: item 0 of 65535 / item 1 of 5", landed_elsewhere},
    listed{"qgc_ardupilot_port", "after go to #2: GUIDED armed in the air / AUTO armed in the air", flown_as_plan}};
static_assert(differences_of_port.size() <= 10);

// Since then the simulated vehicles do it as the real ones.
constexpr std::array differences_since{
    listed{"qgc_px4_direct", "COMMAND_ACK 176: nothing / 0, 0, 0", "a PX4 answers SET_MODE"},
    listed{"qgc_ardupilot_direct", "MISSION_ACK 0: 0, 1 / 0, 0", "an ArduPilot flies to an item with current = 2"}};

// Each that is not listed, and each that is listed and not there.
template <class List>
void expect_listed(const std::string& recording, const std::vector<std::string>& found, const List& all) {
  for (const auto& each : found)
    EXPECT_TRUE(std::ranges::any_of(
        all, [&](const listed& one) { return one.recording == recording && one.difference == each; }))
        << recording << ", not listed: " << each;
  for (const auto& each : all) {
    EXPECT_FALSE(each.reason.empty());
    if (each.recording == recording) {
      EXPECT_NE(std::ranges::find(found, each.difference), found.end()) << "it is not so any more: " << each.difference;
    }
  }
}

class station_recordings : public testing::TestWithParam<recording> {};

TEST_P(station_recordings, each_answer_through_the_port_is_that_of_a_direct_line) {
  const auto frames = frames_of(GetParam());
  const auto direct = directly(GetParam(), frames);
  const auto port = by_port(GetParam(), frames);
  ASSERT_GT(direct.heard.size(), 3U) << "the vehicle answers nothing";
  expect_listed(GetParam().name, differences(direct.heard, port.heard), differences_of_port);
}

// Where it was sent to, whoever flies it.
TEST_P(station_recordings, each_go_to_leads_to_the_place_to_which_a_direct_line_leads) {
  constexpr double same_place_m = 30;
  const auto frames = frames_of(GetParam());
  const auto direct = directly(GetParam(), frames).places;
  const auto port = by_port(GetParam(), frames).places;
  for (const auto& [act, place] : direct)
    if (act.starts_with("go to") || act.starts_with("item to fly to")) {
      const auto there = port.at(act);
      EXPECT_LT(sim::between(place, there).distance_m, same_place_m) << act;
      EXPECT_NEAR(place.altitude_m, there.altitude_m, 5) << act;
    }
}

// Of the recordings that have its answers.
TEST_P(station_recordings, the_simulated_vehicle_answers_as_it_did_when_they_were_made) {
  const auto frames = frames_of(GetParam());
  notebook then;
  for (const auto& each : frames)
    if (!each.is_stations)
      then.hear(each.frame.view());
  if (then.answers_alone().empty())
    return;
  notebook now;
  direct_line line(GetParam().who);
  line.station().listen([&](const mavlink::frame_view& frame) { now.hear(frame); });
  (void)replay(line, frames, now);
  expect_listed(GetParam().name, differences(then.answers_alone(), now.answers_alone()), differences_since);
}

INSTANTIATE_TEST_SUITE_P(of_QGroundControl, station_recordings, testing::ValuesIn(recordings),
                         [](const auto& which) { return which.param.name; });

} // namespace station_recordings_test
