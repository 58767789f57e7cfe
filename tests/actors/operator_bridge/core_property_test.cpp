// Any order of commands, repetitions, changes of control, answers, slow disks and crashes: nothing is handed over
// twice, past a stop, or for who may not; each request is answered once, and a repetition as the first time.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <array>
#include <map>
#include <set>
#include <tuple>

#include "tests/actors/operator_bridge/bridge_world.hpp"

namespace godwit::operator_bridge::tests {
namespace operator_bridge_core_property_test {

using operators::command_kind;
using operators::role;

constexpr std::array kinds{command_kind::start, command_kind::resume, command_kind::check, command_kind::pause,
                           command_kind::come_home};
constexpr std::array acts{control_act::take, control_act::take_over, control_act::give, control_act::hand_over};

class world {
public:
  world() {
    people = {world.log_in("anna"),
              world.log_in("bob"),
              world.log_in("eve", role::viewer),
              world.log_in("chief", role::engineer),
              local(),
              {"mallory", role::engineer, "s77"}};
  }

  void say(int who, int kind, int id) {
    auto m = world.command(people.at(static_cast<std::size_t>(who) % people.size()),
                           kinds.at(static_cast<std::size_t>(kind) % kinds.size()),
                           id % 4 == 0 ? std::string() : "id" + std::to_string(id % 4));
    if (operators::is_stop(m.what.kind) && m.by.name != "mallory" && m.by.name != "eve")
      revoked.insert(world.waiting.begin(), world.waiting.end());
    const auto request = world.say(m);
    said.emplace(request, m);
    open.insert(request);
    look();
  }
  void write() {
    world.write();
    look();
  }
  void answer(int how) {
    if (world.with_executor.empty())
      return;
    const auto which = static_cast<std::size_t>(how) % world.with_executor.size();
    const auto number = world.with_executor[which].number;
    world.with_executor.erase(world.with_executor.begin() + static_cast<std::ptrdiff_t>(which));
    if (how % 5 < 3)
      world.answer(number, {how % 5 == 0, how % 5 == 0 ? "" : "not now", {}});
    else
      world.no_answer(number, how % 5 == 3);
    look();
  }
  void crash() {
    world.crash();
    open.clear(); // who waited hears nothing
    look();
  }
  void change_control(int who, int act) {
    (void)world.control(people.at(static_cast<std::size_t>(who) % people.size()),
                        acts.at(static_cast<std::size_t>(act) % acts.size()), "bob");
  }
  void pass(int tenths) { world.pass(tenths * s / 10); }

  // To the end: everybody answers.
  void finish() {
    write();
    while (!world.with_executor.empty())
      answer(0);
    for (const auto request : open)
      RC_ASSERT(world.answered[request] == 1);
    for (const auto& [request, times] : world.answered)
      RC_ASSERT(times == 1);
    std::map<std::tuple<std::string, std::string, command_kind>, std::set<verdict>> by_id;
    for (const auto& [request, m] : said) {
      const auto found = world.answers.find(request);
      if (found == world.answers.end() || m.id.empty() || operators::is_stop(m.what.kind))
        continue;
      const auto is = found->second.verdict;
      if (is != verdict::busy && is != verdict::id_used)
        by_id[{m.by.name, m.id, m.what.kind}].insert(is);
    }
    for (const auto& [key, verdicts] : by_id)
      RC_ASSERT(verdicts.size() == 1U);
  }

private:
  // What was handed over since the last look.
  void look() {
    for (; seen < world.handed.size(); ++seen) {
      const auto& each = world.handed[seen];
      RC_ASSERT(each.what.by != "mallory" && each.what.by != "eve");
      if (operators::is_stop(each.what.kind))
        continue;
      const auto& holder = world.durable.control;
      RC_ASSERT(!revoked.contains(each.number));
      const auto may = holder ? holder->who.name : std::string("world");
      RC_ASSERT(may == each.what.by);
      const auto& all = world.durable.commands;
      const auto kept = std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.number == each.number; });
      RC_ASSERT(kept != all.end());
      if (!kept->id.empty()) {
        const bool is_first = handed_ids.emplace(kept->by.name, kept->id).second;
        RC_ASSERT(is_first);
      }
    }
  }

  bridge_world world;
  std::vector<operators::principal> people;
  std::map<std::uint64_t, operator_command> said;
  std::set<std::uint64_t> open;
  std::set<std::uint64_t> revoked; // by a stop
  std::set<std::pair<std::string, std::string>> handed_ids;
  std::size_t seen = 0;
};

RC_GTEST_PROP(operator_bridge_property, nothing_is_done_twice_or_for_who_may_not_and_a_repetition_is_answered_the_same,
              ()) {
  enum kind { say, write, answer, crash, change, pass, count };
  const auto ops = *rc::gen::container<std::vector<std::array<int, 4>>>(
      rc::gen::container<std::array<int, 4>>(rc::gen::inRange(0, 1'000)));
  world w;
  for (const auto& [what, a, b, c] : ops)
    switch (what % count) {
    case say:
      w.say(a, b, c);
      break;
    case write:
      w.write();
      break;
    case answer:
      w.answer(a);
      break;
    case crash:
      if (a % 4 == 0)
        w.crash();
      break;
    case change:
      w.change_control(a, b);
      break;
    case pass:
      w.pass(a % 40);
      break;
    }
  w.finish();
}

} // namespace operator_bridge_core_property_test
} // namespace godwit::operator_bridge::tests
