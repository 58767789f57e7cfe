#include "actors/executor/supervision/core.hpp"

#include <algorithm>
#include <utility>

namespace godwit::executor::supervision {
namespace {

using runtime::child_event_kind;
using runtime::child_phase;

std::string because(const std::string& reason) { return reason.empty() ? "" : ": " + reason; }

announce gave_up(const std::string& name, const std::string& reason) {
  return {name + " is given up" + because(reason), true};
}

} // namespace

core::core(circumstances process, std::uint64_t incarnation, std::vector<std::string> children) : process_(process) {
  table_.epoch.incarnation = incarnation;
  for (auto& each : children)
    children_.push_back({.name = std::move(each), .given_up_ns = {}});
}

core::child* core::find(const std::string& name) {
  const auto found = std::ranges::find(children_, name, &child::name);
  return found == children_.end() ? nullptr : &*found;
}

void core::give_up(child& each, std::int64_t now_ns) {
  each.is_running = false;
  each.is_away = true;
  if (!each.given_up_ns)
    each.given_up_ns = now_ns;
}

std::vector<announce> core::on_children(const runtime::children& all, std::int64_t now_ns) {
  std::vector<announce> result;
  knows_children_ = true;
  for (const auto& report : all.list) {
    auto* const each = find(report.name);
    if (each == nullptr)
      continue;
    each->is_running = report.phase == child_phase::running;
    each->is_away = !report.wanted && !each->is_running;
    if (report.phase != child_phase::given_up) {
      each->given_up_ns.reset();
      continue;
    }
    if (!each->given_up_ns)
      result.push_back(gave_up(report.name, report.last_crash));
    give_up(*each, now_ns);
  }
  return result;
}

std::vector<announce> core::on_event(const runtime::child_event& happened, std::int64_t now_ns) {
  auto* const each = find(happened.name);
  if (each == nullptr)
    return {};
  switch (happened.kind) {
  case child_event_kind::up: {
    each->is_running = true;
    const bool was_away = std::exchange(each->is_away, false);
    if (was_away)
      returned_.push_back(each->name);
    const bool was_given_up = std::exchange(each->given_up_ns, {}).has_value();
    if (was_given_up || (happened.incarnation > 1 && !was_away))
      return {{happened.name + " is back", false}};
    return {};
  }
  case child_event_kind::crashed:
  case child_event_kind::silent:
    each->is_running = false;
    return {{happened.name + " crashed" + because(happened.reason), false}};
  case child_event_kind::gave_up:
    give_up(*each, now_ns);
    return {gave_up(happened.name, happened.reason)};
  case child_event_kind::stopped:
    each->is_running = false;
    each->is_away = true;
    break;
  case child_event_kind::late:
    break;
  }
  return {};
}

void core::on_acknowledged(const runtime::table_epoch& held) { acknowledged_ = std::max(acknowledged_, held); }

void core::look(const state& durable, bool in_flight, bool has_scans, std::int64_t now_ns) {
  const auto seen = part_of(durable, in_flight);
  if (!now_)
    return begin(seen, has_scans, durable);
  if (seen == *now_) {
    next_.reset();
    if (seen == part::flight && has_scans != scans_)
      begin(seen, has_scans, durable);
    return;
  }
  if (next_ != seen) {
    next_ = seen;
    next_since_ns_ = now_ns;
  } else if (now_ns - next_since_ns_ >= part_holds_ns) {
    next_.reset();
    begin(seen, has_scans, durable);
  }
}

void core::begin(part next, bool has_scans, const state& durable) {
  now_ = next;
  scans_ = has_scans;
  ++table_.epoch.n;
  table_.revivals = durable.landings;
  std::vector<std::string> names;
  for (const auto& each : children_)
    names.push_back(each.name);
  table_.list = table_of(next, process_, names, has_scans);
}

std::optional<runtime::supervise> core::unacknowledged() const {
  if (!now_ || acknowledged_ >= table_.epoch)
    return {};
  return table_;
}

std::vector<preflight::actor_fact> core::facts() const {
  std::vector<preflight::actor_fact> result;
  for (const auto& each : children_)
    if (is_wanted_on_ground(each.name) && !is_dispensable(each.name))
      result.push_back({each.name, each.is_running});
  return result;
}

bool core::is_failsafe_gone(std::int64_t now_ns) const {
  const auto found = std::ranges::find(children_, name(child_name::failsafe), &child::name);
  return now() == part::flight && found != children_.end() && found->given_up_ns &&
         now_ns - *found->given_up_ns >= gone_holds_ns;
}

bool core::misses_failsafe(const state& durable, std::int64_t now_ns) const {
  return is_failsafe_gone(now_ns) && !durable.is_failsafe_missed;
}

} // namespace godwit::executor::supervision
