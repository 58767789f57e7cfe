#include "programs/godwit-sim/missions/delivered_table.hpp"

namespace godwit::sim::missions {

using io::sqlite::statement;

bool put_row(service_file& file, const std::string& mission_id, row_kind kind, const std::string& id,
             const std::string& text) {
  const auto deliveries = file.number("INSERT INTO delivered(mission_id, kind, id, text) VALUES (?1, ?2, ?3, ?4) "
                                      "ON CONFLICT(mission_id, kind, id) DO UPDATE SET deliveries = deliveries + 1, "
                                      "differing = differing + (text <> excluded.text) RETURNING deliveries",
                                      mission_id, io::name_of(kind), id, text);
  return deliveries == 1;
}

std::optional<std::string> row_text(service_file& file, const std::string& mission_id, row_kind kind,
                                    const std::string& id) {
  return file.first_row(
      "SELECT text FROM delivered WHERE mission_id = ?1 AND kind = ?2 AND id = ?3",
      [](const statement& row) { return row.text(0); }, mission_id, io::name_of(kind), id);
}

std::vector<stored_row> rows_of(service_file& file, const std::string& mission_id, row_kind kind) {
  std::vector<stored_row> all;
  file.each_row(
      "SELECT id, text, deliveries FROM delivered WHERE mission_id = ?1 AND kind = ?2 ORDER BY seq",
      [&](const statement& row) {
        all.push_back({row.text(0), row.text(1), static_cast<std::uint64_t>(row.integer(2))});
      },
      mission_id, io::name_of(kind));
  return all;
}

std::map<row_kind, row_figures> row_counts(service_file& file) {
  std::map<row_kind, row_figures> all;
  file.each_row("SELECT kind, COUNT(*), SUM(deliveries - 1), SUM(differing) FROM delivered GROUP BY kind",
                [&](const statement& row) {
                  if (const auto kind = io::value_of<row_kind>(row.text(0)))
                    all[*kind] = {static_cast<std::uint64_t>(row.integer(1)),
                                  static_cast<std::uint64_t>(row.integer(2)),
                                  static_cast<std::uint64_t>(row.integer(3))};
                });
  return all;
}

} // namespace godwit::sim::missions
