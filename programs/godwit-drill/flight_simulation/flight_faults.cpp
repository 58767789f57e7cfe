// What goes wrong in a flight.
#include <filesystem>
#include <limits>
#include <utility>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"

namespace godwit::drill {
namespace {

namespace mavlink = io::mavlink;

std::int64_t ns_of(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

} // namespace

// -- the process ------------------------------------------------------------------------------------

void flight_simulation::kill_process() {
  if (!process_)
    return;
  note("killed at commit " + std::to_string(commits()));
  (void)exchange(); // what it has sent is on its way
  process_.reset();
  begins_ns_ = now_ns_ + restart_takes_ns;
  killed_ns_ = now_ns_;
  suspended_until_ns_ = 0;
  sync_ends_ns_.reset();
}

void flight_simulation::lose_power(double seconds) {
  kill_process();
  note("the computer is off for " + std::to_string(seconds) + " s");
  ++boots_;
  if (stored_)
    stored_->lose_power(test_rng_());
  begins_ns_ = now_ns_ + ns_of(seconds);
}

void flight_simulation::forget_abnormal_ends() {
  note("a person removes the file of abnormal ends");
  std::error_code ignored;
  std::filesystem::remove(folder_.file("godwit.starts"), ignored);
  if (!process_)
    begins_ns_ = now_ns_ + restart_takes_ns;
}

void flight_simulation::suspend_process(double seconds) {
  note("the process is suspended for " + std::to_string(seconds) + " s");
  suspended_until_ns_ = now_ns_ + ns_of(seconds);
}

void flight_simulation::set_wall_ahead(std::int64_t ns) {
  note("the wall clock is set " + std::to_string(ns / 1'000'000'000) + " s ahead");
  outside_.wall_ahead_ns = ns;
  was_clock_set_ = true;
  if (process_)
    process_->set_wall_ahead(ns);
}

bool flight_simulation::give_up(const std::string& actor, double most_s) {
  note(actor + " is to be given up");
  const auto before = processes_;
  const bool is_done = run_until(
      [&] {
        if (process_ == nullptr || processes_ != before)
          return true;
        (void)process_->kill(actor);
        run_until_idle();
        return process_ == nullptr || process_->look_at(actor).phase == runtime::child_phase::given_up;
      },
      most_s);
  run_until_idle();
  return is_done;
}

// -- the disk ---------------------------------------------------------------------------------------

void flight_simulation::slow_journal(double sync_s) {
  note("each commit takes " + std::to_string(sync_s) + " s");
  sync_takes_ns_ = ns_of(sync_s);
  sync_ends_ns_.reset();
  if (process_)
    process_->hold_journal(sync_takes_ns_ > 0);
}

void flight_simulation::begin_sync() {
  if (process_ && sync_takes_ns_ > 0 && !sync_ends_ns_ && process_->has_uncommitted())
    sync_ends_ns_ = now_ns_ + sync_takes_ns_;
}

void flight_simulation::end_sync() {
  if (!process_ || !sync_ends_ns_ || now_ns_ < *sync_ends_ns_)
    return;
  sync_ends_ns_.reset();
  process_->sync_journal();
}

void flight_simulation::at_commit(std::uint64_t number, side where, std::function<void()> what) {
  planned_ = planned{number, where, std::move(what)};
}

// Before: somewhere between the first write that would be in this commit and the commit.
bool flight_simulation::is_planned_now() {
  if (!planned_ || commits() + 1 < planned_->commit)
    return false;
  const bool is_done = commits() >= planned_->commit;
  return is_done || (planned_->where == side::before && process_->has_uncommitted() && test_rng_() % 4 == 0);
}

// -- lines and the vehicle --------------------------------------------------------------------------

void flight_simulation::switch_mode(std::uint32_t custom_mode, mode_form how) {
  note("a pilot switches to mode " + std::to_string(custom_mode) + " by " + std::string(io::name_of(how)));
  person_.change_mode(who_, custom_mode, how);
}

void flight_simulation::cut_line(double seconds, std::optional<sim::way> one) {
  const std::string which = !one ? "" : *one == sim::way::in ? " to the vehicle" : " from the vehicle";
  note("the line" + which + " is cut for " + std::to_string(seconds) + " s");
  if (one)
    line_.cut(*one, now_ns_ + ns_of(seconds));
  else
    line_.cut(now_ns_ + ns_of(seconds));
}

void flight_simulation::cut_station(double seconds) {
  note("the line to the ground station is cut for " + std::to_string(seconds) + " s");
  station_cut_until_ns_ = now_ns_ + ns_of(seconds);
}

void flight_simulation::cut_service(double seconds) {
  note("the missions service is cut off for " + std::to_string(seconds) + " s");
  service_.cut(now_ns_ + ns_of(seconds));
}

void flight_simulation::reboot_vehicle() {
  note("the autopilot starts again");
  vehicle_->reboot(now_ns_);
}

void flight_simulation::forge_bytes(target_line where, std::span<const std::byte> frame) {
  if (!process_)
    return;
  auto& line = where == target_line::vehicle ? process_->vehicle_wire() : process_->ground_wire();
  line.receive(frame, stranger);
  run_until_idle();
}

// -- on purpose -------------------------------------------------------------------------------------

void flight_simulation::plant() {
  if (!order_to_person_ns_ || now_ns_ < *order_to_person_ns_)
    return;
  order_to_person_ns_ = std::numeric_limits<std::int64_t>::max();
  mavlink::command_long order;
  order.target_system = 1;
  order.target_component = 1;
  order.command = mavlink::number(mavlink::mav_cmd::mission_start);
  const auto frame = mavlink::encode(order, {1, 191}, 0);
  audit_.on_sent(frame.view(), now_ns_);
  reaches_vehicle(frame.view());
}

} // namespace godwit::drill
