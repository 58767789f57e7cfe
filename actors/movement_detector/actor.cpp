#include "actors/movement_detector/actor.hpp"

#include <string>
#include <utility>

#include "io/eyes/codec.hpp"
#include "runtime/content_hash.hpp"
#include "runtime/overloaded.hpp"

namespace godwit::movement_detector {

actor::actor(runtime::spawn_context context, settings configured, std::shared_ptr<const peers> others,
             std::shared_ptr<eyes_port> port, std::uint64_t seed)
    : actor_base(std::move(context)), others_(std::move(others)), port_(std::move(port)),
      core_(std::move(configured), seed, incarnation_number()) {}

actor::~actor() { port_->end(core_.run()); }

actor::behavior_type actor::handlers() {
  return {
      on<helper_status>([this](const helper_status& m) { execute(core_.on_status(m, now())); }),
      on<helper_candidates>([this](const helper_candidates& m) { execute(core_.on_candidates(m, now())); }),
      on<helper_ended>([this](const helper_ended& m) { execute(core_.on_ended(m, now())); }),
      on<get_eyes>([this](const get_eyes&) { return core_.view_of(now()); }),
      on<scan_controller::survey_progress>([this](const scan_controller::survey_progress& m) { core_.on_survey(m); }),
      on<io::mavlink::global_position_int>(
          [this](const io::mavlink::global_position_int& m) { core_.on_position(m, now()); }),
      on<io::mavlink::attitude>([this](const io::mavlink::attitude& m) { execute(core_.on_attitude(m, now())); }),
      on<io::mavlink::gimbal_device_attitude_status>(
          [this](const io::mavlink::gimbal_device_attitude_status& m) { execute(core_.on_gimbal(m, now())); })};
}

void actor::started() { wake_at(core_.next_due_ns()); }

void actor::on_deadline() { execute(core_.on_time(now())); }

// What goes to the helper and to the map's pictures; the settings of the camera may have a password in them.
void actor::note_calls(const effects& all) {
  using runtime::empty_hash;
  for (const auto& each : all)
    std::visit(
        runtime::overloaded{
            [this](const start_helper& what) { note_call("start helper " + std::to_string(what.run), empty_hash); },
            [this](const end_helper& which) { note_call("end helper " + std::to_string(which.upto), empty_hash); },
            [this](const io::eyes::pose& where) { note_call("pose", runtime::content_hash(io::eyes::encode(where))); },
            [this](const keep_picture& which) { note_call("keep picture of " + which.sighting_id, empty_hash); },
            [](const auto&) {}}, // goes as a message, or is a sentence for people
        each);
}

void actor::execute(effects all) {
  if (is_recorded())
    note_calls(all);
  for (auto& each : all)
    std::visit(
        runtime::overloaded{[this](start_helper& what) {
                              at_end([port = port_, what = std::move(what)] { port->start(what.run, what.how); });
                            },
                            [this](end_helper& which) { at_end([port = port_, which] { port->end(which.upto); }); },
                            [this](io::eyes::pose& where) { at_end([port = port_, where] { port->tell(where); }); },
                            [this](keep_picture& which) {
                              at_end([port = port_, which = std::move(which)] {
                                port->keep_picture(which.track, which.captured_ns, which.sighting_id);
                              });
                            },
                            [this](mapobjects_store::sighting& seen) { tell(others_->sightings, std::move(seen)); },
                            [this](scan_controller::view& how) { tell(others_->scan, std::move(how)); },
                            [this](announce& said) {
                              at_end([others = others_, said = std::move(said)] {
                                others->say(said.sentence, said.is_warning);
                              });
                            }},
        each);
  show_health(core_.health(now()));
  wake_at(core_.next_due_ns());
}

} // namespace godwit::movement_detector
