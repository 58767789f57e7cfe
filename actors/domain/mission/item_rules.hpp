// The rules of a list of items, which missions, assignments and tails share; see rules.hpp. Thread: pure.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "actors/domain/mission/error.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {

// Appends to PROBLEMS what is wrong with ITEMS, which stand at POINTER.
void add_item_problems(std::span<const item> items, const std::string& pointer,
                       std::vector<document_problem>& problems);

// The same for the jumps of a whole mission: each leads to one of ITEMS, not to itself, and none leads for ever through
// items of which none moves the vehicle.
void add_jump_problems(std::span<const item> items, const std::string& pointer,
                       std::vector<document_problem>& problems);

// The same for the position of a return point, and for a planned home.
void add_position_problems(const position& place, const std::string& pointer, std::vector<document_problem>& problems);
void add_position_problems(const planned_home& place, const std::string& pointer,
                           std::vector<document_problem>& problems);

} // namespace godwit::mission
