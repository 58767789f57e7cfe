// Whether stations may say what godwit does for them: start, resume, go to, choose an item, bring or clear a plan.
//
//   role        control                    they may
//   viewer      -                          DENIED
//   operator    not known yet              TEMPORARILY_REJECTED: in doubt nothing is done
//               somebody else has it       TEMPORARILY_REJECTED, with the name
//               free                       all of it
//
// A station can not take control, so somebody always is somebody else. Holding and returning are never asked about
// here. Pure. Thread: one owner.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "io/mavlink/enums.hpp"
#include "messages/operator/principal.hpp"

namespace godwit::ground_port {

namespace mavlink = io::mavlink;

class station_rules {
public:
  // What stations are; none: there are no operators beside them, and they may say everything.
  explicit station_rules(std::optional<operators::role> role) : role_(role) {}

  // Empty: nobody has control.
  void on_control(std::string holder) { holder_ = std::move(holder); }
  [[nodiscard]] bool knows_control() const { return holder_.has_value(); }

  struct objection {
    mavlink::mav_result result = mavlink::mav_result::denied;
    std::string why;     // short enough for a STATUSTEXT with what was wanted before it
    std::string outcome; // for the audit
  };
  // None: they may.
  [[nodiscard]] std::optional<objection> look() const;

private:
  std::optional<operators::role> role_;
  std::optional<std::string> holder_; // none: not heard yet
};

} // namespace godwit::ground_port
