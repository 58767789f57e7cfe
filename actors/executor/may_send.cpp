#include "actors/executor/may_send.hpp"

namespace godwit::executor {

permission may_send(const intended_order& order, const flight::control_authority& authority, const evidence& seen,
                    std::int64_t now_ns) {
  if (order.kind == order_kind::stops)
    return permission::may;
  if (!authority.is_ours())
    return permission::not_ours;
  if (authority.is_unclear())
    return permission::wait;
  if (order.is_by_itself && authority.is_uncertain())
    return permission::uncertain;
  if (order.kind == order_kind::neutral)
    return permission::may;
  if (order.flies_plan && !seen.plan.is_proved_since(order.proof_from_ns))
    return permission::prove;
  const bool is_looked_at =
      order.looked_ns > seen.foreign_ns && now_ns - order.looked_ns <= vehicle_link::look_counts_ns;
  return is_looked_at ? permission::may : permission::look;
}

} // namespace godwit::executor
