// Counts what the flights of a drill came to, and says it: a table, a JSON document, each flight with a flaw, and a
// page. Thread: one.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "programs/godwit-drill/flights/flight_outcome.hpp"

namespace godwit::drill {

struct flight_figures {
  std::uint64_t flights = 0;
  std::uint64_t not_tried = 0;
  std::uint64_t failed = 0;
  std::uint64_t known = 0; // without a flaw but those that are known
  std::uint64_t with_takeover = 0;
  std::uint64_t kills = 0;
  std::uint64_t crashes = 0;
  std::uint64_t lost = 0;
  std::uint64_t doubled = 0;
  double flown_s = 0;
  std::vector<double> recoveries_ms;

  void take(const flight_outcome& each);
};

class drill_book {
public:
  // KEEPS_ALL: each flight and not only those with a flaw.
  explicit drill_book(bool keeps_all) : keeps_all_(keeps_all) {}

  void take(const flight_outcome& each);

  [[nodiscard]] const flight_figures& total() const { return total_; }
  [[nodiscard]] const std::map<std::string, flight_figures>& groups() const { return groups_; }
  [[nodiscard]] const std::vector<flight_outcome>& kept() const { return kept_; }
  // TOOK_S: of this machine, by all workers together.
  [[nodiscard]] std::string to_table(double took_s) const;
  [[nodiscard]] nlohmann::json to_json(double took_s) const;

private:
  bool keeps_all_;
  std::map<std::string, flight_figures> groups_;
  flight_figures total_;
  std::vector<flight_outcome> kept_;
};

// With the command that flies it again.
[[nodiscard]] std::string text_of_failure(const flight_outcome& each);

// Of P percent of them it is at most this; 0: there are none.
[[nodiscard]] double percentile(std::vector<double> values, double p);

// What the flights of a drill came to, as one HTML page: the table, a bar of outcomes and the recoveries of each group,
// and each flight with a flaw, with its story and the command that flies it again. Thread: any.
struct drill_page {
  std::string command; // that was given
  double took_s = 0;
  const drill_book& book;
};

[[nodiscard]] std::string to_html(const drill_page& page);

} // namespace godwit::drill
