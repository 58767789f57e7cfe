// The forms in which a trace goes to other programs. Each is written in one pass, in bounded memory.
//
// An exporter takes deliveries in the order of time and appends what it has to say; what does not fit its bound is
// counted in left_out(). Adding one: a file with a make function, and a row in export_command.cpp. Thread: one at a
// time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "runtime/trace/reading/delivery.hpp"

namespace godwit::trace_tool {

class exporter {
public:
  exporter() = default;
  virtual ~exporter() = default;
  exporter(const exporter&) = delete;
  exporter& operator=(const exporter&) = delete;

  virtual void begin(std::string& out) = 0;
  virtual void take(std::string& out, const runtime::delivery& each) = 0;
  virtual void end(std::string& out) = 0;
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

protected:
  // Counts one more against LIMIT. False: it is left out.
  [[nodiscard]] bool has_room(std::uint64_t limit) {
    if (taken_ < limit) {
      ++taken_;
      return true;
    }
    ++left_out_;
    return false;
  }

private:
  std::uint64_t taken_ = 0;
  std::uint64_t left_out_ = 0;
};

using make_exporter = std::unique_ptr<exporter> (*)(const runtime::name_table& names, std::uint64_t limit);

// Chrome's trace events as JSON: https://ui.perfetto.dev opens it. Actors are tracks, causes are arrows.
[[nodiscard]] std::unique_ptr<exporter> make_perfetto(const runtime::name_table& names, std::uint64_t limit);
// A sequence diagram of Mermaid.
[[nodiscard]] std::unique_ptr<exporter> make_sequence(const runtime::name_table& names, std::uint64_t limit);
// A graph of Graphviz: who tells whom how often.
[[nodiscard]] std::unique_ptr<exporter> make_graph(const runtime::name_table& names, std::uint64_t limit);
// RFC 4180, with a line of titles.
[[nodiscard]] std::unique_ptr<exporter> make_csv(const runtime::name_table& names, std::uint64_t limit);
// One page that needs no network: the flight's time line, its way on a map, actors and their times.
[[nodiscard]] std::unique_ptr<exporter> make_html_report(const runtime::name_table& names, std::uint64_t limit);

} // namespace godwit::trace_tool
