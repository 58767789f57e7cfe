// Each promise is looked for in a record that keeps all of them, and in one in which exactly this one is broken.
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "invariants/checker.hpp"
#include "io/fields/json_text.hpp"
#include "runtime/address/address_options.hpp"

namespace godwit::invariants {
namespace planted_violations_test {

using runtime::delivery;
using runtime::name_table;
using runtime::outcome;

struct row {
  std::int64_t at_ms = 0;
  std::string actor;
  std::string type;
  std::uint64_t id = 0;
  std::uint64_t cause = 0;
  std::string sender = "outside";
  std::string body = "{}";
  std::uint32_t incarnation = 1;
  outcome how = outcome::handled;
  std::uint64_t run = 1;
};

std::string report_text(int number, const std::string& kind, int generation) {
  return R"({"mission_id":"m","generation":)" + std::to_string(generation) + R"(,"report_no":)" +
         std::to_string(number) + R"(,"kind":")" + kind + R"("})";
}

runtime::outbox_row row_of_report(const std::string& key, int number, const std::string& kind) {
  return {.idempotency_key = key,
          .destination = "progress",
          .body = R"({"mission_id":"m","posted":)" + report_text(number, kind, 2) + "}",
          .created_ns = 21'500'000'000,
          .last_error = {}};
}

// Of a flight that ended later than the record.
journal_record sound_journal() { return {{row_of_report("a", 2, "reached")}, {{"m", 100}}, {}, {}}; }

struct record : std::vector<row> {
  using vector::vector;
  journal_record journal = sound_journal();
};

row report(std::int64_t at_ms, int number, const std::string& kind, int generation = 1) {
  return {.at_ms = at_ms,
          .actor = "mission_client",
          .type = "mission_client.report_progress",
          .id = static_cast<std::uint64_t>(1000 + at_ms),
          .sender = "executor",
          .body = R"({"report":)" + report_text(number, kind, generation) + "}"};
}

row failsafe_status(std::int64_t at_ms, std::uint64_t id, bool is_taken, const std::string& latched) {
  return {.at_ms = at_ms,
          .actor = "executor",
          .type = "failsafe.stance",
          .id = id,
          .sender = "failsafe",
          .body = std::string(R"({"in_flight":true,"taken_over":)") + (is_taken ? "true" : "false") +
                  R"(,"latched":[)" + latched + "]}"};
}

row start_command(std::int64_t at_ms, std::uint64_t id, std::uint64_t cause) {
  return {.at_ms = at_ms,
          .actor = "vehicle_link",
          .type = "vehicle_link.send_command",
          .id = id,
          .cause = cause,
          .sender = "executor",
          .body = R"({"command":300,"param1":0.0})"};
}

row mission_loaded(std::uint64_t id, int revision, const std::string& fences) {
  return {.at_ms = 16,
          .actor = "executor",
          .type = "mission_client.mission_loaded",
          .id = id,
          .sender = "mission_client",
          .body = R"({"document":{"mission_id":"m","revision":)" + std::to_string(revision) + R"(,"geofences":[)" +
                  fences + "]}}",
          .incarnation = 2};
}

row guard(std::uint64_t id, const std::string& fences) {
  return {.at_ms = 17,
          .actor = "failsafe",
          .type = "failsafe.guard_mission",
          .id = id,
          .sender = "executor",
          .body = R"({"geofences":[)" + fences + "]}"};
}

// Two a minute at most.
row point_shown(std::int64_t at_ms, std::uint64_t id, int number, int shown_s) {
  return {.at_ms = at_ms,
          .actor = "executor",
          .type = "scan_controller.point_shown",
          .id = id,
          .sender = "scan_controller",
          .body = R"({"most_a_minute":2,"number":)" + std::to_string(number) + R"(,"shown_ns":)" +
                  std::to_string(shown_s) + "000000000}",
          .incarnation = 2};
}

row point_closed(std::int64_t at_ms, std::uint64_t id, int number, const std::string& outcome) {
  return {.at_ms = at_ms,
          .actor = "executor",
          .type = "scan_controller.point_closed",
          .id = id,
          .sender = "scan_controller",
          .body = R"({"number":)" + std::to_string(number) + R"(,"outcome":")" + outcome + "\"}",
          .incarnation = 2};
}

// After the start, in front of the reports.
void insert_before_reports(record& to, const record& rows) { to.insert(to.begin() + 7, rows.begin(), rows.end()); }

// A flight in which all is as promised: a start by a word, a crash that is put back, a pilot, the end.
record sound_record() {
  return {
      {.at_ms = 0, .actor = "executor", .type = "runtime.durable", .id = 1, .sender = "executor"},
      {.at_ms = 10, .actor = "executor", .type = "operator.word", .id = 2},
      {.at_ms = 11, .actor = "executor", .type = "runtime.durable", .id = 8, .sender = "executor"},
      start_command(12, 3, 8),
      {.at_ms = 13,
       .actor = "executor",
       .type = "tick",
       .id = 4,
       .cause = 1,
       .sender = "executor",
       .how = outcome::crashed},
      {.at_ms = 14, .actor = "executor", .type = "runtime.durable", .id = 5, .sender = "executor", .incarnation = 2},
      {.at_ms = 14, .actor = "executor", .type = "tick", .id = 4, .cause = 1, .sender = "executor", .incarnation = 2},
      report(20, 1, "started"),
      report(21, 2, "reached", 2),
      [] {
        auto each = failsafe_status(30, 6, true, "\"fence\"");
        each.incarnation = 2;
        return each;
      }(),
      [] {
        auto each = failsafe_status(31, 7, true, R"("fence","operator_link")");
        each.incarnation = 2;
        return each;
      }(),
      report(40, 3, "complete", 2),
  };
}

std::map<std::string, verdict> judge(const record& rows, const std::vector<std::uint64_t>& holes = {},
                                     bool has_journal = true) {
  name_table names;
  checker all;
  for (const auto& each : rows)
    all.take({.run = each.run,
              .id = each.id,
              .cause = each.cause,
              .began_ns = each.at_ms * 1'000'000'000,
              .duration_ns = 1'000,
              .actor = names.number(each.actor),
              .sender = names.number(each.sender),
              .type = names.number(each.type),
              .incarnation = each.incarnation,
              .how = each.how,
              .body = each.body},
             names);
  for (const auto each : holes)
    all.note_hole(each);
  if (has_journal)
    all.take_journal(rows.journal);
  std::map<std::string, verdict> result;
  for (const auto& each : all.judge())
    result[std::string(each.which->name)] = each.how;
  return result;
}

std::map<std::string, verdict> all_held() {
  std::map<std::string, verdict> result;
  for (const auto& each : all_rules())
    result[std::string(each.name)] = verdict::held;
  return result;
}

// By the name of a rule: what breaks it, and no other.
const std::map<std::string, std::function<void(record&)>>& plants() {
  static const std::map<std::string, std::function<void(record&)>> all{
      {"cause_before_effect",
       [](record& r) {
         r.push_back({.at_ms = 41, .actor = "failsafe", .type = "t", .id = 50, .cause = 3, .sender = "executor"});
       }},
      {"one_handler_at_a_time",
       [](record& r) { // the second is given as if the clock stood still
         r.push_back({.at_ms = 50, .actor = "failsafe", .type = "t", .id = 51, .sender = "outside"});
         r.push_back({.at_ms = 45, .actor = "failsafe", .type = "t", .id = 52, .sender = "outside"});
       }},
      {"incarnations_rise",
       [](record& r) {
         r.push_back(
             {.at_ms = 41, .actor = "executor", .type = "t", .id = 53, .incarnation = 1, .how = outcome::repetition});
       }},
      {"crash_ends_incarnation",
       [](record& r) {
         r.push_back({.at_ms = 41, .actor = "failsafe", .type = "t", .id = 54, .how = outcome::crashed});
         r.push_back({.at_ms = 42, .actor = "failsafe", .type = "t", .id = 55});
       }},
      {"handled_once",
       [](record& r) {
         r.push_back({.at_ms = 41, .actor = "failsafe", .type = "t", .id = 56});
         r.push_back({.at_ms = 42, .actor = "failsafe", .type = "t", .id = 56});
       }},
      {"reports_without_gap", [](record& r) { r[8] = report(21, 1, "reached", 2); }},
      {"complete_once", [](record& r) { r.push_back(report(41, 4, "reached", 2)); }},
      {"generation_never_falls", [](record& r) { r.back() = report(40, 3, "complete", 1); }},
      {"guarded_by_its_fences",
       [](record& r) {
         insert_before_reports(r, {mission_loaded(61, 0, R"({"kind":"INCLUSION"})"), guard(62, "")});
       }},
      {"pilot_is_left_alone", [](record& r) { r.push_back(start_command(41, 58, 7)); }},
      {"restart_starts_nothing", [](record& r) { r.insert(r.begin() + 7, start_command(15, 59, 5)); }},
      {"points_within_rate",
       [](record& r) {
         r.push_back(point_shown(41, 71, 1, 1));
         r.push_back(point_shown(42, 72, 2, 31));
         r.push_back(point_shown(43, 73, 3, 61));
       }},
      {"point_closed_once",
       [](record& r) {
         r.push_back(point_closed(41, 74, 1, "declined"));
         r.push_back(point_closed(42, 75, 1, "confirmed"));
       }},
      {"reports_are_kept", [](record& r) { r.journal.last_reports["m"] = 2; }},
      {"outbox_numbers_once", [](record& r) { r.journal.outbox.push_back(row_of_report("b", 2, "reached")); }},
      {"outbox_was_told", [](record& r) { r.journal.outbox.push_back(row_of_report("c", 5, "reached_too")); }},
      {"given_up_is_written",
       [](record& r) {
         for (std::uint32_t n = 1; n <= runtime::max_crashes; ++n)
           r.push_back({.at_ms = 41 + n,
                        .actor = "failsafe",
                        .type = "t",
                        .id = 80,
                        .incarnation = n,
                        .how = outcome::crashed});
         r.push_back({.at_ms = 50, .actor = "failsafe", .type = "t", .id = 81, .incarnation = 4});
       }},
      {"latch_holds",
       [](record& r) {
         auto each = failsafe_status(32, 60, true, "\"operator_link\"");
         each.incarnation = 2;
         r.insert(r.end() - 1, each);
       }},
  };
  return all;
}

TEST(invariants, a_sound_record_keeps_all_promises) { EXPECT_EQ(judge(sound_record()), all_held()); }

TEST(invariants, each_has_a_requirement_and_a_planted_violation) {
  for (const auto& each : all_rules()) {
    EXPECT_TRUE(plants().contains(std::string(each.name))) << each.name;
    EXPECT_FALSE(each.requirement.empty());
    EXPECT_TRUE(each.where.starts_with("docs/")) << each.name;
  }
  EXPECT_EQ(plants().size(), all_rules().size());
}

TEST(invariants, a_planted_violation_is_found_and_breaks_no_other_promise) {
  for (const auto& [name, plant] : plants()) {
    auto broken = sound_record();
    plant(broken);
    auto expected = all_held();
    expected[name] = verdict::violated;
    EXPECT_EQ(judge(broken), expected) << name;
  }
}

TEST(invariants, a_record_without_a_message_decides_nothing) {
  for (const auto& each : checker().judge())
    EXPECT_EQ(each.how, verdict::undecided) << each.which->name;
}

TEST(invariants, what_is_promised_of_the_journal_is_undecided_without_one) {
  const auto verdicts = judge(sound_record(), {}, false);
  for (const auto& each : all_rules())
    EXPECT_EQ(verdicts.at(std::string(each.name)), each.asks_journal ? verdict::undecided : verdict::held) << each.name;
}

TEST(invariants, a_report_that_the_executor_still_owes_is_not_lost) {
  auto owed = sound_record();
  plants().at("reports_are_kept")(owed);
  owed.journal.owed.push_back(
      {{7, 0}, "mission_client.report_progress", R"({"report":)" + report_text(3, "complete", 2) + "}"});
  EXPECT_EQ(judge(owed), all_held());
}

TEST(invariants, a_message_among_the_dead_letters_was_given_up_rightly_and_a_kill_explains_that_it_is_not_there) {
  auto given_up = sound_record();
  plants().at("given_up_is_written")(given_up);
  runtime::dead_letter letter;
  letter.message_id = 80;
  letter.at_ns = 45'000'000'000;
  given_up.journal.given_up.push_back({"failsafe", letter});
  EXPECT_EQ(judge(given_up), all_held());
  auto killed = sound_record();
  plants().at("given_up_is_written")(killed);
  killed.pop_back();
  EXPECT_EQ(judge(killed).at("given_up_is_written"), verdict::undecided);
}

TEST(invariants, a_point_told_again_is_no_other_point_and_another_boot_has_other_times) {
  auto sound = sound_record();
  for (const auto& each : {point_shown(41, 71, 1, 100), point_shown(42, 72, 2, 110), point_shown(43, 73, 2, 110),
                           point_shown(44, 74, 3, 161), point_shown(45, 75, 4, 5), point_closed(46, 76, 1, "declined"),
                           point_closed(47, 77, 1, "declined")})
    sound.push_back(each);
  EXPECT_EQ(judge(sound), all_held());
}

TEST(invariants, what_is_missing_leaves_undecided_what_is_not_certain) {
  EXPECT_EQ(judge(sound_record(), {1}).at("complete_once"), verdict::undecided) << "nothing found, something missing";
  auto gap = sound_record();
  gap.erase(gap.begin() + 8); // report 2
  EXPECT_EQ(judge(gap).at("reports_without_gap"), verdict::violated);
  EXPECT_EQ(judge(gap, {1}).at("reports_without_gap"), verdict::undecided);
  EXPECT_EQ(judge(gap, {2}).at("reports_without_gap"), verdict::violated) << "the hole is elsewhere";
  auto behind = sound_record();
  plants().at("complete_once")(behind);
  EXPECT_EQ(judge(behind, {1}).at("complete_once"), verdict::violated) << "certain, whatever is missing";
}

TEST(invariants, a_kill_between_two_reports_explains_a_gap) {
  auto gap = sound_record();
  gap.erase(gap.begin() + 8);
  gap.back().run = 2;
  EXPECT_EQ(judge(gap).at("reports_without_gap"), verdict::undecided);
}

// What flights of godwit-drill have shown to be sound.
TEST(invariants, a_report_whose_handler_crashed_may_be_durable_and_not_come_again) {
  auto crashed = sound_record();
  crashed[8].how = outcome::crashed; // report 2
  EXPECT_EQ(judge(crashed).at("reports_without_gap"), verdict::held);
}

TEST(invariants, a_mission_that_was_complete_goes_on_with_a_newer_revision) {
  auto further = sound_record();
  auto next = report(41, 4, "started", 3);
  next.body.insert(next.body.find("\"generation\""), "\"revision\":2,");
  further.push_back(next);
  EXPECT_EQ(judge(further), all_held());
}

TEST(invariants, a_flight_may_be_guarded_by_the_fences_of_a_newer_revision_and_not_of_an_older_one) {
  const std::string first = R"({"kind":"INCLUSION"})";
  const std::string second = R"({"kind":"EXCLUSION"})";
  auto ahead = sound_record(); // its reports are of revision 0
  insert_before_reports(ahead, {mission_loaded(61, 0, first), mission_loaded(62, 1, second), guard(63, second)});
  EXPECT_EQ(judge(ahead).at("guarded_by_its_fences"), verdict::held);
  for (auto& each : ahead)
    if (const auto at = each.body.find("\"generation\""); at != std::string::npos)
      each.body.insert(at, "\"revision\":2,"); // an assignment's
  EXPECT_EQ(judge(ahead).at("guarded_by_its_fences"), verdict::held) << "it has the fences of the one before";
  for (auto& each : ahead)
    if (each.type == "failsafe.guard_mission")
      each.body = guard(63, first).body;
  EXPECT_EQ(judge(ahead).at("guarded_by_its_fences"), verdict::violated);
}

row fetched(std::int64_t at_ms, int last_report_no, std::uint64_t run) {
  return {.at_ms = at_ms,
          .actor = "executor",
          .type = "mission_client.mission_loaded",
          .id = 80,
          .sender = "mission_client",
          .body = R"({"cause":"fetched","document":{"mission_id":"m"},"last_report_no":)" +
                  std::to_string(last_report_no) + "}",
          .run = run};
}

row older_journal_found(std::int64_t at_ms, int last_report_no, int generation, std::uint64_t run) {
  return {.at_ms = at_ms,
          .actor = "executor",
          .type = "mission_client.earlier_found",
          .id = 81,
          .sender = "mission_client",
          .body = R"({"mission_id":"m","earlier":{"last_report_no":)" + std::to_string(last_report_no) +
                  R"(,"last_report":{"generation":)" + std::to_string(generation) + "}}}",
          .run = run};
}

row report_in(std::uint64_t run, std::int64_t at_ms, int number, const std::string& kind, int generation) {
  auto result = report(at_ms, number, kind, generation);
  result.run = run;
  return result;
}

// The complete report 3 of the first run has never reached the service.
TEST(invariants, what_was_lost_with_its_journal_before_the_service_had_it_has_not_been_told) {
  auto lost = sound_record();
  lost.push_back(fetched(50, 2, 2));
  lost.push_back(report_in(2, 51, 3, "started", 3));
  EXPECT_EQ(judge(lost), all_held());
  auto kept = sound_record();
  kept.push_back(fetched(50, 3, 2));
  kept.push_back(report_in(2, 51, 3, "started", 3));
  EXPECT_EQ(judge(kept).at("reports_without_gap"), verdict::violated) << "a journal that has all has none twice";
}

TEST(invariants, what_an_older_journal_tells_before_it_is_known_as_such_is_numbered_anew) {
  auto older = sound_record();
  older.push_back(report_in(2, 50, 3, "reached", 1));
  EXPECT_EQ(judge(older).at("reports_without_gap"), verdict::violated);
  older.push_back(older_journal_found(51, 2, 2, 2));
  older.push_back(report_in(2, 52, 4, "complete", 2));
  EXPECT_EQ(judge(older), all_held());
  older.push_back(report_in(2, 53, 4, "reached", 2));
  EXPECT_EQ(judge(older).at("reports_without_gap"), verdict::violated) << "from then on all counts";
}

TEST(invariants, a_question_that_fails_is_told_under_its_own_id_and_causes_what_comes_of_it) {
  auto failed = sound_record();
  failed.push_back({.at_ms = 41, .actor = "vehicle_link", .type = "t", .id = 70, .sender = "executor"});
  failed.push_back({.at_ms = 42,
                    .actor = "executor",
                    .type = "runtime.ask_failed",
                    .id = 70,
                    .cause = 70,
                    .sender = "executor",
                    .incarnation = 2});
  failed.push_back({.at_ms = 43, .actor = "failsafe", .type = "t", .id = 71, .cause = 70, .sender = "executor"});
  failed.push_back({.at_ms = 44, .actor = "failsafe", .type = "t", .id = 72, .cause = 70, .sender = "vehicle_link"});
  EXPECT_EQ(judge(failed), all_held());
}

TEST(invariants, ids_begin_again_with_each_run) {
  auto twice = sound_record();
  twice.pop_back(); // the mission is not complete yet
  for (auto each : sound_record()) {
    each.run = 2;
    each.at_ms += 100;
    if (each.type.starts_with("mission_client"))
      continue;
    twice.push_back(each);
  }
  EXPECT_EQ(judge(twice), all_held());
}

} // namespace planted_violations_test
} // namespace godwit::invariants
