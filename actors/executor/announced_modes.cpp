#include "actors/executor/announced_modes.hpp"

#include "actors/domain/control_authority/mode_tables.hpp"

namespace godwit::executor {

std::vector<std::uint32_t> announced_modes(task_kind kind, const steps& way, std::size_t at,
                                           const flight::mode_owner& whose) {
  if (kind == task_kind::start)
    return {};
  for (auto i = at; i < way.size(); ++i) {
    if (std::holds_alternative<start_plan>(way[i]))
      return flight::modes_of_start(whose);
    if (const auto* mode = std::get_if<change_mode>(&way[i]))
      return flight::modes_obeying(whose, mode->to);
  }
  return {};
}

} // namespace godwit::executor
