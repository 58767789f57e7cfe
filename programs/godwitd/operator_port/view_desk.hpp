// Asks the executor what people look at, for GET /api/v1/plan and GET /api/v1/preflight.
//
//   request ──ticket──> view_desk ──get_plan, get_preflight──> executor ──> view as JSON ──> answer
//
// It causes nothing, nothing waits for it, and it is not essential. Errors: 503 and 504. Thread: as actor_base.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "io/fields/field_table.hpp"
#include "messages/executor/handle.hpp"
#include "programs/godwitd/operator_port/route.hpp"
#include "programs/godwitd/operator_port/waiting_answers.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::operator_port {

enum class view_kind { plan, preflight };

constexpr auto enum_names(view_kind) {
  return io::names<view_kind>({{view_kind::plan, "plan"}, {view_kind::preflight, "preflight"}});
}

struct view_request {
  std::uint64_t ticket = 0;
  view_kind what = view_kind::plan;
  static constexpr auto fields = io::table("operator_port.view_request", io::field("ticket", &view_request::ticket),
                                           io::field("what", &view_request::what));
};

using view_inlet = runtime::mailbox<runtime::tells<view_request>>;

class view_desk final : public runtime::actor_base<view_inlet> {
public:
  static constexpr std::chrono::seconds answer_timeout{2};

  view_desk(runtime::spawn_context context, executor::view_handle flight, std::shared_ptr<waiting_answers> answers);
  ~view_desk() override;

protected:
  behavior_type handlers() override;

private:
  template <class Question, class View>
  void show(std::uint64_t ticket);

  executor::view_handle flight_;
  std::shared_ptr<waiting_answers> answers_;
};

// TELL: to the desk; may be called in the thread of the port.
[[nodiscard]] route_list view_routes(const std::shared_ptr<waiting_answers>& answers,
                                     const std::function<void(view_request asked)>& tell);

} // namespace godwit::operator_port
