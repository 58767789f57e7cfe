// More than one throw: two actors end at once, an actor ends again at each start until it is given up, and one hangs in
// a handler. Nothing is lost, doubled, armed or started because of it.
#include <array>
#include <utility>

#include "programs/godwit-drill/flights/actor_names.hpp"
#include "programs/godwit-drill/flights/disturbed_flight.hpp"

namespace godwit::drill {
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
  watched.expect(flight.was_told(actor) ? "" : "nobody was told that " + actor + " is given up");
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

} // namespace godwit::drill
