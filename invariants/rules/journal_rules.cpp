#include "invariants/rules/rules.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include "invariants/rules/body.hpp"
#include "runtime/address/address_options.hpp"
#include "runtime/content_hash.hpp"

namespace godwit::invariants {

namespace {

using nlohmann::json;
using runtime::delivery;
using runtime::name_table;
using runtime::outcome;

constexpr std::size_t max_missions_kept = 1'000;  // in one trace; later ones are not looked at
constexpr std::size_t max_reports = 200'000;      // the same of reports
constexpr std::size_t max_crashed = 100'000;      // the same of messages that crashed their handler
constexpr std::string_view progress = "progress"; // in the outbox: reports

json object_of(const std::string& body) {
  auto result = json::parse(body, nullptr, false);
  return result.is_object() ? result : json::object();
}

json member_of(const json& of, const char* name) {
  const auto found = of.find(name);
  return found != of.end() && found->is_object() ? *found : json::object();
}

// A report that mission_client has handled is one of the state that is in the journal. One that it was told and has
// lost with a crash is still the executor's to tell again.
class reports_are_kept final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (!type_.is(each.type, names) || each.how != outcome::handled)
      return;
    const auto told = object_in(each, "report");
    const auto mission = text(told, "mission_id");
    const auto no = number(told, "report_no").value_or(0);
    if (missions_.size() >= max_missions_kept && !missions_.contains(mission))
      return;
    auto& newest = missions_[mission];
    if (no >= newest.number)
      newest = {no, each};
    newest.at.body = {}; // it is gone with the next one
  }

  void take_journal(const journal_record& journal) override {
    for (const auto& [mission, newest] : missions_) {
      const auto known = journal.last_reports.find(mission);
      if (known == journal.last_reports.end() || known->second >= newest.number ||
          is_owed(journal, mission, newest.number))
        continue;
      find(certainty::certain, newest.at, {newest.at.id},
           "mission_client took report " + std::to_string(newest.number) + " of mission " + mission +
               ", and its journal ends with report " + std::to_string(known->second));
    }
  }

private:
  struct newest_report {
    std::uint64_t number = 0;
    delivery at;
  };

  static bool is_owed(const journal_record& journal, const std::string& mission, std::uint64_t no) {
    return std::ranges::any_of(journal.owed, [&](const auto& each) {
      const auto told = member_of(object_of(each.body), "report");
      return text(told, "mission_id") == mission && number(told, "report_no") == no;
    });
  }

  known_name type_{"mission_client.report_progress"};
  std::map<std::string, newest_report> missions_;
};

// For what is about the rows of reports in the outbox alone.
delivery at_time(std::int64_t at_ns) {
  delivery result;
  result.began_ns = at_ns;
  return result;
}

class outbox_numbers_once final : public invariant {
public:
  void take(const delivery&, const name_table&) override {}

  void take_journal(const journal_record& journal) override {
    std::map<std::pair<std::string, std::uint64_t>, std::string> seen; // the key, by mission and number
    for (const auto& row : journal.outbox) {
      const auto posted = member_of(object_of(row.body), "posted");
      const auto no = number(posted, "report_no");
      if (row.destination != progress || !no)
        continue;
      const auto [first, is_new] = seen.emplace(std::pair(text(posted, "mission_id"), *no), row.idempotency_key);
      if (!is_new)
        find(certainty::certain, at_time(row.created_ns), {},
             "the outbox has two reports " + std::to_string(*no) + " of mission " + first->first.first + ": " +
                 first->second + " and " + row.idempotency_key);
    }
  }
};

// A row of which the record shows no report: only where the record covers the time in which it was made.
class outbox_was_told final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (run_ != each.run)
      runs_.emplace_back(each.began_ns, each.began_ns);
    run_ = each.run;
    runs_.back().second = each.began_ns;
    if (type_.is(each.type, names) && told_.size() < max_reports)
      told_.insert(content_of(object_in(each, "report")));
  }

  void take_journal(const journal_record& journal) override {
    if (told_.size() >= max_reports)
      return;
    for (const auto& row : journal.outbox) {
      const bool is_covered = std::ranges::any_of(
          runs_, [&](const auto& run) { return run.first < row.created_ns && row.created_ns < run.second; });
      const auto posted = member_of(object_of(row.body), "posted");
      if (row.destination == progress && is_covered && !posted.empty() && !told_.contains(content_of(posted)))
        find(certainty::if_complete, at_time(row.created_ns), {},
             "the outbox has report " + row.idempotency_key + ", and mission_client never received it");
    }
  }

private:
  // mission_client numbers reports for the service, and makes another key with another number.
  static std::uint64_t content_of(json report) {
    report.erase("report_no");
    return runtime::content_hash(report.dump(-1, ' ', false, json::error_handler_t::replace));
  }

  known_name type_{"mission_client.report_progress"};
  std::set<std::uint64_t> told_;
  std::vector<std::pair<std::int64_t, std::int64_t>> runs_; // from, to
  std::uint64_t run_ = 0;
};

// What has crashed its handler so often is not put back any more, and not lost: it is among the dead letters. Where the
// journal took none, it was put back all the same.
class given_up_is_written final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (each.id == 0)
      return;
    const key which{each.run, each.actor, each.id};
    if (each.how == outcome::handled || each.how == outcome::repetition) {
      crashed_.erase(which);
    } else if (each.how == outcome::crashed && (crashed_.size() < max_crashed || crashed_.contains(which))) {
      auto& one = crashed_[which];
      ++one.times;
      one.at = each;
      one.at.body = {};
      one.actor = names.name(each.actor);
      one.is_last = true;
    }
    if (crashed_.empty())
      return;
    auto& newest = newest_[each.actor];
    if (const auto before = crashed_.find(newest); newest != which && before != crashed_.end())
      before->second.is_last = false; // the actor went on after it
    newest = which;
  }

  void take_journal(const journal_record& journal) override {
    for (const auto& [which, one] : crashed_) {
      const bool is_written = std::ranges::any_of(journal.given_up, [&, id = std::get<2>(which)](const auto& each) {
        return each.actor == one.actor && each.letter.message_id == id && each.letter.at_ns >= one.at.began_ns;
      });
      if (one.times >= runtime::max_crashes && !is_written)
        find(one.is_last ? certainty::across_runs : certainty::if_complete, one.at, {one.at.id},
             one.actor + " crashed " + std::to_string(one.times) +
                 " times on a message that was not handled then, and that is not among the dead letters");
    }
  }

private:
  using key = std::tuple<std::uint64_t, std::uint32_t, std::uint64_t>; // run, actor, id
  struct crash {
    int times = 0;
    bool is_last = true; // of what its actor did: the process may have ended before it was written
    delivery at;
    std::string actor;
  };
  std::map<key, crash> crashed_;
  std::map<std::uint32_t, key> newest_; // by actor
};

} // namespace

std::unique_ptr<invariant> make_reports_are_kept() { return std::make_unique<reports_are_kept>(); }
std::unique_ptr<invariant> make_outbox_numbers_once() { return std::make_unique<outbox_numbers_once>(); }
std::unique_ptr<invariant> make_outbox_was_told() { return std::make_unique<outbox_was_told>(); }
std::unique_ptr<invariant> make_given_up_is_written() { return std::make_unique<given_up_is_written>(); }

} // namespace godwit::invariants
