#include "actors/operator_bridge/audit.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/fields/utf8.hpp"

namespace godwit::operator_bridge {
namespace {

// "unknown": it went out, and nobody can say what became of it.
constexpr std::array<std::string_view, 5> done{"taken", "done", "unknown", "silent", "logged_out"};

bool are_alike(const audit_row& left, const audit_row& right) {
  return left.who == right.who && left.what == right.what && left.id == right.id && left.outcome == right.outcome &&
         left.reason == right.reason;
}

constexpr audit::rate rate_of(audit_kind kind) {
  return kind == audit_kind::act       ? audit::of_acts
         : kind == audit_kind::refusal ? audit::of_refusals
                                       : audit::of_strangers;
}

} // namespace

audit_kind kind_of(const audit_row& row) {
  if (row.who.session.empty())
    return audit_kind::stranger;
  return std::ranges::find(done, row.outcome) == done.end() ? audit_kind::refusal : audit_kind::act;
}

void audit::add(effects& out, audit_row row, instant now) {
  row.what.resize(io::whole_characters(row.what, max_reason));
  row.id.resize(io::whole_characters(row.id, max_command_id));
  row.reason.resize(io::whole_characters(row.reason, max_reason));
  row.at_ns = now.wall_ns;
  auto& of = share_of(row, now);
  if (of.unwritten)
    row.count += of.unwritten->count;
  if (of.left < 1) {
    of.unwritten = std::move(row);
    return;
  }
  of.unwritten.reset();
  write(out, of, std::move(row), now);
}

void audit::add_stranger(effects& out, std::string name, audit_row row, instant now) {
  name.resize(io::whole_characters(name, max_name));
  row.who = {std::move(name), operators::role::viewer, {}};
  row.id.clear();
  add(out, std::move(row), now);
}

std::int64_t audit::due_ns(std::int64_t never) const {
  auto result = never;
  for (const auto& [key, each] : shares_)
    if (each.unwritten)
      result = std::min(
          result, each.counted_ns + 1 +
                      static_cast<std::int64_t>((1 - each.left) / each.its.per_s * static_cast<double>(ns_per_s)));
  return result;
}

void audit::write_counted(effects& out, instant now) {
  for (auto& [key, each] : shares_) {
    refill(each, now);
    if (each.unwritten && each.left >= 1)
      write(out, each, *std::exchange(each.unwritten, std::nullopt), now);
  }
}

void audit::refill(share& of, instant now) {
  const auto passed_ns = now.monotonic_ns - std::exchange(of.counted_ns, now.monotonic_ns);
  of.left =
      std::min(of.its.at_once, of.left + of.its.per_s * static_cast<double>(passed_ns) / static_cast<double>(ns_per_s));
}

audit::share& audit::share_of(const audit_row& row, instant now) {
  const auto kind = kind_of(row);
  share_key key{kind, kind == audit_kind::stranger ? std::string() : row.who.name};
  const auto found = shares_.find(key);
  if (found == shares_.end() && shares_.size() >= max_shares)
    forget_idle(now);
  if (found == shares_.end() && shares_.size() >= max_shares)
    key.second.clear(); // with others
  const auto its = rate_of(kind);
  auto& of = shares_.try_emplace(std::move(key), share{its, its.at_once, now.monotonic_ns}).first->second;
  refill(of, now);
  return of;
}

// Who was silent for long has a whole share again.
void audit::forget_idle(instant now) {
  for (auto& [key, each] : shares_)
    refill(each, now);
  std::erase_if(shares_,
                [](const auto& each) { return !each.second.unwritten && each.second.left >= each.second.its.at_once; });
}

void audit::write(effects& out, share& of, audit_row row, instant now) {
  of.left -= 1;
  // What was done stands in its order: alike acts are one row only while nothing has come in between.
  const bool may_join = of.newest && (kind_of(row) != audit_kind::act || of.newest->number == last_row_);
  if (may_join && are_alike(*of.newest, row) && now.monotonic_ns - of.newest_ns < alike_within_ns) {
    row.number = of.newest->number;
    row.count += of.newest->count;
  } else {
    row.number = ++last_row_;
  }
  of.newest = row;
  of.newest_ns = now.monotonic_ns;
  out.emplace_back(note{audited{std::move(row)}});
}

} // namespace godwit::operator_bridge
