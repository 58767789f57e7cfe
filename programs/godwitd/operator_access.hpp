// The operators' port of a godwitd, with what stands behind it: what is shown, the handlers that ask the actors, and
// what the log says of it.
//
//   clients ══ port ── routes ──┬── view_api, stream_api, log_api, pictures, tiles, the page
//                               └── operator_api ── operator_handler, view_handler, mission_handler ── actors
//
// Without the port in the settings nothing of it is there. Thread: one owner, but for `note`.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "actors/operator_bridge/presence.hpp"
#include "io/eyes/helper.hpp"
#include "programs/godwitd/accounts/account_keeper.hpp"
#include "programs/godwitd/control/port_view.hpp"
#include "programs/godwitd/flight_actors.hpp"
#include "programs/godwitd/operator_port/mission_handler.hpp"
#include "programs/godwitd/operator_port/operator_api.hpp"
#include "programs/godwitd/operator_port/operator_port.hpp"
#include "programs/godwitd/operator_port/router.hpp"
#include "programs/godwitd/operator_port/stream_api.hpp"
#include "programs/godwitd/operator_port/view_api.hpp"
#include "programs/godwitd/operator_port/view_handler.hpp"
#include "programs/godwitd/settings.hpp"
#include "programs/godwitd/sightings/point_pictures.hpp"
#include "programs/godwitd/view_actors.hpp"
#include "runtime/process.hpp"
#include "runtime/system.hpp"

namespace godwit::daemon {

// What the page of operators needs beside commands: the actors that ask for it, and their routes. Thread: that of the
// composition.
struct page_handlers {
  operator_port::view_inlet views;
  operator_port::mission_inlet missions;
  mission::allowed_commands allowed_commands; // that an uploaded mission may hold
};

using answers_ptr = std::shared_ptr<operator_port::waiting_answers>;

[[nodiscard]] page_handlers add_page_handlers(runtime::system& actors, const daemon_settings& settings,
                                              const base_actors& base, const flight_actors& flight,
                                              const answers_ptr& answers);

[[nodiscard]] operator_port::route_list page_handler_routes(runtime::system& actors, const page_handlers& handlers,
                                                            const answers_ptr& answers);

// Of the file of tiles; that there is none is an answer, too. WARN: it can not be used, as a sentence.
[[nodiscard]] operator_port::route_list tile_routes_of(const operator_port::settings& wanted,
                                                       const std::function<void(const std::string& sentence)>& warn);

class operator_access {
public:
  // What it shows beside what actors say. All may be null.
  struct sources {
    std::shared_ptr<io::eyes::helper> eyes;
    std::shared_ptr<point_pictures> pictures;
    accounts::account_keeper* keeper = nullptr; // none: there are no operators, and nobody commands
    std::shared_ptr<operator_bridge::session_ends> session_ends;
  };
  using sayer = std::function<void(const std::string& sentence, bool is_warning)>;

  explicit operator_access(bool uses_tls) : answers_(std::make_shared<operator_port::waiting_answers>(uses_tls)) {}

  // Before the actors start; in a daemon that flies. PICTURED_POINTS: which the camera has shown; empty: there is none.
  void add_handlers(runtime::system& actors, const daemon_settings& wanted, const base_actors& base,
                    const flight_actors& flight, std::function<std::vector<std::uint64_t>()> pictured_points,
                    audit_source audit);
  // A port that is taken is said, and is no reason not to fly. HOST and SAY outlive it.
  void open(runtime::process& host, const operator_port::settings& wanted, const view_surroundings& shown,
            const view_actors& views, sources from, sayer say);
  void end_answers() { answers_->end(); } // who waits for an actor is answered
  void close();
  void read_certificate_anew() { port_.read_certificate_anew(); }

  // What was logged, for who opens the page later. Any thread.
  void note(telemetry_stream::text_ptr line) { log_api_->add(std::move(line)); }
  // Where the port is, for who asks at the control socket.
  [[nodiscard]] std::shared_ptr<const control::port_view> view() const { return view_; }

private:
  void make_apis(runtime::process& host, const view_surroundings& shown, const view_actors& views);
  [[nodiscard]] operator_port::route_list shown_routes(runtime::process& host, const operator_port::settings& wanted,
                                                       sources from, const sayer& say);
  // What people may do, and who may.
  [[nodiscard]] operator_port::port_guards add_commands(runtime::process& host, accounts::account_keeper& keeper,
                                                        operator_port::route_list& routes);
  void tell(const sayer& say);
  void tell_certificate(const tl::expected<std::string, std::string>& now, const sayer& say);

  operator_port::port port_;
  std::shared_ptr<operator_port::waiting_answers> answers_;
  std::shared_ptr<operator_port::log_api> log_api_ = std::make_shared<operator_port::log_api>();
  std::shared_ptr<control::port_view> view_ = std::make_shared<control::port_view>();
  std::shared_ptr<operator_port::view_api> view_api_;           // none before open
  std::shared_ptr<operator_port::stream_api> stream_api_;       // the same
  std::shared_ptr<operator_port::operator_api> operator_api_;   // the same, and without a flight
  operator_port::request_inlet handler_;                        // none without a flight
  page_handlers page_handlers_;                                 // the same
  std::shared_ptr<operator_bridge::session_ends> session_ends_; // none before open
};

} // namespace godwit::daemon
