// What the flights of a drill came to, as one HTML page: the table, a bar of outcomes and the recoveries of each group,
// and each flight with a flaw, with its story and the command that flies it again. Thread: any.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "programs/godwit-drill/flights/drill_book.hpp"

namespace godwit::drill {

struct drill_page {
  std::string command; // that was given
  double took_s = 0;
  const drill_book& book;
};

[[nodiscard]] std::string to_html(const drill_page& page);

} // namespace godwit::drill
