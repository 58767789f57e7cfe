#include "actors/operator_bridge/audit_table.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace godwit::operator_bridge {
namespace {

// Strangers are one share, whatever names they give.
constexpr const char* first_version = R"(
CREATE TABLE audit(
  number INTEGER PRIMARY KEY, kind INTEGER NOT NULL, share TEXT NOT NULL, at_ns INTEGER NOT NULL, name TEXT NOT NULL,
  role TEXT NOT NULL, session TEXT NOT NULL, what TEXT NOT NULL, id TEXT NOT NULL, outcome TEXT NOT NULL,
  reason TEXT NOT NULL, count INTEGER NOT NULL);
CREATE INDEX audit_share ON audit(kind, share, number);
)";

constexpr const char* put =
    "INSERT INTO audit(number, kind, share, at_ns, name, role, session, what, id, outcome, reason, count) "
    "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?) "
    "ON CONFLICT(number) DO UPDATE SET at_ns = excluded.at_ns, count = excluded.count";

// Rows are counted from the newest of each share on; those that are furthest from it go.
constexpr const char* trim =
    "DELETE FROM audit WHERE (SELECT count(*) FROM audit WHERE kind = ?1) > ?2 AND number IN (SELECT number FROM "
    "(SELECT number, row_number() OVER (PARTITION BY share ORDER BY number DESC) AS place FROM audit WHERE kind = ?1) "
    "ORDER BY place, number DESC LIMIT -1 OFFSET ?2)";

constexpr const char* page = "SELECT number, at_ns, name, role, session, what, id, outcome, reason, count FROM audit "
                             "WHERE number < ? ORDER BY number DESC LIMIT ?";

audit_row row_of(const io::sqlite::statement& from) {
  audit_row result;
  result.number = static_cast<std::uint64_t>(from.integer(0));
  result.at_ns = from.integer(1);
  result.who = {from.text(2), io::value_of<operators::role>(from.text(3)).value_or(operators::role::viewer),
                from.text(4)};
  result.what = from.text(5);
  result.id = from.text(6);
  result.outcome = from.text(7);
  result.reason = from.text(8);
  result.count = static_cast<std::uint32_t>(from.integer(9));
  return result;
}

} // namespace

const runtime::table_definition& audit_table() {
  static const runtime::table_definition result{"audit", {first_version}};
  return result;
}

void put_row(runtime::journal_write& write, const audit_row& row, const audit_bounds& most) {
  const auto kind = kind_of(row);
  write.rows.push_back({put,
                        {static_cast<std::int64_t>(row.number), static_cast<std::int64_t>(kind),
                         kind == audit_kind::stranger ? std::string() : row.who.name, row.at_ns, row.who.name,
                         std::string(io::name_of(row.who.role)), row.who.session, row.what, row.id, row.outcome,
                         row.reason, static_cast<std::int64_t>(row.count)}});
  if (row.number % most.trimmed_each != 0)
    return;
  for (const auto& [each, rows] : {std::pair(audit_kind::act, most.acts), std::pair(audit_kind::refusal, most.refusals),
                                   std::pair(audit_kind::stranger, most.strangers)})
    write.rows.push_back({trim, {static_cast<std::int64_t>(each), rows}});
}

io::sqlite::result<audit_page> read_page(io::sqlite::database& journal, const audit_query& wanted) {
  auto query = journal.prepare(page);
  if (!query)
    return tl::unexpected(std::move(query.error()));
  constexpr auto end = std::numeric_limits<std::int64_t>::max();
  query->with(wanted.before == 0 ? end : static_cast<std::int64_t>(wanted.before), wanted.most + 1);
  audit_page result;
  auto row = query->step();
  for (; row && *row; row = query->step())
    result.rows.push_back(row_of(*query));
  if (!row)
    return tl::unexpected(std::move(row.error()));
  result.has_older = result.rows.size() > wanted.most;
  if (result.has_older)
    result.rows.pop_back();
  std::ranges::reverse(result.rows);
  return result;
}

} // namespace godwit::operator_bridge
