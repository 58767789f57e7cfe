// A whole flight in virtual time: the executor's decisions, the link to the vehicle, and a simulated vehicle.
//
//   executor::core + its durable state ─┬─> vehicle_link::core  <->  sim::vehicle
//   failsafe::core + its record        ─┘
//
// Notes are applied one in each turn, as the actor does it; crash() takes the core and the notes that were not written,
// and the durable state begins anew. What the service would have got is kept in order. Thread: one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "actors/executor/core.hpp"
#include "actors/failsafe/core.hpp"
#include "actors/vehicle_link/core.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"
#include "tests/support/short_mission.hpp"
#include "tests/support/simulated_person.hpp"
#include "tests/support/virtual_time.hpp"

namespace godwit::tests {

class flight_world {
public:
  struct options {
    sim::personality who = sim::personality::px4;
    executor::start_policy start = executor::start_policy::automatic;
    bool arm_on_start = true;
    executor::start_policy takeoff_again = executor::start_policy::on_command;
    double speed = 5; // of the vehicle's world
    bool has_service = true;
    bool asks_next = false; // it gives one mission after the other
    bool shows_home = false;
    bool brings_last_line = true;
    bool marks_landings = false; // of a plane
    executor::refusal_policy refused_inserts = executor::refusal_policy::go_on;
    bool changes_need_service = false;
    std::int64_t service_wait_ms = 2'000;
    executor::deletion_policy deleted_mission = executor::deletion_policy::go_on;
    failsafe::settings failsafe = {};
    mission_client::pull_state map = mission_client::pull_state::synced; // what is told of it as a mission is loaded
    double battery_percent = sim::vehicle_settings{}.battery_percent;
    double endurance_s = sim::vehicle_settings{}.endurance_s; // of a full one, in flight
    double drain_percent_per_min = 0;                         // as it is set
    // Of the line between link and vehicle, both ways; of each frame.
    double lost = 0;
    double doubled = 0;
    double late = 0;                // by a second and a half
    std::int64_t most_delay_ms = 1; // frames overtake each other when it is above 1
    bool keeps_order = false;       // but not on such a line: a serial one, TCP
    std::uint64_t seed = 1;
    bool holds_when_landed = false;       // of a PX4
    int rtl_autoland = 3;                 // of a plane
    bool has_payload = false;             // a camera and a gripper that report
    bool is_person_on_other_line = false; // to the vehicle; else on that of the link, which hears what it answers them
  };

  // Of all flights of this process that are over: so often each row of the phase table was taken, and from which phase.
  [[nodiscard]] static std::vector<executor::phase_machine::counts>& all_transitions();

  // The same of who was asked and kept the others waiting.
  [[nodiscard]] static executor::core::ruling_counts& all_decisions();

  explicit flight_world(const options& wanted);
  ~flight_world() { end_core(); }

  // Where the vehicle was as its pictures were taken.
  [[nodiscard]] const std::vector<sim::position>& pictures() const { return pictures_; }

  void load(const mission::document& what);
  // What becomes of the map's pull, now and for missions that are loaded later.
  void pull_map(mission_client::pull_state outcome);
  void assign(const mission::assignment& assignment);
  void delete_mission(const std::string& id);
  void refuse_mission(mission_client::refusal why);
  // As far as the core is told: it can not be kept up.
  void lose_failsafe(bool is_gone) { core_->on_failsafe_gone(is_gone); }
  // What a ground station uploads, clears and starts; and what it is shown.
  template <class M>
  void station_says(const M& m) {
    take(core_->on_station(m, now()));
    run_until_idle();
  }
  void station_chooses(const executor::set_current& item, std::uint64_t key) {
    take(core_->on_station(item, key, now()));
    run_until_idle();
  }
  // What a person does through it, as ground_port asks for it; whether it goes on to the vehicle is the test's.
  executor::act_answer station_does(executor::act_kind what, executor::station by = {255, 190}) {
    auto [wanted, answer] = core_->on_station(executor::station_act{what, by, std::string(io::name_of(what))}, now());
    take(wanted);
    run_until_idle();
    return answer;
  }
  // The same of a command that the vehicle acknowledges; its number.
  std::uint64_t station_commands(executor::act_kind what, executor::station by = {255, 190});
  [[nodiscard]] const executor::act_answer& last_act_answer() const { return last_act_answer_; }
  void vehicle_answers(std::uint64_t number, bool is_refused) {
    station_says(executor::act_acknowledged{number, is_refused});
  }
  // What has come of holds.
  [[nodiscard]] const std::vector<executor::act_resolved>& resolved_acts() const { return resolved_acts_; }
  [[nodiscard]] const std::vector<io::mavlink::mission_item_int>& shown_items() const { return shown_items_; }
  [[nodiscard]] int times_shown() const { return times_shown_; }
  [[nodiscard]] const std::vector<ground_port::mission_progress>& shown_progress() const { return shown_progress_; }
  [[nodiscard]] const std::vector<std::uint16_t>& shown_reached() const { return shown_reached_; }
  // What became of what it uploaded or cleared; of uploads the actor says it.
  [[nodiscard]] const std::vector<ground_port::plan_judged>& judged() const { return judged_; }
  [[nodiscard]] const std::vector<executor::start_answer>& start_answers() const { return start_answers_; }
  [[nodiscard]] std::int64_t wall_ns() const { return now().wall_ns; }
  [[nodiscard]] operators::answer say(operators::command_kind what);
  [[nodiscard]] operators::answer say(const operators::command& what);
  // Acknowledges what the preflight checks find degraded, when they have.
  [[nodiscard]] bool acknowledge();
  // What the service answers to a change, from now on.
  void set_changes(mission_client::change_verdict answer) { change_answer_ = answer; }
  // It answers no change from now on.
  void silence_service(bool is_silent) { is_service_silent_ = is_silent; }
  struct told_change {
    std::string key;
    std::size_t after_reports = 0; // so many were told before it
    std::int64_t at_ns = 0;
  };
  // What mission_client was told: what is asked, and what is flown without an answer.
  [[nodiscard]] const std::vector<told_change>& asked_changes() const { return asked_changes_; }
  [[nodiscard]] const std::vector<told_change>& flown_changes() const { return flown_changes_; }
  // Of one of them, at last.
  void answer_change(const std::string& key, mission_client::change_verdict verdict, const std::string& reason = {});
  void crash(); // of the executor; it begins anew at once, with what its record holds
  void crash_failsafe();
  // Of the link to the vehicle; what was asked of it is answered as the actor's address does it.
  void crash_link();
  void crash_all(); // the process: executor, failsafe, and the link to the vehicle
  void cut_line(double seconds);
  void deafen(double seconds); // what is sent arrives, and nothing comes back
  // The link has a transfer of the executor.
  [[nodiscard]] bool is_uploading() const {
    return std::ranges::any_of(asked_, [](const auto& each) { return each.second; });
  }

  // Until CONDITION, or for so long. True: it held.
  template <class Condition>
  bool run_until(Condition condition, double most_s) {
    const auto end = time_.now_ns() + static_cast<std::int64_t>(most_s * 1e9);
    while (time_.now_ns() < end) {
      if (condition())
        return true;
      step();
    }
    return condition();
  }
  void run_for(double seconds) {
    (void)run_until([] { return false; }, seconds);
  }
  bool run_until_phase(executor::phase wanted, double most_s = 600) {
    return run_until([&] { return state_.status.now == wanted; }, most_s);
  }

  [[nodiscard]] const executor::state& durable() const { return state_; }
  [[nodiscard]] sim::vehicle& vehicle() { return *vehicle_; }
  [[nodiscard]] std::int64_t now_ns() const { return time_.now_ns(); }
  [[nodiscard]] const std::vector<mission::progress_report>& reports() const { return reports_; }
  [[nodiscard]] const std::vector<mission_client::respond_to_assignment>& answers() const { return answers_; }
  [[nodiscard]] const std::vector<std::string>& said() const { return said_; }
  // Commands that went to the vehicle, by number of MAV_CMD, in order; but for those that take it out of its mission
  // mode on the ground, which are counted by themselves.
  [[nodiscard]] int stand_bys() const { return stand_bys_; }
  [[nodiscard]] const std::vector<std::uint16_t>& commands() const { return commands_; }
  // Of these, so many start its plan: MISSION_START, or of a PX4 its mission mode.
  [[nodiscard]] int starts() const { return starts_; }
  // Of these, so many arm it.
  [[nodiscard]] int arms() const { return arms_; }
  // And so many disarm it.
  [[nodiscard]] int disarms() const { return disarms_; }
  // All that went to the vehicle to change something: commands, uploads, items to go on with; what is counted in
  // stand_bys() is not.
  [[nodiscard]] int orders() const { return orders_; }
  // Of these, so many were for fences and rally points; they are not counted in orders().
  [[nodiscard]] int last_line_orders() const { return last_line_orders_; }
  // No transfer of a fence or of rally points comes to the vehicle.
  void lose_fences(bool are_lost) { loses_fences_ = are_lost; }
  void set_loss(double share) { lost_ = share; }
  void set_journal_nearly_full(bool is_so);
  // The next so many of this MAV_CMD do not come to the vehicle.
  void lose_command(std::uint16_t command, int times) { losses_ = {command, times}; }
  // None of these comes to the vehicle any more, or from it; 0: all do again.
  void lose_message(std::uint32_t id) { lost_message_ = id; }
  // Those of the failsafe.
  [[nodiscard]] const std::vector<failsafe::command_vehicle>& reactions() const { return reactions_; }
  // What the failsafe watches over.
  [[nodiscard]] const std::vector<mission::geofence>& guarded() const { return record_.limits.geofences; }
  [[nodiscard]] int pushes() const { return pushes_; }
  // What mission_client was asked for besides: missions that it begins, pulls, copies that are accepted.
  [[nodiscard]] int begins() const { return begins_; }
  [[nodiscard]] int pulls() const { return pulls_; }
  [[nodiscard]] int accepted_copies() const { return accepted_copies_; }
  // "waypoint 2 reached, ..." for messages of tests.
  [[nodiscard]] std::string story() const;
  // Somebody arms it, takes off (what flies) and goes on in this mode.
  void fly_by_hand(std::uint32_t custom_mode);
  // As a pilot's switch would.
  void switch_mode(std::uint32_t custom_mode, mode_form how = mode_form::set_mode);
  // Whoever does this and all else by hand.
  [[nodiscard]] simulated_person& person() { return person_; }
  // A STATUSTEXT of the autopilot.
  void vehicle_says(std::string_view text);
  // Its clock since boot went back, as far as the link can tell.
  void vehicle_restarts();
  void vehicle_tells(const vehicle_link::observation& what);
  // One that is on the line as well; only its heartbeat, of the same kind.
  void another_vehicle_beats(std::uint8_t system);
  // Under the vehicle's ids.
  void another_program_beats();
  // Nothing comes from the vehicle, or to it, until it is heard again.
  void silence_vehicle(bool is_silent) { is_vehicle_silent_ = is_silent; }
  // Frames that name another system than the vehicle's as the one that is meant.
  [[nodiscard]] int sent_to_others() const { return sent_to_others_; }
  [[nodiscard]] std::string sentence() const { return core_->sentence(); }
  [[nodiscard]] std::string_view authority() const { return core_->authority(); }
  [[nodiscard]] std::string home_moved() const { return core_->home_moved(); }
  // Of the link's journal: of the flight that is open.
  [[nodiscard]] const std::optional<vehicle_link::vehicle_name>& kept_vehicle() const { return kept_; }
  void arm_by_hand();
  void disarm_by_hand();   // also in the air
  void set_home_by_hand(); // where it is
  void set_home_by_hand(const sim::position& where);
  // The home that the executor has heard last.
  [[nodiscard]] const std::optional<executor::plan::vehicle_home>& told_home() const { return core_->view().home(); }
  [[nodiscard]] const flight::mode_owner& owner() const { return owner_; } // once its heartbeat was heard
  [[nodiscard]] executor::known_missions missions() const { return core_->missions(); }
  [[nodiscard]] executor::way_home_estimate way_home() const { return core_->way_home(now()); }
  [[nodiscard]] executor::heard_traffic traffic() const { return core_->traffic(now()); }
  // What the preflight check of this name has found last; nothing before it was looked at.
  [[nodiscard]] executor::preflight::finding found(std::string_view check) const;
  // The mode that the executor has heard last.
  [[nodiscard]] std::optional<std::uint32_t> heard_mode() const;

private:
  [[nodiscard]] bool is_lost(std::span<const std::byte> frame);
  [[nodiscard]] bool is_silenced(std::span<const std::byte> frame) const;
  [[nodiscard]] executor::instant now() const { return {time_.now_ns(), wall_began_ns + time_.now_ns()}; }
  [[nodiscard]] io::mavlink::instant link_now() const { return {time_.now_ns(), wall_began_ns + time_.now_ns()}; }
  [[nodiscard]] std::unique_ptr<vehicle_link::core> new_link() const;
  void keep_vehicle();
  void tell_map(const std::string& mission_id);
  void begin_link();
  void begin_executor(bool is_new_process);
  void step();
  void run_until_idle();
  void take(const executor::effects& wanted);
  void take(const executor::note& each) { notes_.push_back(each.what); }
  void take(const executor::order& each);
  void take(const executor::give_up_transfer&) { take(link_->on_cancel_transfer(link_now())); }
  void take(const executor::watch_vehicle& each) { take(link_->on_watch_closely({each.is_close}, link_now())); }
  void take(const executor::send_to_client& each);
  void take(const executor::send_to_failsafe& each);
  void take(const executor::send_to_port& each);
  void take_report(const mission::progress_report& report);
  void take(const failsafe::effects& wanted);
  void take(const failsafe::command_vehicle& each);
  void take(const failsafe::failsafe_status_changed& each);
  void take(const failsafe::guard_resolved& each);
  void take(const failsafe::override_resolved&) {}
  void take(const failsafe::warning& each) { said_.push_back("failsafe: " + each.text); }
  void take(const godwit::runtime::condition&) {}
  void take(const failsafe::remember& each);
  void tick_failsafe();
  void carry(std::span<const std::byte> frame, std::function<void(const std::vector<std::byte>&)> deliver);
  [[nodiscard]] failsafe::instant failsafe_now() const { return {time_.now_ns(), wall_began_ns + time_.now_ns()}; }
  void take(const executor::announce& each) { said_.push_back(each.sentence); }
  void take(const vehicle_link::effects& wanted);
  void take(const vehicle_link::transmission& each);
  void take(const vehicle_link::resolved_command& each);
  void take(const vehicle_link::resolved_transfer& each);
  void take(const vehicle_link::resolved_look& each) {
    if (looks_.erase(each.request_id) > 0)
      take(core_->on_looked(each.request_id, each.what, now()));
  }
  void take(const vehicle_link::observation& each);
  void take(const vehicle_link::announcement& each);
  void dispatch(const executor::durable_core::effect& each);
  void take_change(const std::string& key, bool is_flown, const std::optional<std::string>& after,
                   const std::vector<mission::item>& items, bool keeps_rest);
  void change_mission(const std::string& key, const std::optional<std::string>& after,
                      const std::vector<mission::item>& items, bool keeps_rest);
  void restore();
  void end_core();
  void hear(std::span<const std::byte> frame);
  void note_picture(std::span<const std::byte> frame);
  std::vector<sim::position> pictures_;
  [[nodiscard]] executor::host_status host_status() const;

  static constexpr std::int64_t wall_began_ns = 1'790'000'000'000'000'000; // September 2026

  static constexpr io::mavlink::sender persons_id{255, 190};

  sim::personality who_;
  virtual_time time_{1'000'000'000};
  executor::settings settings_;
  executor::state state_;
  std::unique_ptr<executor::core> core_;
  mission_client::pull_state map_;
  failsafe::settings failsafe_settings_;
  failsafe::state record_;
  std::unique_ptr<failsafe::core> failsafe_;
  flight::mode_owner owner_;
  std::int64_t failsafe_due_ns_ = 0;
  std::optional<vehicle_link::vehicle_name> kept_; // on the disk
  std::unique_ptr<vehicle_link::core> link_;
  std::mt19937_64 test_rng_;
  double lost_ = 0;
  double doubled_ = 0;
  double late_ = 0;
  std::int64_t most_delay_ms_ = 1;
  bool keeps_order_ = false;
  std::int64_t newest_arrival_ns_ = 0;
  std::int64_t cut_until_ns_ = 0;
  std::int64_t deaf_until_ns_ = 0;
  std::map<std::uint64_t, bool> asked_; // of the link, and not answered yet; true: a transfer
  std::set<std::uint64_t> looks_;       // the same
  std::uint64_t link_age_ = 0;          // frames on their way to a link that has died are lost
  std::unique_ptr<sim::vehicle> vehicle_;
  sim::vehicle::line_number persons_line_ = 0;
  simulated_person person_{persons_id, [this](std::span<const std::byte> frame) {
                             vehicle_->on_frame(io::mavlink::frame_view(frame.data()), time_.now_ns(), persons_line_);
                           }};
  io::mavlink::scanner to_vehicle_;
  std::deque<executor::durable_core::event> notes_;
  std::deque<std::function<void()>> news_; // what they have led to
  std::vector<mission::progress_report> reports_;
  std::vector<mission_client::respond_to_assignment> answers_;
  std::vector<std::string> said_;
  std::vector<std::uint16_t> commands_;
  int stand_bys_ = 0;
  int starts_ = 0;
  int arms_ = 0;
  int disarms_ = 0;
  int orders_ = 0;
  int last_line_orders_ = 0;
  bool loses_fences_ = false;
  bool is_journal_nearly_full_ = false;
  std::pair<std::uint16_t, int> losses_; // MAV_CMD, how many more
  std::uint32_t lost_message_ = 0;
  std::vector<failsafe::command_vehicle> reactions_;
  std::int32_t service_revision_ = 0;
  bool is_service_silent_ = false;
  std::vector<told_change> asked_changes_;
  std::vector<told_change> flown_changes_;
  mission_client::change_verdict change_answer_ = mission_client::change_verdict::done;
  std::vector<io::mavlink::mission_item_int> shown_items_;
  int times_shown_ = 0;
  std::vector<ground_port::mission_progress> shown_progress_; // where it changed
  std::vector<std::uint16_t> shown_reached_;
  std::vector<executor::start_answer> start_answers_;
  std::vector<ground_port::plan_judged> judged_;
  std::vector<executor::act_resolved> resolved_acts_;
  executor::act_answer last_act_answer_;
  std::uint64_t last_act_ = 0;
  int pushes_ = 0;
  int begins_ = 0;
  int pulls_ = 0;
  int accepted_copies_ = 0;
  bool is_vehicle_silent_ = false;
  int sent_to_others_ = 0;
  int still_ = 0; // steps in which no time passed
};

} // namespace godwit::tests
