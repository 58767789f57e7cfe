#include "actors/mapobjects_store/deliveries.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "actors/mapobjects_store/input_check.hpp"
#include "actors/mapobjects_store/sightings.hpp"
#include "messages/mapobjects_store/delivery.hpp"

namespace godwit::mapobjects_store {

namespace {

// The same steps on two pairs of tables, as rows of one table.
struct delivery_statements {
  const char* count_pending;
  const char* take;
  const char* leave_queue;
  const char* orphans_are_delivered; // the answer came after all
  const char* drop_orphans;
  const char* give_back;
  const char* give_orphans_back;
};

constexpr delivery_statements observation_statements{
    .count_pending = "SELECT count(*) FROM observation WHERE mission_id = ? AND delivery = 'pending'",
    .take = "UPDATE observation SET delivery = 'taken', batch = ?1 WHERE number IN (SELECT number FROM observation "
            "WHERE mission_id = ?2 AND delivery = 'pending' ORDER BY number LIMIT ?3)",
    .leave_queue = "UPDATE observation SET delivery = 'delivered', batch = NULL WHERE batch = ?",
    .orphans_are_delivered = "INSERT INTO observation SELECT number, id, mission_id, object_id, kind, class_group, "
                             "latitude_deg, longitude_deg, altitude_m, at_ns, confidence, 'delivered', NULL "
                             "FROM orphaned_observation WHERE batch = ?",
    .drop_orphans = "DELETE FROM orphaned_observation WHERE batch = ?",
    .give_back = "UPDATE observation SET delivery = 'pending', batch = NULL WHERE batch = ?",
    .give_orphans_back = "INSERT INTO observation SELECT number, id, mission_id, object_id, kind, class_group, "
                         "latitude_deg, longitude_deg, altitude_m, at_ns, confidence, 'pending', NULL "
                         "FROM orphaned_observation WHERE batch = ?"};

// The row of an ignored item is also the entry of the ignore list, which an orphan stays.
constexpr delivery_statements ignored_item_statements{
    .count_pending = "SELECT count(*) FROM ignored_item WHERE mission_id = ? AND delivery = 'pending'",
    .take = "UPDATE ignored_item SET delivery = 'taken', batch = ?1 WHERE number IN (SELECT number FROM ignored_item "
            "WHERE mission_id = ?2 AND delivery = 'pending' ORDER BY number LIMIT ?3)",
    .leave_queue = "UPDATE ignored_item SET delivery = 'delivered', batch = NULL WHERE batch = ?",
    .orphans_are_delivered = "UPDATE ignored_item SET delivery = 'delivered' WHERE generation = 0 AND id IN "
                             "(SELECT id FROM orphaned_ignored_item WHERE batch = ?)",
    .drop_orphans = "DELETE FROM orphaned_ignored_item WHERE batch = ?",
    .give_back = "UPDATE ignored_item SET delivery = 'pending', batch = NULL WHERE batch = ?",
    .give_orphans_back = "INSERT INTO ignored_item SELECT number, id, 0, mission_id, mgrs_cell, class_group, since_ns, "
                         "'pending', NULL FROM orphaned_ignored_item WHERE batch = ? "
                         "ON CONFLICT DO UPDATE SET delivery = 'pending'"};

const delivery_statements& statements_of(destination to) {
  return to == destination::observations ? observation_statements : ignored_item_statements;
}

struct known_batch {
  std::int64_t number = 0;
  std::string mission_id;
  destination to = destination::observations;
  delivery_state state = delivery_state::taken;
};

map_result<std::optional<known_batch>> batch_with(sql& q, const std::string& key) {
  return q.first(
      "SELECT number, mission_id, destination, state FROM batch WHERE key = ?",
      [](sql::row& row) {
        return known_batch{.number = row.integer(0),
                           .mission_id = row.text(1),
                           .to = io::value_of<destination>(row.text(2)).value_or(destination::observations),
                           .state = io::value_of<delivery_state>(row.text(3)).value_or(delivery_state::taken)};
      },
      key);
}

map_result<std::uint64_t> count_pending(sql& q, const take_batch& asked) {
  return q
      .first(
          statements_of(asked.to).count_pending,
          [](sql::row& row) { return static_cast<std::uint64_t>(row.integer(0)); }, asked.mission_id)
      .map([](const auto& count) { return count.value_or(0); });
}

// Takes ROWS pending rows, which are there, under the key; its number.
map_result<std::int64_t> open_new(map_tables& t, const take_batch& asked, std::uint64_t rows) {
  const auto open =
      t.q.first("SELECT count(*) FROM batch WHERE state = 'taken'", [](sql::row& row) { return row.integer(0); });
  if (!open)
    return tl::unexpected(open.error());
  if (open->value_or(0) >= max_open_batches)
    return tl::unexpected(map_error{map_errc::full,
                                    std::to_string(max_open_batches) + " batches are taken and not delivered",
                                    "Deliver those first"});
  auto done = t.q.run("INSERT INTO batch(key, mission_id, destination, rows, state) VALUES (?, ?, ?, ?, ?)", asked.key,
                      asked.mission_id, asked.to, rows, delivery_state::taken);
  if (!done)
    return tl::unexpected(std::move(done.error()));
  auto number = t.q.inserted_number();
  if (number)
    done = t.q.run(statements_of(asked.to).take, *number, asked.mission_id, rows);
  if (!done)
    return tl::unexpected(std::move(done.error()));
  return number;
}

map_result<void> read_rows(sql& q, std::int64_t number, batch& to) {
  if (to.to == destination::observations)
    return q.each(
        "SELECT id, mission_id, object_id, kind, class_group, latitude_deg, longitude_deg, altitude_m, at_ns, "
        "confidence, number FROM observation WHERE batch = ?1 UNION ALL "
        "SELECT id, mission_id, object_id, kind, class_group, latitude_deg, longitude_deg, altitude_m, at_ns, "
        "confidence, number FROM orphaned_observation WHERE batch = ?1 ORDER BY number",
        [&](sql::row& row) { to.observations.push_back(observation_of(row)); }, number);
  return q.each(
      "SELECT id, mission_id, mgrs_cell, class_group, since_ns, number FROM ignored_item WHERE batch = ?1 UNION ALL "
      "SELECT id, mission_id, mgrs_cell, class_group, since_ns, number FROM orphaned_ignored_item WHERE batch = ?1 "
      "ORDER BY number",
      [&](sql::row& row) { to.ignored_items.push_back(ignored_item_of(row)); }, number);
}

map_result<void> check_same(const known_batch& known, const take_batch& asked) {
  if (known.state == delivery_state::delivered)
    return tl::unexpected(
        map_error{map_errc::delivered, "batch " + asked.key + " was delivered", "Take the next one under a new key"});
  if (known.mission_id != asked.mission_id || known.to != asked.to)
    return refused("batch " + asked.key + " is one of " + std::string(io::name_of(known.to)) + " of mission " +
                   known.mission_id);
  return {};
}

// Nothing is under the key any more, which is remembered. STEPS_OF(delivery_statements): what becomes of its rows.
template <class Steps>
map_result<void> close(map_tables& t, const std::string& key, Steps steps_of) {
  const auto known = check_id(key, "key").and_then([&] { return batch_with(t.q, key); });
  if (!known)
    return tl::unexpected(known.error());
  if (!*known || (*known)->state == delivery_state::delivered)
    return {};
  const auto number = (*known)->number;
  for (const auto* each : steps_of(statements_of((*known)->to)))
    if (auto done = t.q.run(each, number); !done)
      return done;
  return t.q.run("UPDATE batch SET state = 'delivered' WHERE number = ?", number).and_then([&] {
    return t.q.run("DELETE FROM batch WHERE state = 'delivered' AND number <= ?", number - max_delivered_keys);
  });
}

// Missions with the number of their rows; one for each state, because each has an index of its own.
struct owed_query {
  destination to;
  std::uint64_t owed::*count;
  const char* text;
};

constexpr owed_query owed_queries[] = {
    {destination::observations, &owed::pending,
     "SELECT mission_id, count(*) FROM observation WHERE delivery = 'pending' GROUP BY mission_id"},
    {destination::observations, &owed::taken,
     "SELECT mission_id, sum(rows) FROM batch WHERE state = 'taken' AND destination = 'observations' "
     "GROUP BY mission_id"},
    {destination::observations, &owed::orphaned,
     "SELECT mission_id, count(*) FROM orphaned_observation GROUP BY mission_id"},
    {destination::ignored_items, &owed::pending,
     "SELECT mission_id, count(*) FROM ignored_item WHERE delivery = 'pending' GROUP BY mission_id"},
    {destination::ignored_items, &owed::taken,
     "SELECT mission_id, sum(rows) FROM batch WHERE state = 'taken' AND destination = 'ignored_items' "
     "GROUP BY mission_id"},
    {destination::ignored_items, &owed::orphaned,
     "SELECT mission_id, count(*) FROM orphaned_ignored_item GROUP BY mission_id"}};

} // namespace

map_result<batch> take(map_tables& t, const take_batch& asked) {
  const auto sound = check_id(asked.key, "key").and_then([&] { return check_id(asked.mission_id, "mission_id"); });
  if (!sound)
    return tl::unexpected(sound.error());
  const auto known = batch_with(t.q, asked.key);
  if (!known)
    return tl::unexpected(known.error());
  const auto pending = count_pending(t.q, asked);
  if (!pending)
    return tl::unexpected(pending.error());
  batch given;
  given.key = asked.key;
  given.mission_id = asked.mission_id;
  given.to = asked.to;
  given.pending_left = *pending;
  map_result<std::int64_t> number = 0;
  if (*known) {
    if (auto same = check_same(**known, asked); !same)
      return tl::unexpected(std::move(same.error()));
    number = (*known)->number;
  } else {
    const auto rows = std::min({*pending, std::uint64_t{asked.limit}, std::uint64_t{max_taken}});
    if (rows == 0)
      return given;
    given.pending_left -= rows;
    number = open_new(t, asked, rows);
  }
  if (!number)
    return tl::unexpected(number.error());
  if (auto read = read_rows(t.q, *number, given); !read)
    return tl::unexpected(std::move(read.error()));
  return given;
}

map_result<std::vector<open_batch>> all_open(sql& q) {
  std::vector<open_batch> found;
  auto done = q.each(
      "SELECT key, mission_id, destination, rows, state = 'orphaned' FROM batch "
      "WHERE state != 'delivered' ORDER BY number LIMIT ?",
      [&](sql::row& row) {
        found.push_back({.key = row.text(0),
                         .mission_id = row.text(1),
                         .to = io::value_of<destination>(row.text(2)).value_or(destination::observations),
                         .rows = static_cast<std::uint64_t>(row.integer(3)),
                         .orphaned = row.integer(4) != 0});
      },
      max_listed_batches);
  if (!done)
    return tl::unexpected(std::move(done.error()));
  return found;
}

map_result<void> deliver(map_tables& t, const batch_delivered& said) {
  return close(t, said.key, [](const delivery_statements& all) {
    return std::array{all.leave_queue, all.orphans_are_delivered, all.drop_orphans};
  });
}

map_result<void> give_back(map_tables& t, const return_batch& said) {
  return close(t, said.key, [](const delivery_statements& all) {
    return std::array{all.give_back, all.give_orphans_back, all.drop_orphans};
  });
}

map_result<std::vector<owed>> all_owed(sql& q) {
  std::map<std::pair<destination, std::string>, owed> found;
  for (const auto& query : owed_queries) {
    auto done = q.each(query.text, [&](sql::row& row) {
      auto& line = found[{query.to, row.text(0)}];
      line.*query.count = static_cast<std::uint64_t>(row.integer(1));
    });
    if (!done)
      return tl::unexpected(std::move(done.error()));
  }
  std::vector<owed> lines;
  for (auto& [place, line] : found) {
    line.to = place.first;
    line.mission_id = place.second;
    lines.push_back(std::move(line));
  }
  return lines;
}

observation observation_of(const sql::row& row) {
  observation what;
  what.id = row.text(0);
  what.mission_id = row.text(1);
  if (!row.is_null(2))
    what.object_id = row.text(2);
  what.kind = io::value_of<observation_kind>(row.text(3)).value_or(observation_kind::found);
  what.class_group = row.text(4);
  what.position = {row.real(5), row.real(6), row.is_null(7) ? std::nullopt : std::optional(row.real(7))};
  what.at_ns = row.integer(8);
  what.confidence = row.real(9);
  return what;
}

map_result<std::optional<observation>> observation_with(sql& q, const std::string& id) {
  return q.first("SELECT id, mission_id, object_id, kind, class_group, latitude_deg, longitude_deg, altitude_m, at_ns, "
                 "confidence FROM observation WHERE id = ?1 UNION ALL "
                 "SELECT id, mission_id, object_id, kind, class_group, latitude_deg, longitude_deg, altitude_m, at_ns, "
                 "confidence FROM orphaned_observation WHERE id = ?1",
                 observation_of, id);
}

map_result<std::int64_t> add_observation(sql& q, const observation& what) {
  const auto& at = what.position;
  return q
      .run("INSERT INTO observation(id, mission_id, object_id, kind, class_group, latitude_deg, longitude_deg, "
           "altitude_m, at_ns, confidence, delivery) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
           what.id, what.mission_id, what.object_id, what.kind, what.class_group, at.latitude_deg, at.longitude_deg,
           at.altitude_m, what.at_ns, what.confidence, delivery_state::pending)
      .and_then([&] { return q.inserted_number(); });
}

map_result<bool> was_seen(sql& q, const std::string& object_id, std::int64_t since_ns) {
  auto found = q.first(
      "SELECT 1 FROM observation WHERE object_id = ?1 AND at_ns >= ?2 AND kind != 'removed_candidate' "
      "UNION ALL SELECT 1 FROM orphaned_observation WHERE object_id = ?1 AND at_ns >= ?2 "
      "AND kind != 'removed_candidate'",
      [](sql::row&) { return true; }, object_id, since_ns);
  if (!found)
    return tl::unexpected(std::move(found.error()));
  return found->has_value();
}

} // namespace godwit::mapobjects_store
