#include "actors/operator_bridge/sessions.hpp"

#include <algorithm>
#include <utility>

namespace godwit::operator_bridge {

using operators::principal;

namespace {

principal principal_of(const session& each) { return {each.who.name, each.who.role, each.id}; }

// A program speaks by its account, and not in a session.
std::string session_of_token(const account& who) { return "token:" + who.name; }

const account* find_account(const std::vector<account>& accounts, const std::string& name) {
  const auto found = std::ranges::find(accounts, name, &account::name);
  return found == accounts.end() ? nullptr : &*found;
}

bool is_program(const principal& by, const std::vector<account>& accounts) {
  const auto* const found = find_account(accounts, by.name);
  return found != nullptr && !found->token_hash.empty() && session_of_token(*found) == by.session &&
         found->role == by.role;
}

} // namespace

std::int64_t sessions::used_ns(const session& each) const {
  const auto live = used_ns_.find(each.id);
  return live == used_ns_.end() ? each.used_ns : std::max(each.used_ns, live->second);
}

bool sessions::is_over(const session& each, instant now) const {
  return now.wall_ns - each.opened_ns >= set_.session_most_s * ns_per_s ||
         now.wall_ns - used_ns(each) >= set_.session_idle_s * ns_per_s;
}

// -- in and out -------------------------------------------------------------------------------------

session_answer sessions::open(effects& out, const open_session& m, instant now) {
  return put(out, m.who, m.token_hash, m.from, now);
}

session_answer sessions::open(effects& out, const use_link& m, instant now) {
  const auto found = std::ranges::find(s_.links, m.link_hash, &link::hash);
  if (found == s_.links.end() || found->until_ns <= now.wall_ns) {
    audit_.add_stranger(out, {}, {.what = "log in by link from " + m.from, .outcome = "refused"}, now);
    return {false, "the link was used, or is too old; make a new one with godwitd ctl login", {}, 0};
  }
  out.emplace_back(note{link_dropped{m.link_hash}});
  return put(out, {found->by.name, found->by.role, {}, {}}, m.token_hash, m.from, now);
}

link_answer sessions::make(effects& out, const make_link& m, instant now) {
  const auto until_ns = now.wall_ns + link_ns;
  out.emplace_back(note{link_made{{m.link_hash, m.by, until_ns}}});
  audit_.add(out, {.who = m.by, .what = "make a link to log in", .outcome = "done"}, now);
  return {true, {}, until_ns};
}

session_ended sessions::close(effects& out, const end_session& m, instant now) {
  const auto found = std::ranges::find(s_.sessions, m.by.session, &session::id);
  if (found == s_.sessions.end())
    return {false};
  end(out, *found, "log out", now);
  return {true};
}

session_answer sessions::put(effects& out, account who, std::string token_hash, std::string from, instant now) {
  make_room(out, who.name, now);
  session made{"s" + std::to_string(s_.last_session + 1), std::move(who), std::move(token_hash), std::move(from), 0, 0};
  made.who.token_hash.clear();
  auto as = principal_of(made);
  audit_.add(out, {.who = as, .what = "log in from " + made.from, .outcome = "done"}, now);
  out.emplace_back(note{session_opened{std::move(made)}});
  return {true, {}, std::move(as), now.wall_ns + set_.session_most_s * ns_per_s};
}

void sessions::make_room(effects& out, const std::string& name, instant now) {
  const auto of_one = std::ranges::count_if(s_.sessions, [&](const auto& each) { return each.who.name == name; });
  const bool is_one_full = static_cast<std::size_t>(of_one) >= max_sessions_of_one;
  if (!is_one_full && s_.sessions.size() < max_sessions)
    return;
  const session* longest = nullptr;
  for (const auto& each : s_.sessions)
    if ((!is_one_full || each.who.name == name) && (longest == nullptr || used_ns(each) < used_ns(*longest)))
      longest = &each;
  if (longest != nullptr)
    end(out, *longest, "log out, because others logged in", now);
}

void sessions::end(effects& out, const session& each, const std::string& why, instant now) {
  audit_.add(out, {.who = principal_of(each), .what = why, .outcome = "done"}, now);
  control_.free_session(out, each.id, now);
  used_ns_.erase(each.id);
  out.emplace_back(note{session_closed{each.id}});
  out.emplace_back(session_over{each.id});
}

// -- who it is --------------------------------------------------------------------------------------

identity sessions::find(effects& out, const identify& m, instant now) {
  if (m.token_hash.empty())
    return {};
  if (const auto found = std::ranges::find(s_.sessions, m.token_hash, &session::token_hash);
      found != s_.sessions.end() && !is_over(*found, now)) {
    touch(out, found->id, now);
    return {true, principal_of(*found), found->opened_ns + set_.session_most_s * ns_per_s};
  }
  if (s_.accounts)
    if (const auto found = std::ranges::find(*s_.accounts, m.token_hash, &account::token_hash);
        found != s_.accounts->end())
      return {true, {found->name, found->role, session_of_token(*found)}, 0};
  return {};
}

void sessions::touch(effects& out, const std::string& id, instant now) {
  const auto found = std::ranges::find(s_.sessions, id, &session::id);
  if (found == s_.sessions.end())
    return;
  used_ns_[id] = now.wall_ns;
  if (now.wall_ns - found->used_ns >= written_each_ns)
    out.emplace_back(note{session_used{id}});
}

bool sessions::is_alive(const principal& by, instant now) const {
  if (by.session == operators::local_session)
    return true;
  if (const auto found = std::ranges::find(s_.sessions, by.session, &session::id); found != s_.sessions.end())
    return principal_of(*found) == by && !is_over(*found, now);
  return s_.accounts && is_program(by, *s_.accounts);
}

std::optional<principal> sessions::named(const std::string& name, instant now) const {
  for (auto each = s_.sessions.rbegin(); each != s_.sessions.rend(); ++each)
    if (each->who.name == name && !is_over(*each, now))
      return principal_of(*each);
  return std::nullopt;
}

void sessions::on_accounts(effects& out, const accounts_read& m, instant now) {
  for (const auto& each : s_.accounts.value_or(std::vector<account>()))
    if (const auto* const now_as = find_account(m.list, each.name);
        !each.token_hash.empty() &&
        (now_as == nullptr || now_as->token_hash != each.token_hash || now_as->role != each.role))
      out.emplace_back(session_over{session_of_token(each)});
  if (s_.accounts != m.list)
    out.emplace_back(note{m});
  for (const auto& each : s_.sessions) {
    if (each.who.stamp.empty()) // by a link: it belongs to no account
      continue;
    const auto* const as = find_account(m.list, each.who.name);
    if (as == nullptr || as->stamp != each.who.stamp || as->role != each.who.role)
      end(out, each, "log out, because the account has changed", now);
  }
  if (s_.control && s_.control->who.session.starts_with("token:") && !is_program(s_.control->who, m.list))
    control_.free_session(out, s_.control->who.session, now);
}

void sessions::sweep(effects& out, instant now) {
  for (const auto& each : s_.sessions)
    if (is_over(each, now))
      end(out, each, "log out, because the session is over", now);
  for (const auto& each : s_.links)
    if (each.until_ns <= now.wall_ns)
      out.emplace_back(note{link_dropped{each.hash}});
}

} // namespace godwit::operator_bridge
