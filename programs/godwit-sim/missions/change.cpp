#include "programs/godwit-sim/missions/change.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>

#include "actors/domain/mission/rules.hpp"

namespace godwit::sim::missions {

tl::expected<mission::document, change_error> changed_mission(const mission::document& old,
                                                              const std::optional<std::string>& after,
                                                              const std::vector<mission::item>& new_items, behind rest,
                                                              const std::string& pointer, bool is_list) {
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
  if (rest == behind::keep)
    changed.items.insert(changed.items.end(), place, old.items.end());

  std::set<std::string_view> kept;
  for (auto each = old.items.begin(); each != old.items.end(); ++each)
    if (rest == behind::keep || each < place)
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

} // namespace godwit::sim::missions
