// The whole daemon in virtual time: its real actors, a simulated vehicle, the simulated missions service and a ground
// station in one thread, by seed.
//
//   station ── wire ── ground_port ┐
//   service ── port ── mission_client ┼── executor, failsafe, mapobjects_store
//   vehicle ── line ── vehicle_link ┘
//      └── line ── person, who may as well be on the line of vehicle_link
//
// Time jumps from one thing that is due to the next; between two of them everything that can happen happens, in an
// order that the seed draws. The process can be killed at any moment and comes back after restart_takes_ns; so it does
// when its guardian gives up. Thread: one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "io/mavlink/scanner.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/progress.hpp"
#include "programs/godwit-drill/flight_simulation/daemon_process.hpp"
#include "programs/godwit-drill/flight_simulation/flight_record.hpp"
#include "programs/godwit-drill/flight_simulation/people_audit.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_person.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_service.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_station.hpp"
#include "programs/godwit-drill/flight_simulation/stored_disk.hpp"
#include "programs/godwit-drill/scratch_folder.hpp"
#include "programs/godwit-sim/line/faulty_line.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"
#include "programs/godwitd/service/crash_loop_guard.hpp"

namespace godwit::drill {

// What a flight can be made to do wrong on purpose, so that whoever judges flights shows that it would see it.
// Thread: values.
enum class planted_flaw {
  none,
  lose_report,     // the service forgets the third report
  double_report,   // the service has the third report twice
  order_to_person, // the vehicle is sent an order 2 s after godwit has seen that a person has it
  forget_delivery, // the record lacks the second report to mission_client
  end_process      // an assertion fails at the third report
};

GODWIT_ENUM_NAMES(planted_flaw, none, lose_report, double_report, order_to_person, forget_delivery, end_process);

// An order to the vehicle, as it came out of the line.
struct vehicle_order {
  std::int64_t at_ns = 0;
  std::uint32_t message_id = 0;
  std::uint16_t command = 0; // of COMMAND_LONG and COMMAND_INT
  bool puts_to_rest = false; // a mode for a vehicle that stands disarmed in its mission mode: godwit may send it always
  bool clears_armed = false; // it takes the plan from a vehicle that is armed
  std::optional<std::uint32_t> mode = {}; // that is asked for, as HEARTBEAT.custom_mode
};

class flight_simulation {
public:
  struct options {
    sim::personality who = sim::personality::px4;
    std::uint64_t seed = 1;
    bool starts_by_itself = true; // else by MISSION_START of the station
    bool arms_on_start = true;
    bool speaks_as_autopilot = false; // to the station
    bool has_service = true;          // else missions are what the station uploads
    bool takes_next = false;          // the missions of the service one after the other; else the first alone
    double speed = 10;                // of the vehicle's world
    double stream_factor = 0.3; // rates of its streams: three times the real ones in a world that is ten times as fast
    bool beats_at_mode_change = true;     // of an ArduPilot
    bool is_person_on_other_line = false; // to the vehicle: godwit does not hear what they are answered
    bool has_neighbour = false;           // another vehicle of the same kind, system 2, 100 m away on the same line
    int aircraft = 0;                     // others, that a receiver on the vehicle hears
    sim::line_faults line = {};
    // On UDP one heartbeat is not believed; nobody goes there, the frames come by a line of the simulation's.
    std::string vehicle_line = "udpin://127.0.0.1:0";
    bool is_shuffled = true;         // else in the order that costs least
    bool has_stored_journal = false; // in a file, whose disk fails below SQLite; one flight at a time has one
    bool is_recorded = false;        // what its actors do is held against the promises of invariants/
    planted_flaw planted = planted_flaw::none;
  };

  static constexpr std::int64_t restart_takes_ns = 300'000'000;

  // The service has MISSION (of short_mission(), when none is named), and nothing has happened yet.
  explicit flight_simulation(const options& wanted);
  flight_simulation(const options& wanted, const mission::document& mission);

  // Until CONDITION, or for so long. True: it held.
  template <class Condition>
  bool run_until(Condition condition, double most_s) {
    const auto end_ns = now_ns_ + static_cast<std::int64_t>(most_s * 1e9);
    while (now_ns_ < end_ns) {
      if (condition())
        return true;
      step(end_ns);
    }
    return condition();
  }
  void run_for(double seconds) {
    (void)run_until([] { return false; }, seconds);
  }
  bool run_until_phase(executor::phase wanted, double most_s = 600) {
    return run_until([&] { return status().now == wanted; }, most_s);
  }

  // -- what is to go wrong
  // Now; the next process begins after restart_takes_ns.
  void kill_process();
  enum class side { before, after };
  // Crashes it as soon as it runs again, until it is given up or the process is another one. True: within MOST_S.
  bool give_up(const std::string& actor, double most_s = 20);
  // At the N-th commit of all processes, counted from 1. One is planned at a time.
  void at_commit(std::uint64_t number, side where, std::function<void()> what);
  void kill_process_at_commit(std::uint64_t number, side where) {
    at_commit(number, where, [this] { kill_process(); });
  }
  // The computer: it is off for so long, and the crashes that were counted were of the boot before.
  void lose_power(double seconds);
  // A person removes the file in which abnormal ends are counted, and starts it again.
  void forget_abnormal_ends();
  // The process gets no processor for so long; then it sees that time has passed.
  void suspend_process(double seconds);
  // So far ahead of the true time, or behind it, from now on; the service keeps the true time.
  void set_wall_ahead(std::int64_t ns);
  // Each commit takes so long from now on; 0: none takes time.
  void slow_journal(double sync_s);
  // As a pilot's switch would, without godwit knowing.
  void switch_mode(std::uint32_t custom_mode, mode_form how = mode_form::set_mode);
  // Both ways; or one: then godwit is not heard (in), or hears nothing (out).
  void cut_line(double seconds, std::optional<sim::way> one = std::nullopt);
  void set_line(const sim::line_faults& faults) { line_.set(faults); }
  void cut_station(double seconds);
  void cut_service(double seconds);
  void reboot_vehicle();
  // Somebody else speaks on a line, from an address of his own and under any name.
  static constexpr io::link::peer_id stranger = 66;
  enum class target_line { vehicle, ground };
  template <class M>
  void forge(target_line where, const M& what, io::mavlink::sender as) {
    forge_bytes(where, io::mavlink::encode(what, as, forged_++).span());
  }

  // -- its parts
  [[nodiscard]] sim::vehicle& vehicle() { return *vehicle_; }
  [[nodiscard]] const sim::vehicle& vehicle() const { return *vehicle_; }
  // Null: there is none.
  [[nodiscard]] sim::vehicle* neighbour() { return neighbour_.get(); }
  [[nodiscard]] simulated_service& service() { return service_; }
  [[nodiscard]] simulated_station& station() { return station_; }
  // Who switches modes and does all else beside godwit.
  [[nodiscard]] simulated_person& person() { return person_; }
  // WHAT is done AFTER_NS after the moment in which godwit sends an order, SKIP ones passed over: one that moves the
  // vehicle, or brings it a plan. One is planned at a time.
  void when_ordered(int skip, std::int64_t after_ns, std::function<void()> what);
  // The same, of the first frame of godwit that IS_IT.
  using frame_filter = std::function<bool(const io::mavlink::frame_view&)>;
  void when_sent(frame_filter is_it, std::int64_t after_ns, std::function<void()> what);
  [[nodiscard]] bool has_planned_act() const { return at_order_.has_value(); }
  void forget_planned_act() { at_order_.reset(); }
  [[nodiscard]] const people_audit& audit() const { return audit_; }
  // Of a flight that has its journal in a file.
  [[nodiscard]] stored_disk* stored() { return stored_ ? &*stored_ : nullptr; }
  // None while it is down.
  [[nodiscard]] daemon_process* process() { return process_.get(); }
  [[nodiscard]] process_surroundings& outside() { return outside_; }
  // Of a flight that is recorded.
  [[nodiscard]] const flight_record& record() const { return *record_; }
  [[nodiscard]] flight_record& record() { return *record_; }
  void say(operators::command_kind what);
  void say(operators::command what);

  // -- what has happened
  // For its story.
  void note(const std::string& sentence);
  [[nodiscard]] std::int64_t now_ns() const { return now_ns_; }
  [[nodiscard]] std::int64_t wall_ns() const { return daemon_process::wall_began_ns + now_ns_; }
  [[nodiscard]] const std::string& mission_id() const { return mission_id_; }
  // As the executor has told it last.
  [[nodiscard]] const executor::phase_status& status() const { return status_; }
  [[nodiscard]] const std::vector<vehicle_order>& orders() const { return orders_; }
  [[nodiscard]] const flight_track& track() const { return track_; }
  // A plan or a start went out before what it is for was on the disk.
  [[nodiscard]] bool sent_without_intent() const { return sent_without_intent_; }
  // Times in reports are not those of the flight.
  [[nodiscard]] bool was_clock_set() const { return was_clock_set_; }
  // The mission as it was when the flight began.
  [[nodiscard]] const mission::document& first_mission() const { return first_mission_; }
  [[nodiscard]] std::uint64_t commits() const { return outside_.journal.commits; }
  [[nodiscard]] int processes() const { return processes_; }
  [[nodiscard]] sim::personality who() const { return who_; }
  // From the newest kill until the next process knew the vehicle; nothing: there was no kill, or it does not know it
  // yet.
  [[nodiscard]] std::optional<std::int64_t> process_recovery_ns() const { return process_recovery_ns_; }
  [[nodiscard]] std::uint64_t seed() const { return seed_; }
  // What the program log would say, with its part in front.
  [[nodiscard]] bool was_told(const std::string& words) const;
  // Among the newest sentences.
  [[nodiscard]] bool was_told_last(const std::string& words) const;
  // As the service has them, in the order in which they came.
  [[nodiscard]] std::vector<mission::progress_report> reports();
  [[nodiscard]] std::vector<mission::progress_report> reports_of(const std::string& mission_id);
  // All of it, for messages of tests.
  [[nodiscard]] std::string story();

private:
  void step(std::int64_t end_ns);
  [[nodiscard]] std::int64_t next_due_ns() const;
  void run_until_idle();
  void run_process();
  void run_shuffled();
  // True: something was moved.
  bool exchange();
  void watch_process();
  void begin_process();
  [[nodiscard]] bool is_planned_now();
  [[nodiscard]] bool is_suspended() const { return now_ns_ < suspended_until_ns_; }
  [[nodiscard]] bool is_station_cut() const { return now_ns_ < station_cut_until_ns_; }
  void end_sync();
  void begin_sync();
  void arrived(sim::way to, std::span<const std::byte> frame, bool is_damaged);
  void look_at_intent(const io::mavlink::frame_view& frame);
  void reaches_vehicle(const io::mavlink::frame_view& frame);
  void take_status(const executor::phase_status& now);
  void plant();
  void forge_bytes(target_line where, std::span<const std::byte> frame);
  void person_sends(std::span<const std::byte> frame);
  void look_at_order(const io::mavlink::frame_view& frame);
  void do_planned_act();
  [[nodiscard]] daemon::boot_moment moment() const;

  std::uint64_t seed_;
  sim::personality who_;
  planted_flaw planted_;
  std::mt19937_64 test_rng_;
  bool is_shuffled_;
  std::string mission_id_;
  mission::document first_mission_;
  std::int64_t now_ns_ = 1'000'000'000;
  scratch_folder folder_;
  std::vector<std::string> told_;
  executor::phase_status status_;
  std::vector<vehicle_order> orders_;
  flight_track track_;
  bool sent_without_intent_ = false;
  bool was_clock_set_ = false;
  std::uint8_t forged_ = 0;

  simulated_service service_;
  simulated_station station_;
  sim::faulty_line line_;
  std::unique_ptr<sim::vehicle> vehicle_;
  std::unique_ptr<sim::vehicle> neighbour_;
  sim::vehicle::line_number persons_line_ = 0;
  simulated_person person_;
  people_audit audit_;
  io::mavlink::scanner damaged_;

  std::unique_ptr<flight_record> record_;
  std::optional<stored_disk> stored_;
  process_surroundings outside_;
  std::unique_ptr<daemon_process> process_;
  int processes_ = 0;
  std::optional<daemon::crash_loop_guard> ledger_; // of the process that runs
  std::int64_t begins_ns_ = 0;                     // the next process, when there is none
  std::optional<std::int64_t> killed_ns_;          // and the vehicle is not known since
  std::optional<std::int64_t> process_recovery_ns_;
  std::optional<std::int64_t> order_to_person_ns_; // planted
  struct planned {
    std::uint64_t commit = 0;
    side where = side::after;
    std::function<void()> what;
  };
  std::optional<planned> planned_;
  struct planned_act {
    frame_filter is_it;
    int skip = 0;
    std::int64_t after_ns = 0;
    std::optional<std::int64_t> at_ns; // the order was sent
    std::function<void()> what;
  };
  std::optional<planned_act> at_order_;
  int boots_ = 1;
  std::int64_t suspended_until_ns_ = 0;
  std::int64_t station_cut_until_ns_ = 0;
  std::int64_t sync_takes_ns_ = 0;
  std::optional<std::int64_t> sync_ends_ns_; // the one that is under way
};

} // namespace godwit::drill
