// Figures in the text form that Prometheus collects, version 0.0.4.
//
//   text_writer out;
//   out.begin("godwit_journal_commits_total", metric_kind::counter, "Transactions that reached the disk.");
//   out.add(commits);
//   out.begin("godwit_actor_restarts_total", metric_kind::counter, "Restarts of an actor.");
//   out.add(restarts, {{"actor", name}});
//
// A family is begun once and its samples follow it; one without samples is left out. Names are the caller's: letters,
// digits and underlines, with the base unit at the end and `_total` after a counter. Values of labels may be any text.
// Errors: none. Thread: as any value.
// Source: prometheus.io, "Exposition formats" (text-based format) and "Metric and label naming".
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace godwit::io::prometheus {

inline constexpr std::string_view content_type = "text/plain; version=0.0.4; charset=utf-8";

enum class metric_kind { counter, gauge };

struct label {
  std::string_view name;
  std::string_view value;
};

class text_writer {
public:
  void begin(std::string_view name, metric_kind kind, std::string_view help);
  void add(double value, std::initializer_list<label> labels = {}) { add_text(text_of(value), labels); }
  template <std::integral N>
  void add(N value, std::initializer_list<label> labels = {}) {
    add_text(std::to_string(value), labels);
  }

  // A family with one sample.
  template <class N>
  void one(std::string_view name, metric_kind kind, std::string_view help, N value) {
    begin(name, kind, help);
    add(value);
  }

  [[nodiscard]] const std::string& text() const { return text_; }

private:
  [[nodiscard]] static std::string text_of(double value);
  void add_text(const std::string& value, std::initializer_list<label> labels);

  std::string text_;
  std::string name_;
  std::string head_; // of the family, until its first sample
};

} // namespace godwit::io::prometheus
