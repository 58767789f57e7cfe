#include "invariants/rules/rules.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "invariants/rules/body.hpp"
#include "io/mavlink/enums/command.hpp"

namespace godwit::invariants {

namespace {

using nlohmann::json;
using runtime::delivery;
using runtime::name_table;
using runtime::outcome;

constexpr std::size_t max_missions = 1'000; // in one trace; later ones are not looked at

// A report as the executor makes it and mission_client takes it.
struct report {
  std::string mission;
  std::uint64_t number = 0;
  std::uint64_t generation = 0;
  std::uint64_t revision = 0;
  std::string kind;
  std::string whole;
};

// What the service has of a mission, as it told a process whose journal has less or was just begun.
struct service_word {
  std::uint64_t last_report_no = 0;
  std::uint64_t generation = 0; // of that report; 0: not given back
};

// For what looks at the reports, mission by mission. State is what is known of one mission.
//
// Where a journal was lost or is an older one, what was told and never reached the service has not been: numbers go on
// after the service's. What such a process tells before the service has answered is numbered anew by mission_client.
template <class State>
class about_reports : public invariant {
public:
  void take(const delivery& each, const name_table& names) final {
    if (loaded_.is(each.type, names) && each.how == outcome::handled)
      return look_at_mission(each);
    if (found_.is(each.type, names) && each.how == outcome::handled)
      return look_at_older_journal(each);
    if (!type_.is(each.type, names) || !has_come(each.how))
      return;
    const auto found = object_in(each, "report");
    const auto no = number(found, "report_no");
    if (!no)
      return;
    const report told{text(found, "mission_id"),
                      *no,
                      number(found, "generation").value_or(0),
                      number(found, "revision").value_or(0),
                      text(found, "kind"),
                      found.dump()};
    if (missions_.size() < max_missions || missions_.contains(told.mission))
      look(told, missions_[told.mission], each);
  }

protected:
  virtual void look(const report& told, State& known, const delivery& each) = 0;
  virtual void continue_after(const service_word& told, State& known, const delivery& each) = 0;

private:
  static service_word word_in(const json& earlier) {
    const auto last = earlier.find("last_report");
    return {number(earlier, "last_report_no").value_or(0),
            last != earlier.end() && last->is_object() ? number(*last, "generation").value_or(0) : 0};
  }

  // Fetched: its reports go on after those of this journal and of the service.
  void look_at_mission(const delivery& each) {
    const auto whole = object_in(each);
    const auto known_upto = number(whole, "last_report_no");
    if (text(whole, "cause") != "fetched" || !known_upto)
      return;
    auto told = word_in(object_in(each, "earlier"));
    told.last_report_no = *known_upto;
    go_on(text(object_in(each, "document"), "mission_id"), told, each);
  }

  void look_at_older_journal(const delivery& each) {
    const auto mission = text(object_in(each), "mission_id");
    go_on(mission, word_in(object_in(each, "earlier")), each);
    withdraw([&](const finding& one) { return one.run == each.run && one.what.find(mission) != std::string::npos; });
  }

  void go_on(const std::string& mission, const service_word& told, const delivery& each) {
    if (const auto found = missions_.find(mission); found != missions_.end())
      continue_after(told, found->second, each);
  }

  // After a crash the report may be durable already: it does not come again then, or as a repetition.
  static bool has_come(outcome how) {
    return how == outcome::handled || how == outcome::crashed || how == outcome::repetition;
  }

  known_name type_{"mission_client.report_progress"};
  known_name loaded_{"mission_client.mission_loaded"};
  known_name found_{"mission_client.earlier_found"};
  std::map<std::string, State> missions_;
};

struct told_reports {
  std::uint64_t last = 0; // 0: none yet; a trace may begin in the middle
  std::string whole;      // of the last; empty: it is the service's, and not known
  std::uint64_t id = 0;
  std::uint64_t run = 0;
  std::uint64_t newest_run = 0;
  std::uint64_t last_in_newest = 0; // that was told in it
};

class reports_without_gap final : public about_reports<told_reports> {
  void look(const report& told, told_reports& known, const delivery& each) override {
    if (known.last != 0 && told.number > known.last + 1)
      find(known.run == each.run ? certainty::if_complete : certainty::across_runs, each, {known.id, each.id},
           "report " + std::to_string(told.number) + " of mission " + told.mission + " came after report " +
               std::to_string(known.last));
    if (told.number == known.last && told.whole != known.whole && !known.whole.empty())
      find(certainty::certain, each, {known.id, each.id},
           "there are two different reports " + std::to_string(told.number) + " of mission " + told.mission);
    const auto in_run = std::max(last_in(each.run, known), told.number);
    if (told.number >= known.last)
      known = {told.number, told.whole, each.id, each.run};
    known.newest_run = each.run;
    known.last_in_newest = in_run;
  }
  void continue_after(const service_word& told, told_reports& known, const delivery& each) override {
    if (told.last_report_no >= known.last)
      return;
    const auto in_run = last_in(each.run, known);
    known = {std::max(told.last_report_no, in_run), {}, each.id, each.run, each.run, in_run};
  }
  static std::uint64_t last_in(std::uint64_t run, const told_reports& known) {
    return known.newest_run == run ? known.last_in_newest : 0;
  }
};

struct completion {
  std::uint64_t at = 0; // number of the report; 0: not complete
  std::uint64_t revision = 0;
  std::uint64_t id = 0;
};

class complete_once final : public about_reports<completion> {
  void look(const report& told, completion& known, const delivery& each) override {
    const bool is_newer = told.revision > known.revision; // the service has sent it further
    if (known.at != 0 && told.number > known.at && !is_newer)
      find(certainty::certain, each, {known.id, each.id},
           "mission " + told.mission + " was complete with report " + std::to_string(known.at) + ", and report " +
               std::to_string(told.number) + " (" + told.kind + ") came after it");
    if (told.kind == "complete" && (known.at == 0 || is_newer))
      known = {told.number, told.revision, each.id};
  }
  void continue_after(const service_word& told, completion& known, const delivery&) override {
    if (told.last_report_no < known.at)
      known = {};
  }
};

struct newest_generation {
  std::uint64_t generation = 0;
  std::uint64_t number = 0; // of its report
  std::uint64_t id = 0;
};

class generation_never_falls final : public about_reports<newest_generation> {
  void look(const report& told, newest_generation& known, const delivery& each) override {
    if (told.number > known.number && told.generation < known.generation)
      find(certainty::certain, each, {known.id, each.id},
           "report " + std::to_string(told.number) + " of mission " + told.mission + " is of generation " +
               std::to_string(told.generation) + ", after generation " + std::to_string(known.generation));
    if (told.number > known.number)
      known = {told.generation, told.number, each.id};
  }
  void continue_after(const service_word& told, newest_generation& known, const delivery& each) override {
    if (told.last_report_no < known.number || told.generation > known.generation)
      known = {told.generation, told.last_report_no, each.id};
  }
};

// The failsafe is given the fences of a plan before the plan is. A revision that the record does not show has those of
// the newest before it: an assignment changes no fences.
class guarded_by_its_fences final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (each.how != outcome::handled)
      return;
    if (loaded_.is(each.type, names)) {
      note_mission(object_in(each, "document"));
    } else if (guard_.is(each.type, names)) {
      guarded_by_ = object_in(each).value("geofences", json()).dump();
      guard_id_ = each.id;
    } else if (report_.is(each.type, names)) {
      look(object_in(each, "report"), each);
    }
  }

private:
  using fences_by_revision = std::map<std::uint64_t, std::string>;

  void note_mission(const json& document) {
    const auto id = text(document, "mission_id");
    const auto revision = number(document, "revision");
    if (revision && (missions_.size() < max_missions || missions_.contains(id)))
      missions_[id][*revision] = document.value("geofences", json()).dump();
  }

  void look(const json& report, const delivery& each) {
    const auto mission = missions_.find(text(report, "mission_id"));
    const auto kind = text(report, "kind");
    const bool is_of_flight = kind == "started" || kind == "reached";
    if (!is_of_flight || mission == missions_.end() || guarded_by_.empty())
      return;
    auto from = mission->second.upper_bound(number(report, "revision").value_or(0));
    if (from != mission->second.begin())
      --from;
    const bool is_guarded =
        std::any_of(from, mission->second.end(), [&](const auto& revision) { return revision.second == guarded_by_; });
    if (!is_guarded)
      find(certainty::if_complete, each, {guard_id_, each.id},
           "mission " + mission->first + " is flown, and the failsafe was given other fences than it has");
  }

  known_name loaded_{"mission_client.mission_loaded"};
  known_name guard_{"failsafe.guard_mission"};
  known_name report_{"mission_client.report_progress"};
  std::map<std::string, fences_by_revision> missions_;
  std::string guarded_by_; // empty: not seen yet
  std::uint64_t guard_id_ = 0;
};

// True for what makes a vehicle that stands begin to move.
bool starts_a_vehicle(const json& command) {
  const auto which = number(command, "command");
  const auto is = [&](io::mavlink::mav_cmd expected) { return which == static_cast<std::uint64_t>(expected); };
  const auto first = command.find("param1");
  const bool has_one = first != command.end() && first->is_number() && first->get<double>() == 1;
  return is(io::mavlink::mav_cmd::mission_start) || (is(io::mavlink::mav_cmd::component_arm_disarm) && has_one) ||
         is(io::mavlink::mav_cmd::nav_takeoff);
}

// For what looks at the commands of the executor that start a vehicle.
class about_starts : public invariant {
public:
  void take(const delivery& each, const name_table& names) final {
    if (each.run != run_) {
      run_ = each.run;
      forget();
    }
    if (executor_.is(each.actor, names)) {
      look_at_executor(each, names);
    } else if (link_.is(each.actor, names) && command_.is(each.type, names) && executor_.is(each.sender, names) &&
               each.how == outcome::handled && starts_a_vehicle(object_in(each))) {
      look_at_start(each);
    }
  }

protected:
  virtual void forget() = 0; // another run begins
  virtual void look_at_executor(const delivery& each, const name_table& names) = 0;
  virtual void look_at_start(const delivery& each) = 0;

private:
  known_name executor_{"executor"};
  known_name link_{"vehicle_link"};
  known_name command_{"vehicle_link.send_command"};
  std::uint64_t run_ = 0;
};

// The executor knows of the pilot from `failsafe_status` on; what it sent because of earlier messages may still be on
// its way.
class pilot_is_left_alone final : public about_starts {
  void forget() override { flight_ = {}; }
  void look_at_executor(const delivery& each, const name_table& names) override {
    if (flight_.pilot_since_id != 0 && flight_.after_takeover.size() < max_after_takeover)
      flight_.after_takeover.insert(each.id);
    if (!failsafe_status_.is(each.type, names) || each.how != outcome::handled)
      return;
    const bool is_taken = flag(object_in(each), "taken_over");
    if (is_taken && flight_.pilot_since_id == 0)
      flight_.pilot_since_id = each.id;
    if (!is_taken)
      flight_ = {};
  }
  void look_at_start(const delivery& each) override {
    if (flight_.pilot_since_id != 0 && flight_.after_takeover.contains(each.cause))
      find(certainty::if_complete, each, {flight_.pilot_since_id, each.cause, each.id},
           "the executor commanded a start although it knew that a pilot has the vehicle");
  }

  static constexpr std::size_t max_after_takeover = 1'000'000;
  struct takeover {
    std::uint64_t pilot_since_id = 0;            // of the failsafe_status that told it; 0: no pilot
    std::set<std::uint64_t> after_takeover = {}; // what the executor took later
  };
  takeover flight_;
  known_name failsafe_status_{"failsafe.stance"};
};

// An incarnation begins with a `runtime.durable` of its own; later ones tell that a write is on the disk.
class restart_starts_nothing final : public about_starts {
  void forget() override {
    newest_ = 0;
    begins_.clear();
  }
  void look_at_executor(const delivery& each, const name_table& names) override {
    if (!begin_.is(each.type, names) || each.incarnation <= newest_)
      return;
    newest_ = each.incarnation;
    begins_.insert(each.id);
  }
  void look_at_start(const delivery& each) override {
    if (begins_.contains(each.cause))
      find(certainty::if_complete, each, {each.cause, each.id},
           "an incarnation of the executor commanded a start because it began");
  }

  known_name begin_{"runtime.durable"};
  std::uint32_t newest_ = 0; // incarnation that was seen to begin
  std::set<std::uint64_t> begins_;
};

class latch_holds final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (each.run != run_) {
      run_ = each.run;
      latched_.clear();
    }
    if (failsafe_.is(each.actor, names) && (hand_back_.is(each.type, names) || override_.is(each.type, names)))
      latched_.clear();
    if (!executor_.is(each.actor, names) || !failsafe_status_.is(each.type, names) || each.how != outcome::handled)
      return;
    const auto failsafe_status = object_in(each);
    std::set<std::string> now;
    if (const auto list = failsafe_status.find("latched"); list != failsafe_status.end() && list->is_array())
      for (const auto& one : *list)
        if (one.is_string())
          now.insert(one.get<std::string>());
    if (flag(failsafe_status, "in_flight") && !std::ranges::includes(now, latched_))
      find(certainty::if_complete, each, {failsafe_status_id_, each.id},
           "a rule of the failsafe that had acted was free again in the same flight");
    latched_ = flag(failsafe_status, "in_flight") ? now : std::set<std::string>();
    failsafe_status_id_ = each.id;
  }

private:
  known_name failsafe_{"failsafe"};
  known_name executor_{"executor"};
  known_name failsafe_status_{"failsafe.stance"};
  known_name hand_back_{"failsafe.hand_back"};
  known_name override_{"failsafe.override_rule"};
  std::uint64_t run_ = 0;
  std::set<std::string> latched_;
  std::uint64_t failsafe_status_id_ = 0;
};

} // namespace

std::unique_ptr<invariant> make_reports_without_gap() { return std::make_unique<reports_without_gap>(); }
std::unique_ptr<invariant> make_complete_once() { return std::make_unique<complete_once>(); }
std::unique_ptr<invariant> make_generation_never_falls() { return std::make_unique<generation_never_falls>(); }
std::unique_ptr<invariant> make_guarded_by_its_fences() { return std::make_unique<guarded_by_its_fences>(); }
std::unique_ptr<invariant> make_pilot_is_left_alone() { return std::make_unique<pilot_is_left_alone>(); }
std::unique_ptr<invariant> make_restart_starts_nothing() { return std::make_unique<restart_starts_nothing>(); }
std::unique_ptr<invariant> make_latch_holds() { return std::make_unique<latch_holds>(); }

} // namespace godwit::invariants
