// An actor throws once: the flight goes on, and nothing is lost, doubled, armed or started because of it.
#include <array>
#include <random>
#include <utility>

#include "programs/godwit-drill/flights/disturbed_flight.hpp"
#include "programs/godwit-drill/flights/flight_case.hpp"
#include "runtime/crash_points.hpp"

namespace godwit::drill {

namespace {

using runtime::crash_point;

struct named_point {
  crash_point point;
  const char* name;
};
constexpr std::array points{named_point{crash_point::before_handler, "before_handler"},
                            named_point{crash_point::after_handler, "after_handler"},
                            named_point{crash_point::after_commit, "after_commit"},
                            named_point{crash_point::before_dispatch, "before_dispatch"}};

struct actor_crash {
  const char* actor;
  crash_point at;
};

// From the throw until the successor takes a message. Nothing: it has not thrown, or there is no successor.
std::optional<double> recovery_ms(flight_simulation& flight, const actor_crash& what) {
  constexpr double most_s = 20; // that it takes to pass the point, and to come back
  auto* process = flight.process();
  const auto before = process->crashes(what.actor);
  const auto incarnation = flight.record().incarnation_of(what.actor);
  process->crash_at(what.actor, what.at);
  const auto has_thrown = [&] { return flight.process() != process || process->crashes(what.actor) > before; };
  if (!flight.run_until(has_thrown, most_s) || flight.process() != process)
    return std::nullopt;
  const auto since_ns = flight.now_ns();
  if (!flight.run_until([&] { return flight.record().incarnation_of(what.actor) > incarnation; }, most_s))
    return std::nullopt;
  return static_cast<double>(flight.now_ns() - since_ns) * 1e-6;
}

std::string crash(watched_flight& watched, const actor_crash& what) {
  const auto took_ms = recovery_ms(watched.flight(), what);
  if (!took_ms)
    return "it did not pass this point";
  ++watched.so_far().crashes;
  watched.note_recovery(*took_ms);
  return {};
}

} // namespace

std::vector<flight_case> actor_cases(vehicles which) {
  std::vector<flight_case> result;
  for (const auto who : which)
    for (const auto part : flight_parts)
      for (const auto* actor : actor_names)
        for (const auto& at : points)
          result.push_back(case_of({.wanted = {.who = who},
                                    .part = part,
                                    .what = std::string(actor) + "/" + at.name,
                                    .disturb = [what = actor_crash{actor, at.point}](watched_flight& watched) {
                                      return crash(watched, what);
                                    }}));
  return result;
}

// More than one throw: two actors end at once, an actor ends again at each start until it is given up, and one hangs in
// a handler. Nothing is lost, doubled, armed or started because of it.

namespace {

// Until ACTOR takes messages again after BEFORE, or the process is another one.
bool is_back_within(flight_simulation& flight, const std::string& actor, std::uint32_t before, double most_s) {
  const auto processes = flight.processes();
  return flight.run_until(
      [&] {
        return (flight.processes() > processes && flight.record().incarnation_of(actor) > 0) ||
               flight.record().incarnation_of(actor) > before;
      },
      most_s);
}

std::string end_both(watched_flight& watched, const std::string& one, const std::string& other) {
  constexpr double back_within_s = 5;
  auto& flight = watched.flight();
  auto* process = flight.process();
  const auto one_before = flight.record().incarnation_of(one);
  const auto other_before = flight.record().incarnation_of(other);
  if (process == nullptr || !process->kill(one) || !process->kill(other))
    return "one of them did not run";
  watched.so_far().crashes += 2;
  const auto since_ns = flight.now_ns();
  const bool are_back = is_back_within(flight, one, one_before, back_within_s) &&
                        is_back_within(flight, other, other_before, back_within_s);
  watched.expect(are_back ? "" : "the two were not back within 5 s");
  watched.note_recovery_since(since_ns);
  return {};
}

// In flight the others go on without it. On the ground the checks say that it is given up, until a person starts
// godwitd again.
std::string give_up(watched_flight& watched, const std::string& actor) {
  constexpr double said_within_s = 5;
  auto& flight = watched.flight();
  if (!flight.give_up(actor))
    return "it can not be given up here";
  flight.run_for(said_within_s);
  const bool is_gone =
      flight.process() != nullptr && flight.process()->look_at(actor).phase == runtime::child_phase::given_up;
  if (!is_gone || flight.status().in_flight)
    return {};
  watched.expect(flight.was_told(actor) ? "" : "nobody was notified that " + actor + " is given up");
  flight.kill_process();
  return {};
}

// The guardian leaves the hanging incarnation behind, or the process ends; then somebody does its work again.
std::string hang(watched_flight& watched, const std::string& actor) {
  constexpr double back_within_s = 30;
  auto& flight = watched.flight();
  auto* process = flight.process();
  if (process == nullptr)
    return "there is no process";
  const auto before = flight.record().incarnation_of(actor);
  const auto since_ns = flight.now_ns();
  process->hang(actor);
  watched.expect(is_back_within(flight, actor, before, back_within_s) ? "" : actor + " was not back within 30 s");
  watched.note_recovery_since(since_ns);
  return {};
}

} // namespace

std::vector<flight_case> actor_loss_cases(vehicles which) {
  std::vector<flight_case> result;
  for (const auto who : which)
    for (const auto part : flight_parts) {
      const auto add = [&](const std::string& what, const char* row, std::function<std::string(watched_flight&)> make,
                           flight_end end = flight_end::as_planned) {
        result.push_back(case_of({.wanted = slow_flight(who),
                                  .part = part,
                                  .what = what,
                                  .row = row,
                                  .end = end,
                                  .disturb = std::move(make)}));
      };
      for (std::size_t i = 0; i < actor_names.size(); ++i) {
        const std::string one = actor_names.at(i);
        for (std::size_t k = i + 1; k < actor_names.size(); ++k) {
          const std::string other = actor_names.at(k);
          add(one + "+" + other + "/at_once", "at_once",
              [=](watched_flight& watched) { return end_both(watched, one, other); });
        }
        // Without ground_port no station is heard, and the failsafe brings the vehicle home: once, until it is handed
        // back.
        const auto end =
            one == "ground_port" && who == sim::personality::plane ? flight_end::or_waits : flight_end::as_planned;
        add(
            one + "/given_up", "given_up", [=](watched_flight& watched) { return give_up(watched, one); }, end);
        add(one + "/hangs", "hangs", [=](watched_flight& watched) { return hang(watched, one); });
      }
    }
  return result;
}

// The process ends as by SIGKILL at moments that their seeds draw, and again and again for a minute: as soon as each
// has run for 200 ms, the next one has 300 ms to begin.

namespace {

constexpr std::uint64_t moments = 500; // of all vehicles together
constexpr double storm_s = 60;
constexpr double lives_s = 0.2;

flight_case killed_at_moment(sim::personality who, std::uint64_t seed, double flown_s) {
  const auto group = row_of(who, "moments");
  const auto name = group + "/" + std::to_string(seed);
  return {name, group, [=](const flight_wishes& wishes) {
            watched_flight watched({.who = who, .seed = seed}, wishes, name, group);
            std::mt19937_64 drawn(seed);
            watched.flight().run_for(flown_s * std::uniform_real_distribution<double>(0, 1)(drawn));
            if (executor::is_at_rest(watched.flight().status().now)) // in another order of events it is shorter
              watched.so_far().skipped = "the flight is over by then";
            watched.flight().kill_process();
            return watched.finish();
          }};
}

// The guard keeps the process from beginning after a hundred ends on the ground; then a person takes its file away.
std::string storm(watched_flight& watched) {
  auto& flight = watched.flight();
  const auto end_ns = flight.now_ns() + static_cast<std::int64_t>(storm_s * 1e9);
  while (flight.now_ns() < end_ns) {
    if (!flight.run_until([&] { return flight.process() != nullptr; }, 1))
      continue;
    flight.run_for(lives_s);
    flight.kill_process();
  }
  flight.forget_abnormal_ends();
  return {};
}

} // namespace

std::vector<flight_case> kill_cases(vehicles which, std::span<const double> flown_s) {
  std::vector<flight_case> result;
  for (std::size_t i = 0; i < which.size(); ++i) {
    const auto who = which[i];
    for (std::uint64_t seed = 1; seed <= moments / which.size(); ++seed)
      result.push_back(killed_at_moment(who, seed, flown_s[i]));
    for (const auto part : flight_parts)
      result.push_back(case_of(
          {.wanted = slow_flight(who), .part = part, .what = "killed_each_200ms", .row = "storms", .disturb = storm}));
  }
  return result;
}

} // namespace godwit::drill
