#include "programs/godwit-sim/missions/pages.hpp"

#include <array>
#include <charconv>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"

namespace godwit::sim::missions {
namespace {

using io::sqlite::statement;

struct kind_row {
  std::string_view list; // name of the list in the body
  std::string_view last; // SQL: the last row that there is
  std::string_view rows; // SQL: mission, after, last, limit
};

constexpr kind_row map_object_rows{
    "map_objects", "SELECT COALESCE(MAX(seq), 0) FROM map_objects WHERE mission_id = ?1",
    "SELECT seq, text FROM map_objects WHERE mission_id = ?1 AND seq > ?2 AND seq <= ?3 ORDER BY seq LIMIT ?4"};
constexpr kind_row ignored_item_rows{
    "ignored_items", "SELECT COALESCE(MAX(seq), 0) FROM delivered WHERE mission_id = ?1 AND kind = 'ignored_item'",
    "SELECT seq, text FROM delivered WHERE mission_id = ?1 AND kind = 'ignored_item' AND seq > ?2 AND seq <= ?3 "
    "ORDER BY seq LIMIT ?4"};

// What is in a page besides its rows.
constexpr std::size_t max_frame_bytes = 2048;

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

std::optional<std::string> page(service_file& file, const mission_row& of, page_kind kind, const std::string& next,
                                std::uint64_t limit) {
  const auto& how = kind == page_kind::map_objects ? map_object_rows : ignored_item_rows;
  const auto epoch = kind == page_kind::map_objects ? of.map_epoch : 0;
  const auto last = file.number(how.last, of.mission_id).value_or(0);
  const auto given = next.empty() ? page_place{epoch, 0, last} : parse_page_place(next);
  if (!given || given->epoch != epoch || given->after > given->last || given->last > last)
    return std::nullopt;
  auto place = *given;
  std::string rows;
  std::uint64_t count = 0;
  bool is_full = false;
  file.each_row(
      how.rows,
      [&](const statement& row) {
        auto text = row.text(1);
        is_full = is_full || count == limit || rows.size() + text.size() + max_frame_bytes > mission::max_page_bytes;
        if (is_full)
          return;
        rows.append(count == 0 ? "" : ",").append(text);
        place.after = row.integer(0);
        ++count;
      },
      of.mission_id, place.after, place.last, limit + 1); // one more tells whether this page is the last
  std::string body =
      R"({"schema_version":")" + std::string(mission::schema_version) + R"(",")" + std::string(how.list) + R"(":[)";
  body.append(rows).append("]");
  if (is_full)
    body.append(R"(,"next":")").append(text_of(place)).append("\"");
  return body + "}";
}

void replace_map_objects(service_file& file, const std::string& mission_id,
                         const std::vector<mission::map_object>& objects) {
  file.run("DELETE FROM map_objects WHERE mission_id = ?1", mission_id);
  for (const auto& each : objects)
    file.run("INSERT INTO map_objects(mission_id, text) VALUES (?1, ?2)", mission_id, mission::to_text(each));
  file.run("UPDATE missions SET map_epoch = map_epoch + 1 WHERE mission_id = ?1", mission_id);
}

std::uint64_t map_object_count(service_file& file, const std::string& mission_id) {
  return static_cast<std::uint64_t>(
      file.number("SELECT COUNT(*) FROM map_objects WHERE mission_id = ?1", mission_id).value_or(0));
}

} // namespace godwit::sim::missions
