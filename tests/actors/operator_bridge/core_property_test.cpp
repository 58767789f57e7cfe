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
    people = {bridge.log_in("anna"),
              bridge.log_in("bob"),
              bridge.log_in("eve", role::viewer),
              bridge.log_in("chief", role::engineer),
              local(),
              {"mallory", role::engineer, "s77"}};
  }

  void say(int who, int kind, int id) {
    auto m = bridge.command(people.at(static_cast<std::size_t>(who) % people.size()),
                            kinds.at(static_cast<std::size_t>(kind) % kinds.size()),
                            id % 4 == 0 ? std::string() : "id" + std::to_string(id % 4));
    if (operators::is_stop(m.what.kind) && m.by.name != "mallory" && m.by.name != "eve")
      revoked.insert(bridge.waiting.begin(), bridge.waiting.end());
    const auto request = bridge.say(m);
    said.emplace(request, m);
    open.insert(request);
    look();
  }
  void write() {
    bridge.write();
    look();
  }
  void answer(int how) {
    if (bridge.with_executor.empty())
      return;
    const auto which = static_cast<std::size_t>(how) % bridge.with_executor.size();
    const auto number = bridge.with_executor[which].number;
    bridge.with_executor.erase(bridge.with_executor.begin() + static_cast<std::ptrdiff_t>(which));
    if (how % 5 < 3)
      bridge.answer(number, {how % 5 == 0, how % 5 == 0 ? "" : "not now", {}});
    else
      bridge.no_answer(number, how % 5 == 3);
    look();
  }
  void crash() {
    bridge.crash();
    open.clear(); // who waited hears nothing
    look();
  }
  void change_control(int who, int act) {
    (void)bridge.control(people.at(static_cast<std::size_t>(who) % people.size()),
                         acts.at(static_cast<std::size_t>(act) % acts.size()), "bob");
  }
  void pass(int tenths) { bridge.pass(tenths * s / 10); }

  // To the end: everybody answers.
  void finish() {
    write();
    while (!bridge.with_executor.empty())
      answer(0);
    for (const auto request : open)
      RC_ASSERT(bridge.answered[request] == 1);
    for (const auto& [request, times] : bridge.answered)
      RC_ASSERT(times == 1);
    std::map<std::tuple<std::string, std::string, command_kind>, std::set<verdict>> by_id;
    for (const auto& [request, m] : said) {
      const auto found = bridge.answers.find(request);
      if (found == bridge.answers.end() || m.id.empty() || operators::is_stop(m.what.kind))
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
    for (; seen < bridge.handed.size(); ++seen) {
      const auto& each = bridge.handed[seen];
      RC_ASSERT(each.what.by != "mallory" && each.what.by != "eve");
      if (operators::is_stop(each.what.kind))
        continue;
      const auto& holder = bridge.durable.control;
      RC_ASSERT(!revoked.contains(each.number));
      const auto may = holder ? holder->who.name : std::string("desk");
      RC_ASSERT(may == each.what.by);
      const auto& all = bridge.durable.commands;
      const auto kept = std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.number == each.number; });
      RC_ASSERT(kept != all.end());
      if (!kept->id.empty()) {
        const bool is_first = handed_ids.emplace(kept->by.name, kept->id).second;
        RC_ASSERT(is_first);
      }
    }
  }

  bridge_world bridge;
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
