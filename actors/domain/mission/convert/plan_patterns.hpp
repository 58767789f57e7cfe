// The patterns of a ground station's plan ("ComplexItem") to items of a mission; see plan_import.hpp. Thread: pure.
#pragma once

#include "actors/domain/mission/convert/item_import.hpp"
#include "actors/domain/mission/convert/plan_source.hpp"

namespace godwit::mission {

// A "SimpleItem"; nothing when it can not be read, and SOURCE has the problem.
[[nodiscard]] std::optional<vehicle_item> read_simple_item(plan_source& source, const plan_node& node);

void import_pattern(plan_source& source, const plan_node& node, item_importer& importer);

} // namespace godwit::mission
