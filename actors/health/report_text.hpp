// A report as JSON and as figures for Prometheus. Thread: pure.
#pragma once

#include <string>

#include "actors/health/report.hpp"
#include "io/prometheus/text.hpp"

namespace godwit::health {

[[nodiscard]] std::string json_of(const report& made);
[[nodiscard]] std::string json_of(const health_status& status);

// Names begin with godwit_; an actor is a label, the vehicle never is one.
void append_metrics(io::prometheus::text_writer& out, const report& made);

} // namespace godwit::health
