#include "programs/godwit-sim/missions/mission_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/rules.hpp"
#include "actors/domain/mission/write.hpp"
#include "io/fields/json_value.hpp"
#include "io/text.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim::missions {

using io::sqlite::statement;

std::optional<mission_row> find_mission(service_file& file, const std::string& mission_id) {
  return file.first_row(
      "SELECT revision, last_revision, last_report_no, map_epoch, deleted_at FROM missions WHERE mission_id = ?1",
      [&](const statement& row) {
        return mission_row{.mission_id = mission_id,
                           .revision = row.integer(0),
                           .last_revision = row.integer(1),
                           .last_report_no = row.integer(2),
                           .map_epoch = row.integer(3),
                           .deleted_at = row.is_null(4) ? std::nullopt : std::optional(row.text(4))};
      },
      mission_id);
}

std::vector<std::string> live_missions(service_file& file) {
  std::vector<std::string> all;
  file.each_row("SELECT mission_id FROM missions WHERE deleted_at IS NULL ORDER BY rowid",
                [&](const statement& row) { all.push_back(row.text(0)); });
  return all;
}

std::string mission_text(service_file& file, const std::string& mission_id) {
  return file
      .first_row(
          "SELECT text FROM missions WHERE mission_id = ?1", [](const statement& row) { return row.text(0); },
          mission_id)
      .value_or(std::string());
}

// What lies in the file was judged before it was put there.
mission::document stored_mission(service_file& file, const std::string& mission_id) {
  mission::document stored;
  const auto text = mission_text(file, mission_id);
  if (file.has_failed())
    return stored;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  GODWIT_ASSERT(io::read_json(json, stored).has_value(), "the mission in the file is one");
  return stored;
}

void add_mission(service_file& file, const mission::document& mission) {
  file.run("INSERT INTO missions(mission_id, revision, last_revision, text) VALUES (?1, ?2, ?2, ?3)",
           mission.mission_id, mission.revision, mission::to_text(mission));
  static_cast<void>(note_items(file, mission.mission_id, mission.items, {})); // there were none before
}

void replace_mission(service_file& file, const mission::document& mission) {
  file.run("UPDATE missions SET revision = ?2, last_revision = MAX(last_revision, ?2), text = ?3 WHERE mission_id = ?1",
           mission.mission_id, mission.revision, mission::to_text(mission));
}

void delete_mission(service_file& file, const std::string& mission_id, const std::string& at) {
  file.run("UPDATE missions SET deleted_at = ?2 WHERE mission_id = ?1 AND deleted_at IS NULL", mission_id, at);
}

void set_last_report(service_file& file, const std::string& mission_id, std::int64_t last) {
  file.run("UPDATE missions SET last_report_no = ?2 WHERE mission_id = ?1", mission_id, last);
}

bool knows_item(service_file& file, const std::string& mission_id, const std::string& item_id) {
  return file.number("SELECT 1 FROM items WHERE mission_id = ?1 AND item_id = ?2", mission_id, item_id).has_value();
}

std::vector<mission::document_problem> note_items(service_file& file, const std::string& mission_id,
                                                  std::span<const mission::item> items, const std::string& pointer,
                                                  bool is_list) {
  std::vector<mission::document_problem> problems;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto& id = mission::id_of(items[i]);
    std::string text;
    append_json_value(text, items[i]);
    const auto is_same =
        file.number("INSERT INTO items(mission_id, item_id, text) VALUES (?1, ?2, ?3) "
                    "ON CONFLICT(mission_id, item_id) DO UPDATE SET text = items.text RETURNING text = ?3",
                    mission_id, id, text);
    if (is_same && *is_same == 0)
      problems.push_back({mission::pointer_to(is_list ? mission::pointer_to(pointer, i) : pointer, "id"),
                          "is " + mission::in_quotes(id) + ", which was the id of another item",
                          "an id that no other item has or had"});
  }
  return problems;
}

tl::expected<mission::document, change_error> changed_mission(const mission::document& old,
                                                              const std::optional<std::string>& after,
                                                              const std::vector<mission::item>& new_items,
                                                              rest_of_items rest, const std::string& pointer,
                                                              bool is_list) {
  auto place = old.items.begin();
  if (after) {
    place = std::ranges::find(old.items, *after, mission::id_of);
    if (place == old.items.end())
      return tl::unexpected(change_error(missing_item{*after}));
    ++place;
  }
  mission::document changed = old;
  changed.items.assign(old.items.begin(), place);
  changed.items.insert(changed.items.end(), new_items.begin(), new_items.end());
  if (rest == rest_of_items::keep)
    changed.items.insert(changed.items.end(), place, old.items.end());

  std::set<std::string_view> kept;
  for (auto each = old.items.begin(); each != old.items.end(); ++each)
    if (rest == rest_of_items::keep || each < place)
      kept.insert(mission::id_of(*each));
  std::vector<mission::document_problem> problems;
  for (std::size_t i = 0; i < new_items.size(); ++i)
    if (kept.contains(mission::id_of(new_items[i])))
      problems.push_back({mission::pointer_to(is_list ? mission::pointer_to(pointer, i) : pointer, "id"),
                          "is " + mission::in_quotes(mission::id_of(new_items[i])) + ", which stands in the mission",
                          "an id that no other item has or had"});
  if (problems.empty())
    problems = mission::broken_rules(changed);
  if (!problems.empty())
    return tl::unexpected(change_error(std::move(problems)));
  return changed;
}

namespace {

struct kind_row {
  std::string_view list; // name of the list in the body
  std::string_view last; // SQL: the last row that there is
  std::string_view rows; // SQL: mission, after, last, limit; a row without a text was removed
};

constexpr kind_row map_object_rows{
    "map_objects", "SELECT COALESCE(MAX(seq), 0) FROM map_objects WHERE mission_id = ?1",
    "SELECT seq, text, object_id FROM map_objects WHERE mission_id = ?1 AND seq > ?2 AND seq <= ?3 "
    "AND text IS NOT NULL ORDER BY seq LIMIT ?4"};
constexpr kind_row changed_object_rows{
    "map_objects", map_object_rows.last,
    "SELECT seq, text, object_id FROM map_objects WHERE mission_id = ?1 AND seq > ?2 AND seq <= ?3 "
    "ORDER BY seq LIMIT ?4"};
constexpr kind_row ignored_item_rows{
    "ignored_items", "SELECT COALESCE(MAX(seq), 0) FROM delivered WHERE mission_id = ?1 AND kind = 'ignored_item'",
    "SELECT seq, text FROM delivered WHERE mission_id = ?1 AND kind = 'ignored_item' AND seq > ?2 AND seq <= ?3 "
    "ORDER BY seq LIMIT ?4"};

// What is in a page besides its rows.
constexpr std::size_t max_frame_bytes = 4096;

} // namespace

std::string text_of(const page_place& place) {
  return std::to_string(place.epoch) + "-" + std::to_string(place.after) + "-" + std::to_string(place.last);
}

std::optional<page_place> parse_page_place(std::string_view text) {
  std::array<std::int64_t, 3> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto part = text.substr(0, text.find('-'));
    const auto [end, failed] = std::from_chars(part.data(), part.data() + part.size(), numbers.at(i));
    const bool is_last = i + 1 == numbers.size();
    if (failed != std::errc{} || end != part.data() + part.size() || (part.size() == text.size()) != is_last)
      return std::nullopt;
    text.remove_prefix(is_last ? part.size() : part.size() + 1);
  }
  return page_place{numbers[0], numbers[1], numbers[2]};
}

std::optional<page_made> page(service_file& file, const mission_row& of, page_kind kind, const page_request& asked) {
  const bool has_objects = kind == page_kind::map_objects;
  const auto epoch = has_objects ? of.map_epoch : 0;
  const auto last = file.number(has_objects ? map_object_rows.last : ignored_item_rows.last, of.mission_id).value_or(0);
  // A mark is the number of the last row that was shown; one that is none of ours gets all of the map.
  std::int64_t mark = 0;
  const bool is_change = has_objects && asked.since && io::read_number(*asked.since, mark) && mark >= 0 && mark <= last;
  const auto& how = !has_objects ? ignored_item_rows : is_change ? changed_object_rows : map_object_rows;
  const auto given = asked.next.empty() ? page_place{epoch, is_change ? mark : 0, last} : parse_page_place(asked.next);
  if (!given || given->epoch != epoch || given->after > given->last || given->last > last)
    return std::nullopt;
  auto place = *given;
  std::string rows;
  std::string removed;
  std::uint64_t count = 0;
  bool is_full = false;
  file.each_row(
      how.rows,
      [&](const statement& row) {
        const bool is_removed = row.is_null(1);
        auto text = is_removed ? "\"" + row.text(2) + "\"" : row.text(1);
        is_full = is_full || count == asked.limit ||
                  rows.size() + removed.size() + text.size() + max_frame_bytes > mission::max_page_bytes;
        if (is_full)
          return;
        auto& to = is_removed ? removed : rows;
        to.append(to.empty() ? "" : ",").append(text);
        place.after = row.integer(0);
        ++count;
      },
      of.mission_id, place.after, place.last, asked.limit + 1); // one more tells whether this page is the last
  std::string body =
      R"({"schema_version":")" + std::string(mission::schema_version) + R"(",")" + std::string(how.list) + R"(":[)";
  body.append(rows).append("]");
  const auto following = is_full ? text_of(place) : std::string();
  if (is_full)
    body.append(R"(,"next":")").append(following).append("\"");
  if (is_change)
    body.append(R"(,"since":")").append(*asked.since).append(R"(","removed":[)").append(removed).append("]");
  if (has_objects && asked.since)
    body.append(R"(,"mark":")").append(std::to_string(place.last)).append("\"");
  return page_made{body + "}", following};
}

void replace_map_objects(service_file& file, const std::string& mission_id,
                         const std::vector<mission::map_object>& objects) {
  std::map<std::string, std::string> before;
  file.each_row(
      "SELECT object_id, text FROM map_objects WHERE mission_id = ?1 AND text IS NOT NULL",
      [&](const statement& row) { before.emplace(row.text(0), row.text(1)); }, mission_id);
  for (const auto& each : objects) {
    const auto text = mission::to_text(each);
    const auto there = before.find(each.object_id);
    if (there == before.end() || there->second != text)
      file.run("INSERT OR REPLACE INTO map_objects(mission_id, object_id, text) VALUES (?1, ?2, ?3)", mission_id,
               each.object_id, text);
    if (there != before.end())
      before.erase(there);
  }
  for (const auto& [object_id, text] : before)
    file.run("INSERT OR REPLACE INTO map_objects(mission_id, object_id, text) VALUES (?1, ?2, NULL)", mission_id,
             object_id);
  file.run("UPDATE missions SET map_epoch = map_epoch + 1 WHERE mission_id = ?1", mission_id);
}

std::uint64_t map_object_count(service_file& file, const std::string& mission_id) {
  return static_cast<std::uint64_t>(
      file.number("SELECT COUNT(*) FROM map_objects WHERE mission_id = ?1 AND text IS NOT NULL", mission_id)
          .value_or(0));
}

} // namespace godwit::sim::missions
