// Where the log goes, and what of it. Thread: plain values.
#pragma once

#include <string>

namespace godwit::daemon {

enum class log_format { text, json };

enum class log_level { info, warning, error };

struct log_settings {
  std::string file; // empty: standard output
  log_format format = log_format::text;
  log_level level = log_level::info; // this and what is worse
};

} // namespace godwit::daemon
