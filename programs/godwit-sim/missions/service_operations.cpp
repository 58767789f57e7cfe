#include "programs/godwit-sim/missions/service_operations.hpp"

#include "actors/domain/mission/convert/conversion.hpp"
#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/rules.hpp"
#include "actors/domain/mission/utc_text.hpp"
#include "actors/domain/mission/write.hpp"
#include "programs/godwit-sim/missions/assignment_table.hpp"
#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/mission_table.hpp"

namespace godwit::sim::missions::service_operations {
namespace {

std::string sentence_of(std::vector<mission::document_problem> problems) {
  return mission::bounded({mission::document_errc::broken_rule, std::move(problems)}, {}).message();
}

std::string sentence_of(const change_error& error) {
  if (const auto* missing = std::get_if<missing_item>(&error))
    return "the mission has no item " + mission::in_quotes(missing->id);
  return sentence_of(std::get<1>(error));
}

// One transaction, of which nothing is left when WHAT gives a sentence.
template <class What>
done in_transaction(service_file& file, const What& what) {
  file.begin();
  done result = what();
  const bool is_done = result && file.commit();
  if (!is_done)
    file.rollback();
  if (auto failed = file.take_error(); !failed.empty())
    return tl::unexpected("the file of the service: " + failed);
  return result;
}

// The same, when the mission is there. WHAT gets its row.
template <class What>
done for_mission(service_file& file, const std::string& mission_id, const What& what) {
  return in_transaction(file, [&]() -> done {
    const auto row = find_mission(file, mission_id);
    if (!row || row->deleted_at)
      return tl::unexpected((row ? "the mission was deleted: " : "there is no mission ") + mission_id);
    return what(*row);
  });
}

// What people ask for must keep the schema as well as what a vehicle sends.
tl::expected<mission::assignment, std::string> filled_in(const mission_row& of, const assignment_request& wanted,
                                                         std::uint64_t seed) {
  mission::assignment made;
  made.base_revision = wanted.base_revision.value_or(static_cast<std::int32_t>(of.revision));
  made.revision = wanted.revision.value_or(static_cast<std::int32_t>(of.last_revision + 1));
  made.assignment_id = wanted.assignment_id.value_or(
      mission::uuid_of_text(std::to_string(seed) + " " + of.mission_id + " " + std::to_string(made.revision)));
  made.replace_after_item_id = wanted.replace_after_item_id;
  made.items = wanted.items;
  if (const auto judged = mission::read<mission::assignment>(mission::to_text(made)); !judged)
    return tl::unexpected(judged.error().message());
  if (made.revision <= of.last_revision)
    return tl::unexpected("revision " + std::to_string(made.revision) + " is not above " +
                          std::to_string(of.last_revision) + ", the last one of the mission and its assignments");
  return made;
}

done put_assignment(service_file& file, const mission_row& of, const mission::assignment& made) {
  if (made.base_revision == of.revision) {
    const auto fits = changed_mission(stored_mission(file, of.mission_id), made.replace_after_item_id, made.items,
                                      rest_of_items::replace, "/items");
    if (!fits)
      return tl::unexpected(sentence_of(fits.error()));
  }
  if (auto reused = note_items(file, of.mission_id, made.items, "/items"); !reused.empty())
    return tl::unexpected(sentence_of(std::move(reused)));
  add_assignment(file, of.mission_id, made);
  return {};
}

} // namespace

done add_mission(service_file& file, const mission::document& mission) {
  return in_transaction(file, [&]() -> done {
    if (find_mission(file, mission.mission_id))
      return tl::unexpected("there is a mission " + mission.mission_id + " already, or there was one");
    if (auto broken = mission::broken_rules(mission); !broken.empty())
      return tl::unexpected(sentence_of(std::move(broken)));
    missions::add_mission(file, mission);
    return {};
  });
}

done delete_mission(service_file& file, const std::string& mission_id, std::int64_t now_ns) {
  return in_transaction(file, [&]() -> done {
    if (!find_mission(file, mission_id))
      return tl::unexpected("there is no mission " + mission_id);
    missions::delete_mission(file, mission_id, mission::utc_text(now_ns));
    return {};
  });
}

tl::expected<mission::assignment, std::string> assign(service_file& file, const std::string& mission_id,
                                                      const assignment_request& wanted, std::uint64_t seed) {
  mission::assignment made;
  auto put = for_mission(file, mission_id, [&](const mission_row& row) -> done {
    auto filled = filled_in(row, wanted, seed);
    if (!filled)
      return tl::unexpected(std::move(filled.error()));
    made = *std::move(filled);
    return put_assignment(file, row, made);
  });
  if (!put)
    return tl::unexpected(std::move(put.error()));
  return made;
}

done set_map_objects(service_file& file, const std::string& mission_id,
                     const std::vector<mission::map_object>& objects) {
  const mission::map_object_page as_page{std::string(mission::schema_version), objects, {}};
  if (auto broken = mission::broken_rules(as_page); !broken.empty())
    return tl::unexpected(sentence_of(std::move(broken)));
  return for_mission(file, mission_id, [&](const mission_row&) -> done {
    replace_map_objects(file, mission_id, objects);
    return {};
  });
}

done add_ignored_items(service_file& file, const std::string& mission_id,
                       const std::vector<mission::ignored_item>& items) {
  return for_mission(file, mission_id, [&](const mission_row&) -> done {
    for (const auto& each : items)
      put_row(file, mission_id, row_kind::ignored_item, each.ignored_id, mission::to_text(each));
    return {};
  });
}

} // namespace godwit::sim::missions::service_operations
