// Asks for what people look at: GET /api/v1/plan and GET /api/v1/preflight of the executor, GET /api/v1/map/objects of
// the map.
//
//   request ──ticket──> view_handler ──get_plan, get_preflight──> executor ──────────> view as JSON ──> answer
//                                 ──get_objects──────────────> mapobjects_store ──>
//
//   /api/v1/map/objects?bbox=WEST,SOUTH,EAST,NORTH&limit=N     in degrees; both can be left out
//
// It causes nothing, nothing waits for it, and it is not essential. Errors: 400, 503 and 504. Thread: as actor_base.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"
#include "messages/executor/handle.hpp"
#include "messages/mapobjects_store/handle.hpp"
#include "programs/godwitd/operator_port/router.hpp"
#include "programs/godwitd/operator_port/waiting_answers.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::operator_port {

enum class view_kind { plan, preflight, objects };

GODWIT_ENUM_NAMES(view_kind, plan, preflight, objects);

struct view_request {
  std::uint64_t ticket = 0;
  view_kind what = view_kind::plan;
  mapobjects_store::get_objects objects = {}; // of `objects`
  GODWIT_FIELDS(view_request, "operator_port.view_request", ticket, what, objects);
};

// What is answered of objects of the map. Times are milliseconds since 1970 (UTC).
struct object_on_map {
  std::string class_group;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double confidence = 0; // 0..1
  std::int64_t last_seen_ms = 0;
  bool is_seen_here = false; // found or moved by this vehicle since the map was pulled
  GODWIT_FIELDS(object_on_map, "operator_port.object_on_map", class_group, latitude_deg, longitude_deg, confidence,
                last_seen_ms, is_seen_here);
};

struct objects_on_map {
  std::vector<object_on_map> objects; // the newest first
  std::uint64_t counted = 0;          // that lie there, those among them
  bool is_all = true;                 // false: there are more, which nobody has looked at
  GODWIT_FIELDS(objects_on_map, "operator_port.objects_on_map", objects, counted, is_all);
};

// Of "?bbox=...&limit=..."; the error is a sentence.
[[nodiscard]] tl::expected<mapobjects_store::get_objects, std::string> read_objects_query(std::string_view target);

using view_inlet = runtime::mailbox<runtime::tells<view_request>>;

class view_handler final : public runtime::actor_base<view_inlet> {
public:
  static constexpr std::chrono::seconds answer_timeout{2};

  view_handler(runtime::spawn_context context, executor::view_handle flight, mapobjects_store::viewer_handle map,
               std::shared_ptr<waiting_answers> answers);
  ~view_handler() override;

protected:
  behavior_type handlers() override;

private:
  template <class Question, class View>
  void show(std::uint64_t ticket);
  void show_objects(const view_request& asked);

  executor::view_handle flight_;
  mapobjects_store::viewer_handle map_;
  std::shared_ptr<waiting_answers> answers_;
};

// TELL: to the handler; may be called in the thread of the port.
[[nodiscard]] route_list view_routes(const std::shared_ptr<waiting_answers>& answers,
                                     const std::function<void(view_request asked)>& tell);

} // namespace godwit::operator_port
