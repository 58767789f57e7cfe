#include "actors/operator_bridge/control.hpp"

#include <utility>

namespace godwit::operator_bridge {

using operators::principal;
using operators::role;

namespace {

bool is_same(const principal& left, const principal& right) {
  return left.session == right.session && left.name == right.name;
}

} // namespace

const principal* control::holder(instant now) const {
  return s_.control && !is_silent(now) ? &s_.control->who : nullptr;
}

bool control::hear(const principal& who, instant now) {
  const auto* has = holder(now);
  if (has == nullptr || !is_same(*has, who))
    return false;
  heard_ns_ = now.monotonic_ns;
  return true;
}

std::string control::objection_to(const principal& who, instant now) const {
  const auto* has = holder(now);
  if (has != nullptr)
    return is_same(*has, who) ? std::string() : has->name + " has control; hold and return are open to you";
  return who.session == operators::local_session ? std::string() : "nobody has control; take it first";
}

control_answer control::change(effects& out, const change_control& m, const std::optional<principal>& to, instant now) {
  const auto* has = holder(now);
  const bool is_own = has != nullptr && is_same(*has, m.by);
  switch (m.act) {
  case control_act::take:
    if (has != nullptr && has->name != m.by.name)
      return refuse(out, m, "take control", has->name + " has control; ask for it, or wait until it is free", now);
    give_to(out, m, m.by, "take control", now);
    break;
  case control_act::take_over:
    if (m.by.role < role::engineer)
      return refuse(out, m, "take over control", "only an engineer takes control from others", now);
    give_to(out, m, m.by, has == nullptr ? "take control" : "take over control from " + has->name, now);
    break;
  case control_act::give:
    if (!is_own)
      return refuse(out, m, "give control", "you do not have control", now);
    give_to(out, m, std::nullopt, "give control", now);
    break;
  case control_act::hand_over:
    if (!is_own)
      return refuse(out, m, "hand over control", "you do not have control", now);
    if (!to || to->role < role::operator_)
      return refuse(out, m, "hand over control",
                    "no operator of the name " + m.to.substr(0, max_name) + " is logged in", now);
    give_to(out, m, to, "hand over control to " + to->name, now);
    break;
  }
  return {true, {}, m.act == control_act::give ? std::string() : m.act == control_act::hand_over ? m.to : m.by.name};
}

void control::free_silent(effects& out, instant now) {
  if (!s_.control || !is_silent(now))
    return;
  audit_.add(out, {.who = s_.control->who, .what = "control is free", .outcome = "silent"}, now);
  out.emplace_back(note{control_changed{}});
}

void control::free_session(effects& out, const std::string& session, instant now) {
  if (!s_.control || s_.control->who.session != session)
    return;
  audit_.add(out, {.who = s_.control->who, .what = "control is free", .outcome = "logged_out"}, now);
  out.emplace_back(note{control_changed{}});
}

std::int64_t control::silent_at_ns(std::int64_t never) const { return s_.control ? heard_ns_ + silent_ns + 1 : never; }

void control::give_to(effects& out, const change_control& m, std::optional<principal> to, const std::string& what,
                      instant now) {
  audit_.add(out, {.who = m.by, .what = what, .outcome = "done"}, now);
  heard_ns_ = now.monotonic_ns;
  out.emplace_back(note{control_changed{std::move(to)}});
}

control_answer control::refuse(effects& out, const change_control& m, const std::string& what, std::string reason,
                               instant now) {
  audit_.add(out, {.who = m.by, .what = what, .outcome = "refused", .reason = reason}, now);
  const auto* has = holder(now);
  return {false, std::move(reason), has == nullptr ? std::string() : has->name};
}

} // namespace godwit::operator_bridge
