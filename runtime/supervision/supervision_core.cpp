#include "runtime/supervision/supervision_core.hpp"

#include <algorithm>
#include <utility>

namespace godwit::runtime {

supervision_core::supervision_core(strategy how, const std::vector<child_policy>& children, std::uint64_t seed)
    : strategy_(how), random_(seed) {
  children_.reserve(children.size());
  for (const auto& each : children)
    children_.push_back({.policy = each, .history = {}});
}

supervision_core::actions supervision_core::start() {
  started_ = true;
  actions out;
  look_again(out);
  return out;
}

supervision_core::actions supervision_core::shutdown() {
  shutting_down_ = true;
  for (auto& each : children_)
    if (each.phase == child_phase::waiting)
      each.phase = child_phase::absent;
  actions out;
  look_again(out);
  return out;
}

supervision_core::actions supervision_core::up(std::size_t i) {
  actions out;
  if (children_[i].phase != child_phase::starting)
    return out;
  children_[i].phase = child_phase::running;
  if (std::exchange(children_[i].been_up, true))
    ++children_[i].restarts;
  look_again(out);
  return out;
}

supervision_core::actions supervision_core::down(std::size_t i, std::int64_t now_ns, bool restart_is_useless) {
  actions out;
  switch (children_[i].phase) {
  case child_phase::stopping:
    children_[i].phase = child_phase::absent;
    break;
  case child_phase::starting:
  case child_phase::running:
    crashed(i, now_ns, restart_is_useless, out);
    break;
  case child_phase::absent:
  case child_phase::waiting:
  case child_phase::given_up:
    return out;
  }
  look_again(out);
  return out;
}

void supervision_core::crashed(std::size_t i, std::int64_t now_ns, bool restart_is_useless, actions& out) {
  auto& each = children_[i];
  const auto delay_ns = each.history.on_crash(each.policy.restart, now_ns, random_);
  if (!delay_ns || restart_is_useless) {
    each.phase = child_phase::given_up;
    out.emplace_back(give_up_child{i});
    if (each.policy.essential && !shutting_down_)
      out.emplace_back(bring_down{i});
    return;
  }
  if (*delay_ns == 0 || shutting_down_) {
    each.phase = child_phase::absent;
    return;
  }
  each.phase = child_phase::waiting;
  each.is_late = !each.been_up;
  out.emplace_back(await_restart{i, *delay_ns});
}

supervision_core::actions supervision_core::restart_due(std::size_t i) {
  actions out;
  if (children_[i].phase != child_phase::waiting)
    return out;
  children_[i].phase = child_phase::absent;
  look_again(out);
  return out;
}

supervision_core::actions supervision_core::want(std::size_t i, bool wanted) {
  children_[i].wanted = wanted;
  actions out;
  look_again(out);
  return out;
}

supervision_core::actions supervision_core::revive(std::size_t i) {
  auto& each = children_[i];
  actions out;
  if (each.phase != child_phase::given_up)
    return out;
  each.phase = child_phase::absent;
  each.history.forget();
  look_again(out);
  return out;
}

bool supervision_core::has_begun() const {
  return started_ && std::all_of(children_.begin(), children_.end(), [](const entry& each) {
           return !each.wanted || each.been_up || each.phase == child_phase::given_up;
         });
}

bool supervision_core::must_stop(std::size_t i) const {
  if (shutting_down_ || !children_[i].wanted)
    return true;
  if (strategy_ == strategy::one_for_one)
    return false;
  return std::any_of(children_.begin(), children_.begin() + static_cast<std::ptrdiff_t>(i),
                     [](const entry& before) { return before.wanted && before.phase != child_phase::running; });
}

bool supervision_core::may_start(std::size_t i) const {
  if (!children_[i].wanted || children_[i].phase != child_phase::absent)
    return false;
  if (strategy_ == strategy::one_for_one && children_[i].been_up)
    return true;
  return std::all_of(children_.begin(), children_.begin() + static_cast<std::ptrdiff_t>(i), [&](const entry& before) {
    if (!before.wanted)
      return true;
    if (strategy_ == strategy::rest_for_one)
      return before.phase == child_phase::running;
    return lets_later_start(before);
  });
}

bool supervision_core::lets_later_start(const entry& before) {
  const bool ends_process = before.policy.essential && before.policy.restart.intensity != restart_policy::for_ever;
  return before.been_up || before.phase == child_phase::given_up || before.phase == child_phase::stopping ||
         (before.is_late && !ends_process);
}

void supervision_core::look_again(actions& out) {
  if (!started_)
    return;
  const bool is_stopping = stop_one(out);
  if (is_stopping && (shutting_down_ || strategy_ == strategy::rest_for_one))
    return;
  if (shutting_down_) {
    if (!std::exchange(told_stopped_, true))
      out.emplace_back(all_stopped{});
    return;
  }
  for (std::size_t i = 0; i < children_.size(); ++i) {
    if (!may_start(i))
      continue;
    children_[i].phase = child_phase::starting;
    out.emplace_back(start_child{i});
  }
}

bool supervision_core::stop_one(actions& out) {
  const auto is_stopping = [](const entry& each) { return each.phase == child_phase::stopping; };
  if (std::any_of(children_.begin(), children_.end(), is_stopping))
    return true;
  for (std::size_t i = children_.size(); i-- > 0;) {
    auto& phase = children_[i].phase;
    if ((phase != child_phase::running && phase != child_phase::starting) || !must_stop(i))
      continue;
    phase = child_phase::stopping;
    out.emplace_back(stop_child{i, shutting_down_ || !children_[i].wanted});
    return true;
  }
  return false;
}

namespace {

std::int64_t ns(milliseconds duration) { return std::chrono::nanoseconds(duration).count(); }

} // namespace

std::optional<std::int64_t> restart_history::on_crash(const restart_policy& policy, std::int64_t now_ns,
                                                      random_source& random) {
  while (!crashes_.empty() && now_ns - crashes_.front() >= ns(policy.period))
    crashes_.pop_front();
  crashes_.push_back(now_ns);
  if (crashes_.size() > policy.intensity)
    return std::nullopt;
  if (crashes_.size() == 1)
    return 0;
  auto wait = ns(policy.backoff_initial);
  for (std::size_t i = 2; i < crashes_.size() && wait < ns(policy.backoff_max); ++i)
    wait *= 2;
  wait = std::min(wait, ns(policy.backoff_max));
  const auto factor = 1.0 + policy.jitter * (2.0 * random.unit() - 1.0);
  return static_cast<std::int64_t>(static_cast<double>(wait) * factor);
}

} // namespace godwit::runtime
