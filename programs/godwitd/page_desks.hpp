// What the page of operators needs beside commands: the actors that ask for it, and their routes. Thread: that of the
// composition.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "programs/godwitd/flight_actors.hpp"
#include "programs/godwitd/operator_port/mission_desk.hpp"
#include "programs/godwitd/operator_port/route.hpp"
#include "programs/godwitd/operator_port/view_desk.hpp"
#include "programs/godwitd/settings.hpp"
#include "runtime/system.hpp"

namespace godwit::daemon {

struct page_desks {
  operator_port::view_inlet views;
  operator_port::mission_inlet missions;
  mission::allowed_commands allowed_commands; // that an uploaded mission may hold
};

using answers_ptr = std::shared_ptr<operator_port::waiting_answers>;

[[nodiscard]] page_desks add_page_desks(runtime::system& actors, const daemon_settings& settings,
                                        const base_actors& base, const flight_actors& flight,
                                        const answers_ptr& answers);

[[nodiscard]] operator_port::route_list page_desk_routes(runtime::system& actors, const page_desks& desks,
                                                         const answers_ptr& answers);

// Of the file of tiles; that there is none is an answer, too. WARN: it can not be used, as a sentence.
[[nodiscard]] operator_port::route_list tile_routes_of(const operator_port::settings& wanted,
                                                       const std::function<void(const std::string& sentence)>& warn);

} // namespace godwit::daemon
