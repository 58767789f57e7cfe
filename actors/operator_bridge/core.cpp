#include "actors/operator_bridge/core.hpp"

#include <algorithm>
#include <utility>

#include "actors/operator_bridge/command_text.hpp"

namespace godwit::operator_bridge {

using operators::command_kind;
using operators::is_stop;
using operators::principal;
using operators::role;

namespace {

constexpr const char* log_in_first = "log in first: no session is open";

std::string seconds(std::int64_t ns) { return std::to_string(ns / ns_per_s) + " s"; }

const kept_command* find_kept(const state& s, const operator_command& m) {
  const auto found =
      std::ranges::find_if(s.commands, [&](const auto& each) { return each.id == m.id && each.by.name == m.by.name; });
  return found == s.commands.end() ? nullptr : &*found;
}

command_answer of(const operators::answer& m) {
  if (m.is_taken)
    return {verdict::taken, m.advice};
  return {m.state.empty() ? verdict::refused : verdict::stale, m.reason, m.state};
}

// An answer that stays what it is when the same is said again.
bool is_kept(verdict which) { return which == verdict::late || which == verdict::no_control; }

} // namespace

core::core(const settings& set, const state& durable, instant now)
    : set_(set), s_(durable), audit_(durable.last_row), control_(durable, audit_, now),
      sessions_(set_, durable, audit_, control_), last_number_(durable.last_command), swept_ns_(now.monotonic_ns) {}

effects core::on_start(instant now) {
  effects out;
  if (!s_.unmoved.empty())
    out.emplace_back(note{rows_moved{s_.unmoved}});
  for (const auto& each : s_.commands) {
    if (each.answer)
      continue;
    const command_answer answer{verdict::unknown, "godwit was restarted while it was under way; check the status"};
    audit_.add(out,
               {.who = each.by,
                .what = "a command before the restart",
                .id = each.id,
                .outcome = std::string(io::name_of(answer.verdict)),
                .reason = answer.reason},
               now);
    out.emplace_back(note{command_ended{each.number, answer}});
  }
  return out;
}

// -- a command --------------------------------------------------------------------------------------

effects core::on_command(const operator_command& m, std::uint64_t request, instant now) {
  effects out;
  ++commands_;
  control_.free_silent(out, now);
  if (!is_known(out, m.by, words_of(m.what), now)) {
    ++refused_;
    out.emplace_back(reply{request, {verdict::no_session, log_in_first}});
    return out;
  }
  if (m.by.role < role::operator_)
    refuse(out, m, request, {verdict::wrong_role, "a viewer gives no commands"}, now);
  else if (is_stop(m.what.kind) && !m.id.empty() && !can_have_id(m))
    admit_without_id(out, m, request, now);
  else if (!m.id.empty() && !is_command_id(m.id))
    refuse(out, m, request, {verdict::refused, "an id has 1 to 64 letters, digits and -._:~"}, now);
  else if (repeat(out, m, request, now))
    return out;
  else if (auto answer = objection_to(m, now); answer.verdict != verdict::taken)
    refuse(out, m, request, std::move(answer), now);
  else
    admit(out, m, request, now);
  return out;
}

// Who is not known leaves a row of its own kind.
bool core::is_known(effects& out, const principal& by, const std::string& what, instant now) {
  if (sessions_.is_alive(by, now)) {
    hear(by, now);
    sessions_.touch(out, by.session, now);
    return true;
  }
  audit_.add_stranger(out, by.name, {.what = what, .outcome = std::string(io::name_of(verdict::no_session))}, now);
  return false;
}

void core::hear(const principal& who, instant now) {
  is_holder_heard_ = control_.hear(who, now) || is_holder_heard_;
  if (who.role >= role::operator_)
    operator_heard_ns_ = now.monotonic_ns;
}

bool core::takes_holder_news(instant now) {
  const bool is_due = holder_told_ns_ == 0 || now.monotonic_ns - holder_told_ns_ >= holder_news_ns;
  if (!std::exchange(is_holder_heard_, false) || !is_due)
    return false;
  holder_told_ns_ = now.monotonic_ns;
  return true;
}

core::under_way* core::find_under_way(const operator_command& m) {
  const auto found = std::ranges::find_if(
      under_way_, [&](const auto& each) { return each.second.as.id == m.id && each.second.as.by.name == m.by.name; });
  return found == under_way_.end() ? nullptr : &found->second;
}

// An id that is none, or another command's.
bool core::can_have_id(const operator_command& m) {
  const auto* const kept = find_kept(s_, m);
  const auto* const open = find_under_way(m);
  const bool is_used = (kept != nullptr && kept->text != text_of(m.what)) ||
                       (kept == nullptr && open != nullptr && open->as.text != text_of(m.what));
  return is_command_id(m.id) && !is_used;
}

// Nobody is kept from stopping the vehicle by a bad id.
void core::admit_without_id(effects& out, operator_command m, std::uint64_t request, instant now) {
  m.id.clear();
  if (auto answer = objection_to(m, now); answer.verdict != verdict::taken)
    refuse(out, m, request, std::move(answer), now);
  else
    admit(out, m, request, now);
}

// True: it has the answer of the first time, or will have it.
bool core::repeat(effects& out, const operator_command& m, std::uint64_t request, instant now) {
  if (m.id.empty())
    return false;
  const auto* const kept = find_kept(s_, m);
  auto* const open = find_under_way(m);
  if (kept == nullptr && open == nullptr)
    return false;
  if (!can_have_id(m)) {
    refuse(out, m, request, {verdict::id_used, "the id was used for another command; nothing was done"}, now);
    return true;
  }
  audit_.add(out, {.who = m.by, .what = words_of(m.what), .id = m.id, .outcome = "repeated"}, now);
  if (is_stop(m.what.kind)) // what waits was said before this one was heard
    supersede_waiting(out, m.by, now);
  if (kept != nullptr && kept->answer)
    out.emplace_back(reply{request, *kept->answer, !is_stop(m.what.kind)});
  else if (open != nullptr && open->askers.size() < max_askers)
    open->askers.push_back(request);
  else
    out.emplace_back(reply{request, {verdict::busy, "it is under way; ask for the status"}});
  return true;
}

command_answer core::objection_to(const operator_command& m, instant now) const {
  const auto kind = m.what.kind;
  if (m.valid_until_ns != 0 && kind != command_kind::pause) {
    const auto left_ns = m.valid_until_ns - now.wall_ns;
    if (left_ns < 0)
      return {verdict::late, "it was valid until " + seconds(-left_ns) + " ago; send it again if it is still meant"};
    if (left_ns > longest_validity_ns)
      return {verdict::refused, "it would be valid for " + seconds(left_ns) + ", and " + seconds(longest_validity_ns) +
                                    " is the longest; compare the clocks"};
  }
  if (is_stop(kind))
    return {verdict::taken, {}};
  if (auto objection = control_.objection_to(m.by, now); !objection.empty())
    return {verdict::no_control, std::move(objection)};
  const auto waiting = std::ranges::count_if(under_way_, [](const auto& each) { return !each.second.is_stop; });
  if (static_cast<std::size_t>(waiting) >= max_under_way || !has_room(s_, m.by, now.wall_ns))
    return {verdict::busy, "too many commands are under way; send it again in a moment"};
  return {verdict::taken, {}};
}

void core::refuse(effects& out, const operator_command& m, std::uint64_t request, command_answer answer, instant now) {
  ++refused_;
  put_row(out, m.by, m.what, m.id, answer, now);
  if (!m.id.empty() && is_kept(answer.verdict) && has_room(s_, m.by, now.wall_ns)) {
    const auto until_ns = m.valid_until_ns == 0 ? now.wall_ns + usual_validity_ns : m.valid_until_ns;
    out.emplace_back(note{command_kept{{++last_number_, m.by, m.id, text_of(m.what), until_ns, answer}}});
  }
  out.emplace_back(reply{request, std::move(answer), !is_stop(m.what.kind)});
}

void core::admit(effects& out, const operator_command& m, std::uint64_t request, instant now) {
  const bool stops = is_stop(m.what.kind);
  if (stops) {
    supersede_waiting(out, m.by, now);
    const auto is_alike = [&](const auto& each) { return each.second.what.kind == m.what.kind; };
    if (std::ranges::count_if(under_way_, is_alike) >= static_cast<std::ptrdiff_t>(max_stops_under_way)) {
      auto& newest = std::find_if(under_way_.rbegin(), under_way_.rend(), is_alike)->second;
      if (newest.askers.size() == max_askers)
        return refuse(out, m, request, {verdict::busy, "many have sent the same, and it is under way"}, now);
      newest.askers.push_back(request);
      return put_row(out, m.by, m.what, m.id, {verdict::taken, "with another one that is under way"}, now);
    }
  }
  const auto until_ns = m.valid_until_ns == 0 ? now.wall_ns + usual_validity_ns : m.valid_until_ns;
  under_way begun{
      {++last_number_, m.by, m.id, text_of(m.what), until_ns, {}}, m.what, {request}, now.monotonic_ns, stops, stops};
  begun.what.by = m.by.name;
  if (!stops)
    out.emplace_back(note{command_kept{begun.as}});
  out.emplace_back(hand_over{begun.as.number, begun.what, stops});
  under_way_.emplace(begun.as.number, std::move(begun));
}

void core::supersede_waiting(effects& out, const principal& by, instant now) {
  std::vector<std::uint64_t> waiting;
  for (const auto& [number, each] : under_way_)
    if (!each.is_out)
      waiting.push_back(number);
  for (const auto number : waiting)
    end(out, number, {verdict::superseded, by.name + " has stopped the vehicle before it went out"}, now);
}

core::released core::on_written(std::uint64_t number, instant now) {
  const auto found = under_way_.find(number);
  if (found == under_way_.end())
    return {};
  auto& each = found->second;
  released result;
  if (now.monotonic_ns - each.since_ns > release_within_ns || now.wall_ns > each.as.valid_until_ns)
    end(result.otherwise, number, {verdict::late, "the disk took too long; nothing was done, send it again"}, now);
  else if (auto objection = control_.objection_to(each.as.by, now); !objection.empty())
    end(result.otherwise, number, {verdict::no_control, std::move(objection)}, now);
  else {
    each.is_out = true;
    result.goes = true;
    result.what = each.what;
  }
  return result;
}

effects core::on_answer(std::uint64_t number, const operators::answer& m, instant now) {
  effects out;
  end(out, number, of(m), now);
  return out;
}

effects core::on_no_answer(std::uint64_t number, bool was_taken, instant now) {
  effects out;
  if (was_taken)
    end(out, number, {verdict::unknown, "the executor gave no answer; check the status before you send it again"}, now);
  else
    end(out, number, {verdict::not_done, "the executor takes nothing now; nothing was done"}, now);
  return out;
}

void core::end(effects& out, std::uint64_t number, command_answer answer, instant now) {
  auto done = under_way_.extract(number);
  if (done.empty())
    return;
  const auto& each = done.mapped();
  refused_ += answer.verdict == verdict::taken ? 0 : 1;
  put_row(out, each.as.by, each.what, each.as.id, answer, now);
  // A stop that was not taken is handed over again when it is sent again.
  if (!each.is_stop) {
    out.emplace_back(note{command_ended{number, answer}});
  } else if (!each.as.id.empty() && answer.verdict == verdict::taken && has_room(s_, each.as.by, now.wall_ns)) {
    auto kept = each.as;
    kept.answer = answer;
    out.emplace_back(note{command_kept{std::move(kept)}});
  }
  for (const auto asker : each.askers)
    out.emplace_back(reply{asker, answer, !each.is_stop});
}

void core::put_row(effects& out, const principal& by, const operators::command& what, const std::string& id,
                   const command_answer& answer, instant now) {
  audit_.add(out,
             {.who = by,
              .what = words_of(what),
              .id = id,
              .outcome = std::string(io::name_of(answer.verdict)),
              .reason = answer.reason},
             now);
}

// -- control, sessions, audit -----------------------------------------------------------------------

std::pair<effects, leave> core::on_leave(const ask_leave& m, instant now) {
  effects out;
  control_.free_silent(out, now);
  if (!is_known(out, m.by, m.what, now))
    return {std::move(out), {verdict::no_session, log_in_first}};
  leave answer{verdict::taken, {}};
  if (m.by.role < role::operator_)
    answer = {verdict::wrong_role, "a viewer decides nothing"};
  else if (auto objection = control_.objection_to(m.by, now); !objection.empty())
    answer = {verdict::no_control, std::move(objection)};
  if (answer.verdict != verdict::taken)
    audit_.add(
        out,
        {.who = m.by, .what = m.what, .outcome = std::string(io::name_of(answer.verdict)), .reason = answer.reason},
        now);
  return {std::move(out), std::move(answer)};
}

std::pair<effects, control_answer> core::on_control(const change_control& m, instant now) {
  effects out;
  control_.free_silent(out, now);
  if (!is_known(out, m.by, "change control", now))
    return {std::move(out), {false, log_in_first, {}}};
  if (m.by.role < role::operator_) {
    audit_.add(out, {.who = m.by, .what = "change control", .outcome = "wrong_role"}, now);
    return {std::move(out), {false, "a viewer can not have control", {}}};
  }
  auto answer = control_.change(out, m, sessions_.named(m.to, now), now);
  return {std::move(out), std::move(answer)};
}

std::pair<effects, session_answer> core::on_open(const open_session& m, instant now) {
  effects out;
  auto answer = sessions_.open(out, m, now);
  return {std::move(out), std::move(answer)};
}

std::pair<effects, session_answer> core::on_open(const use_link& m, instant now) {
  effects out;
  auto answer = sessions_.open(out, m, now);
  return {std::move(out), std::move(answer)};
}

std::pair<effects, link_answer> core::on_link(const make_link& m, instant now) {
  if (m.by.session != operators::local_session)
    return {{}, {false, "a link is made at the control socket alone", 0}};
  effects out;
  auto answer = sessions_.make(out, m, now);
  return {std::move(out), std::move(answer)};
}

std::pair<effects, session_ended> core::on_end(const end_session& m, instant now) {
  effects out;
  const auto answer = sessions_.close(out, m, now);
  return {std::move(out), answer};
}

std::pair<effects, identity> core::on_identify(const identify& m, instant now) {
  effects out;
  auto found = sessions_.find(out, m, now);
  if (found.is_known)
    hear(found.who, now);
  return {std::move(out), std::move(found)};
}

effects core::on_accounts(const accounts_read& m, instant now) {
  effects out;
  sessions_.on_accounts(out, m, now);
  return out;
}

effects core::on_note(const audit_note& m, instant now) {
  effects out;
  audit_row row{.who = m.who, .what = m.what, .outcome = m.outcome, .reason = m.reason};
  if (m.who.session.empty())
    audit_.add_stranger(out, m.who.name, std::move(row), now);
  else
    audit_.add(out, std::move(row), now);
  return out;
}

std::pair<effects, audit_leave> core::on_read_audit(const read_audit& m, instant now) {
  effects out;
  if (!is_known(out, m.by, "read the audit", now))
    return {std::move(out), {log_in_first}};
  if (m.by.role < role::operator_)
    return {std::move(out), {"a viewer does not read the audit"}};
  return {std::move(out), {}};
}

operators_view core::describe() const {
  operators_view result;
  result.control = s_.control;
  for (const auto& each : s_.sessions)
    result.sessions.push_back({{each.who.name, each.who.role, each.id}, each.from, each.opened_ns, each.used_ns});
  result.commands = commands_;
  result.refused = refused_;
  return result;
}

// -- time -------------------------------------------------------------------------------------------

std::int64_t core::next_due_ns() const {
  const auto sweep_ns = s_.sessions.empty() && s_.links.empty() ? never_due : swept_ns_ + sessions::swept_each_ns;
  return std::min({control_.silent_at_ns(never_due), sweep_ns, audit_.due_ns(never_due)});
}

effects core::on_time(instant now) {
  effects out;
  control_.free_silent(out, now);
  audit_.write_counted(out, now);
  if (now.monotonic_ns - swept_ns_ >= sessions::swept_each_ns) {
    swept_ns_ = now.monotonic_ns;
    sessions_.sweep(out, now);
  }
  return out;
}

} // namespace godwit::operator_bridge
