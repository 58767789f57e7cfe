#include "programs/godwitd/outbox_listing.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "actors/domain/mission/utc_text.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "runtime/journal/sqlite_error.hpp"

namespace godwit::daemon {

namespace {

using runtime::delivery_state;

constexpr const char* owed_rows =
    "SELECT idempotency_key, destination, body, created_ns, state, tries, last_error, next_try_ns, first_failure_ns "
    "FROM outbox WHERE actor = 'mission_client' AND state <> 'delivered' "
    "AND NOT (state <> 'pending' AND destination IN ('waypoint', 'tail')) " // a change that failed is over
    "ORDER BY created_ns, idempotency_key LIMIT ";

std::string_view word_of(delivery_state state) {
  switch (state) {
  case delivery_state::orphaned:
    return "orphaned";
  case delivery_state::expired:
    return "expired";
  case delivery_state::delivered:
    return "delivered";
  case delivery_state::pending:
    break;
  }
  return "pending";
}

delivery_state state_of(std::string_view word) {
  return word == "orphaned"  ? delivery_state::orphaned
         : word == "expired" ? delivery_state::expired
                             : delivery_state::pending;
}

std::string mission_of(const std::string& body) {
  const auto document = nlohmann::json::parse(body, nullptr, false);
  const auto found = document.is_object() ? document.find("mission_id") : document.end();
  return found != document.end() && found->is_string() ? found->get<std::string>() : std::string();
}

listed_row row_of(const io::sqlite::statement& row) {
  listed_row result{{row.text(0), row.text(1), row.text(2), row.integer(3), state_of(row.text(4)), row.integer(5),
                     row.text(6), row.integer(7), row.integer(8)},
                    {}};
  result.mission_id = mission_of(result.row.body);
  return result;
}

bool is_tried(const runtime::outbox_row& row) { return row.state == delivery_state::pending; }

} // namespace

tl::expected<outbox_listing, std::string> read_outbox(const std::string& journal) {
  auto reader = runtime::journal_reader::open(journal);
  if (!reader)
    return tl::make_unexpected(reader.error().message());
  const auto failed = [&](const io::sqlite::error& why) {
    return tl::make_unexpected(runtime::from_sqlite(why, journal, "reading the outbox").message());
  };
  outbox_listing result;
  auto query = reader->database().prepare(owed_rows + std::to_string(max_listed_rows + 1));
  if (!query)
    return failed(query.error());
  auto row = query->step();
  for (; row && *row; row = query->step())
    result.rows.push_back(row_of(*query));
  if (!row)
    return failed(row.error());
  result.is_cut = result.rows.size() > max_listed_rows;
  if (result.is_cut)
    result.rows.pop_back();
  const auto delivered = reader->database().query_integer(
      "SELECT count(*) FROM outbox WHERE actor = 'mission_client' AND state = 'delivered'");
  if (!delivered)
    return failed(delivered.error());
  result.delivered = *delivered;
  return result;
}

std::string table_of(const outbox_listing& listing, std::int64_t now_ns) {
  std::string result;
  for (const auto& [row, mission_id] : listing.rows) {
    result += row.idempotency_key + "  " + std::string(word_of(row.state)) + "  " + row.destination + ", mission " +
              (mission_id.empty() ? "not known" : mission_id) + ", " + duration_text(now_ns - row.created_ns) +
              " old, tried " + std::to_string(row.tries) + (row.tries == 1 ? " time" : " times");
    if (is_tried(row))
      result +=
          row.next_try_ns <= now_ns ? ", next try now" : ", next try in " + duration_text(row.next_try_ns - now_ns);
    result += '\n';
    if (!row.last_error.empty())
      result += "    " + row.last_error + '\n';
  }
  result += listing.rows.empty() ? "nothing is pending" : std::to_string(listing.rows.size()) + " pending";
  if (listing.is_cut)
    result += ", and more that are not shown";
  return result + "; " + std::to_string(listing.delivered) + " delivered and still kept\n";
}

nlohmann::json json_of(const outbox_listing& listing, std::int64_t now_ns) {
  auto rows = nlohmann::json::array();
  for (const auto& [row, mission_id] : listing.rows) {
    nlohmann::json each{{"key", row.idempotency_key},
                        {"destination", row.destination},
                        {"mission_id", mission_id.empty() ? nlohmann::json(nullptr) : nlohmann::json(mission_id)},
                        {"state", word_of(row.state)},
                        {"tries", row.tries},
                        {"last_error", row.last_error},
                        {"created", mission::utc_text(row.created_ns)},
                        {"age_s", (now_ns - row.created_ns) / 1'000'000'000},
                        {"next_try", nullptr}};
    if (is_tried(row))
      each["next_try"] = mission::utc_text(row.next_try_ns);
    rows.push_back(std::move(each));
  }
  return {{"rows", std::move(rows)}, {"delivered", listing.delivered}, {"is_cut", listing.is_cut}};
}

std::string duration_text(std::int64_t duration_ns) {
  const auto tenths = std::max<std::int64_t>(duration_ns, 0) / 100'000'000;
  const auto seconds = tenths / 10;
  const auto minutes = seconds / 60;
  const auto hours = minutes / 60;
  if (tenths > 0 && seconds < 10)
    return std::to_string(seconds) + "." + std::to_string(tenths % 10) + " s";
  if (minutes < 2)
    return std::to_string(seconds) + " s";
  if (hours < 1)
    return std::to_string(minutes) + " min";
  if (hours < 48)
    return std::to_string(hours) + " h" + (minutes % 60 == 0 ? "" : " " + std::to_string(minutes % 60) + " min");
  return std::to_string(hours / 24) + " days";
}

} // namespace godwit::daemon
